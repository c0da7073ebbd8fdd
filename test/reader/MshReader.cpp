// The reader of .msh files without libgmsh; test/mesh/MshAgainstGmsh.cpp compares it with libgmsh's own.
#include <suture/mesh/CellGeometry.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;

namespace {

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("the test looks for '" + old + "'");
  return text.replace(at, old.size(), by);
}

// The unit square of two triangles in version 4.1: surface 1 is in two groups, one without a name; nodes have sparse tags.
const std::string square41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n2 1 \"body\"\n1 3 \"bottom edge\"\n$EndPhysicalNames\n"
    "$Entities\n1 2 1 0\n1 0 0 0 1 8\n1 0 0 0 1 0 0 1 -3 2 1 2\n2 0 1 0 1 1 0 1 4 0\n1 0 0 0 1 1 0 2 1 7 2 1 2\n$EndEntities\n"
    "$Nodes\n3 4 5 1000000\n0 1 0 1\n70\n0 0 0\n1 1 1 1\n1000000\n1 0 0 0.5\n2 1 0 2\n9\n5\n1 1 0\n0 1 0\n$EndNodes\n"
    "$Elements\n4 5 1 5\n0 1 15 1\n1 70\n1 1 1 1\n2 70 1000000\n1 2 1 1\n5 5 9\n2 1 2 2\n3 70 1000000 9\n4 70 9 5\n$EndElements\n";

template <typename... Values>
std::string bytes(Values... values) {
  std::string all;
  const auto put = [&](const auto& value) { all.append(reinterpret_cast<const char*>(&value), sizeof value); };
  (put(values), ...);
  return all;
}
// The same mesh in the binary form, with the tags 1 to 4, which is the order of the tags 5, 9, 70 and 1000000.
std::string binarySquare() {
  using S = std::size_t;
  return "$MeshFormat\n4.1 1 8\n" + bytes(1) +
         "\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"body\"\n1 3 \"bottom edge\"\n$EndPhysicalNames\n$Entities\n" +
         bytes(S(0), S(2), S(1), S(0), 1, 0., 0., 0., 1., 0., 0., S(1), -3, S(2), 1, 2, 2, 0., 1., 0., 1., 1., 0., S(1), 4, S(0), 1, 0., 0.,
               0., 1., 1., 0., S(2), 1, 7, S(2), 1, 2) +
         "\n$EndEntities\n$Nodes\n" +
         bytes(S(1), S(4), S(1), S(4), 2, 1, 0, S(4), S(1), S(2), S(3), S(4), 0., 1., 0., 1., 1., 0., 0., 0., 0., 1., 0., 0.) +
         "\n$EndNodes\n$Elements\n" +
         bytes(S(3), S(4), S(1), S(4), 1, 1, 1, S(1), S(2), S(3), S(4), 1, 2, 1, S(1), S(5), S(1), S(2), 2, 1, 2, S(2), S(3), S(3), S(4),
               S(2), S(4), S(3), S(2), S(1)) +
         "\n$EndElements\n";
}

// Two triangles of the unit square in Gmsh's version 2, which repeats an element for each of its groups.
std::string msh2(const std::string& nodes, const std::string& elements, int nodeCount, int count) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 1 \"body\"\n2 2 \"part\"\n1 3 \"bottom\"\n1 4 "
         "\"odd\"\n$EndPhysicalNames\n"
         "$Nodes\n" +
         std::to_string(nodeCount) + "\n" + nodes + "$EndNodes\n$Elements\n" + std::to_string(count) + "\n" + elements + "$EndElements\n";
}
const std::string squareFile = "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n";

}  // namespace

TEUCHOS_UNIT_TEST(MshReader, TakesRepeatedElementsOfVersion2Once) {
  const Folder folder;
  const std::string path =
      folder.write("a.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 2 2 1 2 1 3 4\n3 2 2 2 1 1 2 3\n4 1 2 3 1 1 2\n", 4, 4));
  const Mesh mesh = readGmsh({path, {}, 1.0});
  TEST_EQUALITY(mesh.elements(), 2);
  TEST_EQUALITY(mesh.elementGroups.at("body").size(), std::size_t(2));
  TEST_EQUALITY(mesh.elementGroups.at("part").size(), std::size_t(1));
  TEST_EQUALITY(mesh.sideGroups.at("bottom").size(), std::size_t(1));
}

TEUCHOS_UNIT_TEST(MshReader, RefusesCurvesInsideTheMaterialAndOffIt) {
  const Folder folder;
  const std::string inside = folder.write("a.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n3 1 2 4 1 1 3\n", 4, 3));
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({inside, {}, 1.0}); }), "curve group 'odd': 1 of its elements lie inside the material");
  const std::string off = folder.write("b.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n3 1 2 4 1 2 4\n", 4, 3));
  SUTURE_CHECK_SAYS(problemsOf([&] {
                      readGmsh({off, {}, 1.0});
                    }),
                    "curve group 'odd': 1 of its elements are not sides of any surface element (the first at (0.5, 0.5))");
}

// Found by the fuzzer: the table of sides was queried for a node that it does not contain.
TEUCHOS_UNIT_TEST(MshReader, RefusesCurvesAtNodesOfNoElement) {
  const Folder folder;
  const std::string nodes = squareFile + "5 2 0 0\n6 4 0 0\n", triangleLines = "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n";
  const std::string one = folder.write("a.msh", msh2(nodes, triangleLines + "3 1 2 4 1 2 5\n", 6, 3));
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({one, {}, 1.0}); }), "are not sides of any surface element (the first at (1.5, 0))");
  const std::string both = folder.write("b.msh", msh2(nodes, triangleLines + "3 1 2 4 1 6 5\n", 6, 3));
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({both, {}, 1.0}); }), "are not sides of any surface element (the first at (3, 0))");
}

TEUCHOS_UNIT_TEST(MshReader, RefusesMeshesThatAreNotPlane) {
  const Folder folder;
  const std::string lifted = folder.write("a.msh", msh2("1 0 0 0\n2 1 0 0\n3 1 1 0.5\n4 0 1 0\n", "1 2 2 1 1 1 2 3\n", 4, 1));
  SUTURE_CHECK_SAYS(problemsOf([&] {
                      readGmsh({lifted, {}, 1.0});
                    }),
                    "away from the plane z = 0; expected a 2D mesh, or a mesh with volume elements");
}

TEUCHOS_UNIT_TEST(MshReader, LeavesSingleInvertedElementsToTheCheck) {
  const Folder folder;
  const std::string path = folder.write("a.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 4 3\n", 4, 2));
  Mesh mesh = readGmsh({path, {}, 1.0});
  SUTURE_CHECK_SAYS(problemsOf([&] { assignBodies(mesh, {"body"}); }), "1 inverted element (at (0.333333, 0.666667))");
}

TEUCHOS_UNIT_TEST(MshReader, ReadsVersion4WithGroupsWithoutNames) {
  const Folder folder;
  Mesh mesh = readGmsh({folder.write("a.msh", square41), {}, 1.0});
  TEST_EQUALITY(mesh.nodes(), 4);
  TEST_EQUALITY(mesh.elements(), 2);
  const std::vector<double> places = {0, 1, 1, 1, 0, 0, 1, 0};  // in the order of the tags 5, 9, 70, 1000000
  TEST_COMPARE_ARRAYS(mesh.coordinates, places);
  const std::vector<int> nodes = {2, 3, 1, 2, 1, 0};
  TEST_COMPARE_ARRAYS(mesh.connectivity, nodes);
  const std::vector<std::string> surfaces = {"body", "surface 7"}, curves = {"bottom edge", "curve 4"};
  TEST_COMPARE_ARRAYS(mesh.elementGroupNames(), surfaces);
  TEST_COMPARE_ARRAYS(mesh.sideGroupNames(), curves);
  TEST_EQUALITY(mesh.sideGroups.at("curve 4").at(0).element, 1);
  assignBodies(mesh, {"surface 7"});
}

TEUCHOS_UNIT_TEST(MshReader, ReadsTheSameFromBinaryNumbers) {
  const Folder folder;
  TEST_EQUALITY(readGmsh({folder.write("a.msh", binarySquare()), {}, 1.0}).hash(),
                readGmsh({folder.write("b.msh", square41), {}, 1.0}).hash());
}

TEUCHOS_UNIT_TEST(MshReader, SkipsOtherSectionsAndLineEndsOfOtherSystems) {
  const Folder folder;
  const std::string hash = readGmsh({folder.write("a.msh", square41), {}, 1.0}).hash();
  const std::string more = "$Periodic\n1\n1 1 2\n0\n$EndPeriodic\n$Mine\n$Nodes\n$EndNodes\nabc $EndMine\n$EndMine\n";
  TEST_EQUALITY(readGmsh({folder.write("b.msh", square41 + more), {}, 1.0}).hash(), hash);
  TEST_EQUALITY(readGmsh({folder.write("b.msh", "$Comments\nx\n$EndComments\n" + square41), {}, 1.0}).hash(), hash);
  std::string windows;
  for (const char c : square41) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  TEST_EQUALITY(readGmsh({folder.write("b.msh", windows), {}, 1.0}).hash(), hash);
}

// Groups of version 2 are those that the elements name, although all have the same entity here.
TEUCHOS_UNIT_TEST(MshReader, DistinguishesGroupsOfVersion2) {
  const Folder folder;
  const Mesh mesh = readGmsh(
      {folder.write("a.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 2 2 2 1 1 3 4\n3 1 1 6 1 2\n4 1 4 3 1 1 -2 3 4\n", 4, 4)), {}, 1.0});
  TEST_EQUALITY(mesh.elementGroups.at("body").at(0), 0);
  TEST_EQUALITY(mesh.elementGroups.at("part").at(0), 1);
  TEST_EQUALITY(mesh.sideGroups.at("curve 6").size(), std::size_t(1));
  TEST_EQUALITY(mesh.sideGroups.at("bottom").at(0).side, 1);
}

TEUCHOS_UNIT_TEST(MshReader, LeavesOutCurvesWithoutNameInsideTheMaterial) {
  const Folder folder;
  const Mesh mesh = readGmsh(
      {folder.write("a.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n3 1 2 9 1 1 3\n4 1 2 8 1 1 2\n", 4, 4)), {}, 1.0});
  const std::vector<std::string> curves = {"curve 8"};
  TEST_COMPARE_ARRAYS(mesh.sideGroupNames(), curves);
}

TEUCHOS_UNIT_TEST(MshReader, NamesElementsThatItDoesNotKnow) {
  const Folder folder;
  // 34: a polygon of any number of nodes; 222: a type that does not exist
  for (const auto& [type, complaint] :
       {std::make_pair("34", "1 elements of the kind 'Gmsh type 34' (in the group 'body'); supported are Triangle 3,"),
        std::make_pair("222", "1 elements of the kind 'Gmsh type 222'"),
        std::make_pair("21 2 1 1 3 4 1 2 3 4 1 2 3 4", "'Triangle 10' (in the group 'body')")}) {
    const std::string rest = std::string(type).size() > 3 ? "" : " 2 1 1 3 4";
    const std::string path = folder.write("a.msh", msh2(squareFile, "1 2 2 1 1 1 2 3\n2 " + std::string(type) + rest + "\n", 4, 2));
    SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({path, {}, 1.0}); }), complaint);
  }
  const std::string blocks =
      replaced(replaced(square41, "4 5 1 5", "5 6 1 6"), "$EndElements", "2 1 34 1\n6 70 9 5 1000000 70\n$EndElements");
  SUTURE_CHECK_SAYS(problemsOf([&] {
                      readGmsh({folder.write("a.msh", blocks), {}, 1.0});
                    }),
                    "1 elements of the kind 'Gmsh type 34' (in the group 'body', 'surface 7')");
}

TEUCHOS_UNIT_TEST(MshReader, ReportsWhereAFileIsWrong) {
  const Folder folder;
  const auto said = [&](const std::string& text) { return problemsOf([&] { readGmsh({folder.write("a.msh", text), {}, 1.0}); }); };
  const auto saidWith = [&](const std::string& old, const std::string& by) { return said(replaced(square41, old, by)); };
  SUTURE_CHECK_SAYS(saidWith("\n0 0 0\n", "\n0 1e308 0\n"),
                    "a.msh: $Nodes, line 20: node 70 has the coordinate 1e+308; expected a number of at most");
  SUTURE_CHECK_SAYS(saidWith("\n0 0 0\n", "\nnan 0 0\n"), "$Nodes, line 20: node 70 has the coordinate nan");
  SUTURE_CHECK_SAYS(saidWith("\n0 0 0\n", "\n1e999 0 0\n"), "node 70 has the coordinate inf");
  SUTURE_CHECK_SAYS(saidWith("\n0 0 0\n", "\n0 0x1 0\n"), "$Nodes, line 20: expected a coordinate, found '0x1'");
  SUTURE_CHECK_SAYS(saidWith("\n0 0 0\n", "\n0 0\n"), "$Nodes, line 22: announces 4 nodes, but its blocks hold a different number");
  SUTURE_CHECK_SAYS(saidWith("3 70 1000000 9", "3 70 999 9"), "$Elements, line 39: element 3 has node 999, which $Nodes does not contain");
  SUTURE_CHECK_SAYS(saidWith("3 70 1000000 9", "3 70 99999999999999999999 9"), "'99999999999999999999', which is out of range");
  SUTURE_CHECK_SAYS(saidWith("3 70 1000000 9", "3 70 9"), "$Elements, line 40: element 3 has node 4, which $Nodes does not contain");
  SUTURE_CHECK_SAYS(saidWith("2 1 2 2\n", "1 1 2 2\n"), "elements of the kind 'Triangle 3' in an entity of dimension 1");
  SUTURE_CHECK_SAYS(saidWith("3 4 5 1000000", "3 5 5 1000000"), "announces 5 nodes, but its blocks hold a different number");
  SUTURE_CHECK_SAYS(saidWith("3 4 5 1000000", "3 4000000 5 1000000"), "4000000 nodes are announced, but the file ends earlier");
  SUTURE_CHECK_SAYS(saidWith("4 5 1 5", "4 6 1 5"), "announces 6 elements");
  SUTURE_CHECK_SAYS(saidWith("\n5\n1 1 0", "\n9\n1 1 0"), "node 9 occurs twice, with different coordinates");
  SUTURE_CHECK_SAYS(saidWith("\n5\n1 1 0", "\n0\n1 1 0"), "node 0; expected tags from 1 upwards");
  SUTURE_CHECK_SAYS(saidWith("4.1 0 8", "4 0 8"),
                    "$MeshFormat, line 2: has version 4 of Gmsh's format; supported are 2.0 to 2.2 and 4.1: convert it");
  SUTURE_CHECK_SAYS(saidWith("4.1 0 8", "4.1 0 4"), "numbers are not 8 bytes long");
  SUTURE_CHECK_SAYS(saidWith("\"body\"", "body"),
                    "$PhysicalNames, line 6: expected the name of a physical group in double quotes, found 'body'");
  SUTURE_CHECK_SAYS(saidWith("$EndElements", "$EndElement"), "expected $EndElements, found '$EndElement'");
  SUTURE_CHECK_SAYS(saidWith("$EndElements", "1 2 3"), "expected $EndElements, found '1'");
  SUTURE_CHECK_SAYS(saidWith("$Nodes\n", "$Node\n"), "the section does not end: there is no line $EndNode");
  SUTURE_CHECK_SAYS(saidWith("\"bottom edge\"", "\"curve 4\""), "the group 'curve 4' has the default name of the unnamed group 4");
  SUTURE_CHECK_SAYS(said(square41.substr(0, square41.find("$Elements"))), "contains no surface elements");
  SUTURE_CHECK_SAYS(said("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n"), "expected $Nodes before $Elements");
  SUTURE_CHECK_SAYS(said(square41 + "1 2"), "expected a section such as $Nodes, found '1'");
}

TEUCHOS_UNIT_TEST(MshReader, ReportsWhereABinaryFileIsWrong) {
  const Folder folder;
  const auto said = [&](const std::string& text) { return problemsOf([&] { readGmsh({folder.write("a.msh", text), {}, 1.0}); }); };
  const std::string sound = binarySquare();
  SUTURE_CHECK_SAYS(said(replaced(sound, bytes(1), bytes(1 << 24))), "byte order of another kind of machine");
  SUTURE_CHECK_SAYS(said(replaced(sound, bytes(1), bytes(77))), "expected the number 1 in four bytes, found 77");
  const std::size_t bottom = sound.rfind(bytes(1.0, 1.0));
  std::string changed = sound;
  const double nan = std::nan("");
  std::memcpy(&changed[bottom], &nan, sizeof nan);
  SUTURE_CHECK_SAYS(said(changed), "$Nodes, byte " + std::to_string(bottom + 8) + ": node 2 has the coordinate nan");
  const std::size_t element = sound.find("$Elements");
  SUTURE_CHECK_SAYS(
      said(replaced(sound, bytes(std::size_t(3), std::size_t(3), std::size_t(4)), bytes(std::size_t(3), std::size_t(9), std::size_t(4)))),
      "$Elements, byte " + std::to_string(element + 10 + 32 + 20 + 24 + 20 + 24 + 20 + 16) + ": element 3 has node 9");
  // Every truncated file is refused, with the place of the error.
  for (std::size_t length = sound.find("$Entities"); length + 12 < sound.size(); length += 5) {
    const std::string complaint = said(sound.substr(0, length));
    TEST_ASSERT(complaint.find("a.msh: ") != std::string::npos);
  }
}

// Half the digits of many numbers, and the least and largest of them, against strtod.
TEUCHOS_UNIT_TEST(MshReader, ReadsRealsToTheLastBit) {
  const Folder folder;
  std::vector<std::string> numbers = {"+0.25",
                                      "-0",
                                      "1e-400",
                                      "4.9406564584124654e-324",
                                      "2.2250738585072011e-308",
                                      "0.1",
                                      "1e22",
                                      "1e23",
                                      ".5",
                                      "5.",
                                      "9007199254740993",
                                      "123456789012345678901234567890e-30",
                                      "1E+2",
                                      "0.500000000000000166533453693773481063544750213623046875"};
  double x = 0.3;
  for (int i = 0; i < 2000; ++i) {
    x = 3.9 * x * (1 - x);
    char text[60];
    std::snprintf(text, sizeof text, i % 2 ? "%.17g" : "%.16g", i % 3 ? x : x * std::pow(10., i % 97 - 48));
    numbers.emplace_back(text);
  }
  std::string nodes, elements;
  for (std::size_t i = 0; i < numbers.size(); ++i) nodes += std::to_string(i + 1) + " " + numbers[i] + " " + std::to_string(i % 3) + " 0\n";
  for (std::size_t i = 0; i + 2 < numbers.size(); ++i)
    elements +=
        std::to_string(i + 1) + " 2 2 1 1 " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " " + std::to_string(i + 3) + "\n";
  const Mesh mesh = readGmsh(
      {folder.write("a.msh", msh2(nodes, elements, static_cast<int>(numbers.size()), static_cast<int>(numbers.size()) - 2)), {}, 1.0});
  TEST_EQUALITY_CONST(mesh.coordinates.size(), 2 * numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) TEST_EQUALITY(mesh.coordinates[2 * i], std::strtod(numbers[i].c_str(), nullptr));
}

// Seconds depend on the machine and its load: the reader is compared with a stream that reads every byte of the same file. The ratio is
// about 1. 300.
TEUCHOS_UNIT_TEST(MshReader, TakesFewTimesAScanOfEveryByte) {
  constexpr int n = 250;
  std::string nodes, elements;
  for (int i = 0; i < n * n; ++i) {
    char line[100];
    std::snprintf(line, sizeof line, "%d %.16g %.16g 0\n", i + 1, (i % n) / 7.0, (i / n) / 7.0);
    nodes += line;
  }
  int count = 0;
  for (int i = 0; i + n < n * n; ++i)
    if (i % n + 1 < n)
      elements += std::to_string(++count) + " 3 2 1 1 " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " " +
                  std::to_string(i + n + 2) + " " + std::to_string(i + n + 1) + "\n";
  const Folder folder;
  const std::string path = folder.write("a.msh", msh2(nodes, elements, n * n, count));
  double look = 1e9, read = 1e9;
  const auto seconds = [](const auto& work) {
    const std::clock_t begin = std::clock();
    work();
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  for (int repeat = 0; repeat < 5; ++repeat) {
    look = std::min(look, seconds([&] {
                      std::ifstream in(path, std::ios::binary);
                      const std::string text{std::istreambuf_iterator<char>(in), {}};
                      TEST_COMPARE(std::count(text.begin(), text.end(), '\n'), >, 2 * n);
                    }));
    read = std::min(read, seconds([&] { TEST_EQUALITY(readGmsh({path, {}, 1.0}).elements(), count); }));
  }
  out << "look " << look << " s, read " << read << " s\n";
  TEST_COMPARE(read, <, 4 * look);
}
