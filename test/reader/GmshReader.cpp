// Needs SUTURE_GMSH. One rank: the reader is local; see MeshReader for several, and MshReader for .msh files.
#include <suture/mesh/CellGeometry.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>
#include <suture/reader/gmsh/MesherProcess.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <set>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;

namespace {

const std::string tunnel = SUTURE_SOURCE_DIR "/input/tunnel/tunnel.geo";

// A rectangle of W x 1 with everything that a mesh needs.
const std::string rectangle =
    "SetFactory(\"OpenCASCADE\");\n"
    "DefineConstant[ W = {2, Min 1, Name \"Width\"}, /* unused = {1}, */ H = 1 ]; // DefineConstant[ not = {1} ]\n"
    "Rectangle(1) = {0, 0, 0, W, H};\n"
    "Physical Surface(\"body\") = {1};\n"
    "Physical Curve(\"bottom\") = {1};\n"
    "Physical Curve(\"right\") = {2};\n"
    "Mesh.MeshSizeMax = 0.5;\n";

double areaOf(const Mesh& mesh) {
  double sum = 0;
  for (int e = 0; e < mesh.elements(); ++e) sum += signedSize(mesh, e);
  return sum;
}

double widthOf(const Mesh& mesh) {
  double width = 0;
  for (int i = 0; i < mesh.nodes(); ++i) width = std::max(width, mesh.point(i)[0]);
  return width;
}

}  // namespace

TEUCHOS_UNIT_TEST(GmshReader, ReadsTheTunnelWithItsKnownCounts) {
  Mesh mesh = readGmsh({tunnel, {}, 1.0});
  TEST_EQUALITY(mesh.elements(), 9670);
  TEST_EQUALITY(mesh.nodes(), 5067);
  TEST_EQUALITY(mesh.elementGroups.size(), std::size_t(14));
  TEST_EQUALITY(mesh.sideGroups.size(), std::size_t(9));
  assignBodies(mesh, {"left", "right"});
  // a polygon inscribed in the hole: a little more than the exact 120 x 80 - pi 36
  const double exact = 120 * 80 - 36 * 3.14159265358979;
  TEST_COMPARE(areaOf(mesh), >, exact);
  TEST_COMPARE(areaOf(mesh), <, exact + 1);
  for (const Side& side : mesh.sideGroups.at("tunnel_wall"))
    for (const int node : mesh.nodesOf(side))
      TEST_FLOATING_EQUALITY(std::hypot(mesh.point(node)[0] - 60, mesh.point(node)[1] - 39.5), 6.0, 1e-9);
}

// Consecutive elements are on average less than one element size apart: 0.7 of it. 10.5 times in the order of Gmsh.
TEUCHOS_UNIT_TEST(GmshReader, NumbersWhatItMeshesAlongACurve) {
  const Mesh mesh = readGmsh({tunnel, {}, 1.0});
  double steps = 0;
  for (int e = 1; e < mesh.elements(); ++e) {
    const Point a = centreOf(mesh, e - 1), b = centreOf(mesh, e);
    steps += std::hypot(a[0] - b[0], a[1] - b[1]) / diameterOf(mesh, e);
  }
  steps /= mesh.elements();
  TEST_COMPARE(steps, <, 1.0);
}

TEUCHOS_UNIT_TEST(GmshReader, NumbersTheSameGeometryTheSameWay) {
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle);
  TEST_EQUALITY(readGmsh({path, {}, 1.0}).hash(), readGmsh({path, {}, 1.0}).hash());
}

TEUCHOS_UNIT_TEST(GmshReader, OverridesConstantsForThisFileOnly) {
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle);
  TEST_FLOATING_EQUALITY(widthOf(readGmsh({path, {{"W", 5.25}}, 1.0})), 5.25, 1e-13);
  TEST_FLOATING_EQUALITY(widthOf(readGmsh({path, {}, 1.0})), 2.0, 1e-13);
  const std::string outer = folder.write("outer.geo", "// 'DefineConstant[ /*\nInclude \"a.geo\";\n");
  TEST_FLOATING_EQUALITY(widthOf(readGmsh({outer, {{"W", 3}}, 1.0})), 3.0, 1e-13);
}

TEUCHOS_UNIT_TEST(GmshReader, NamesTheConstantsThatThereAre) {
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle);
  const std::string said = problemsOf([&] { readGmsh({path, {{"w", 5}, {"not", 1}, {"unused", 1}}, 1.0}); });
  SUTURE_CHECK_SAYS(said, "Mesh/Constants/w: ");
  SUTURE_CHECK_SAYS(said, "Did you mean 'W'?");
  SUTURE_CHECK_SAYS(said, "Known here: H, W");
  SUTURE_CHECK_SAYS(said, "Mesh/Constants/not: ");
  SUTURE_CHECK_SAYS(said, "Mesh/Constants/unused: ");
}

TEUCHOS_UNIT_TEST(GmshReader, ScalesTheMeshSize) {
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle);
  const int coarse = readGmsh({path, {}, 1.0}).elements(), fine = readGmsh({path, {}, 0.25}).elements();
  TEST_COMPARE(fine, >, 10 * coarse);
  TEST_COMPARE(fine, <, 24 * coarse);
}

TEUCHOS_UNIT_TEST(GmshReader, ReadsALastLineWithoutNewline) {
  // Gmsh 4.8 alone drops the group behind the comment
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle + "Physical Curve(\"left\") = {4}; /* the end */");
  const Mesh mesh = readGmsh({path, {}, 1.0});
  TEST_EQUALITY(mesh.sideGroups.count("left"), std::size_t(1));
  TEST_EQUALITY(mesh.source, path);
  folder.write("b.geo", rectangle);
  const std::string including = folder.write("c.geo", "Include \"b.geo\";\nW = 3; /* the end */");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({including, {}, 1.0}); }), "the last line has no newline");
}

TEUCHOS_UNIT_TEST(GmshReader, KeepsOnlyNodesOfElements) {
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle + "Point(99) = {7, 7, 0}; Circle(98) = {9, 9, 0, 1, 0, 2*Pi};\n");
  const Mesh mesh = readGmsh({path, {}, 1.0});
  std::set<int> used(mesh.connectivity.begin(), mesh.connectivity.end());
  TEST_EQUALITY(static_cast<int>(used.size()), mesh.nodes());
  TEST_FLOATING_EQUALITY(widthOf(mesh), 2.0, 1e-13);
}

TEUCHOS_UNIT_TEST(GmshReader, ReadsEveryCell) {
  const Folder folder;
  const std::string quadrilaterals = "Transfinite Surface{1}; Recombine Surface{1};\n";
  const std::pair<std::string, Cell> all[] = {
      {"", Cell::Triangle3},
      {"Mesh.ElementOrder = 2;\n", Cell::Triangle6},
      {quadrilaterals, Cell::Quadrilateral4},
      {quadrilaterals + "Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;\n", Cell::Quadrilateral8},
      {quadrilaterals + "Mesh.ElementOrder = 2;\n", Cell::Quadrilateral9}};
  for (const auto& [options, cell] : all) {
    Mesh mesh = readGmsh({folder.write("a.geo", rectangle + options), {}, 1.0});
    assignBodies(mesh, {"body"});  // all elements positive, mid-side nodes in place
    for (const Cell found : mesh.cells) TEST_ASSERT(found == cell);
    TEST_FLOATING_EQUALITY(areaOf(mesh), 2.0, 1e-12);
    double length = 0;
    for (const Side& side : mesh.sideGroups.at("bottom")) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      length += mesh.point(nodes[1])[0] - mesh.point(nodes[0])[0];  // positive: the body is on the left
      for (const int node : nodes) TEST_COMPARE(std::abs(mesh.point(node)[1]), <, 1e-14);
    }
    TEST_FLOATING_EQUALITY(length, 2.0, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(GmshReader, TurnsAClockwiseSurfaceRound) {
  const Folder folder;
  for (const std::string options :
       {"", "Mesh.ElementOrder = 2;\n", "Transfinite Surface{1}; Recombine Surface{1}; Mesh.ElementOrder = 2;\n"}) {
    const std::string text =
        "Point(1) = {0,0,0,0.3}; Point(2) = {1,0,0,0.3}; Point(3) = {1,1,0,0.3}; Point(4) = {0,1,0,0.3};\n"
        "Line(1) = {1,4}; Line(2) = {4,3}; Line(3) = {3,2}; Line(4) = {2,1};\n"
        "Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};\n"
        "Physical Surface(\"body\") = {1}; Physical Curve(\"top\") = {2};\n" +
        options;
    Mesh mesh = readGmsh({folder.write("a.geo", text), {}, 1.0});
    assignBodies(mesh, {"body"});
    TEST_FLOATING_EQUALITY(areaOf(mesh), 1.0, 1e-12);
    for (const Side& side : mesh.sideGroups.at("top")) TEST_EQUALITY(mesh.point(mesh.nodesOf(side)[0])[1], 1.0);
  }
}

TEUCHOS_UNIT_TEST(GmshReader, PassesOnGmshMessagesWithTheUsersFileName) {
  const Folder folder;
  const std::string path = folder.write("a.geo", "DefineConstant[ W = {1} ];\nx = bar;");  // no newline: Gmsh sees a copy
  const std::string said = problemsOf([&] { readGmsh({path, {{"W", 2}}, 1.0}); });
  SUTURE_CHECK_SAYS(said, "Gmsh reports: '" + path + "', line 2: Unknown variable 'bar'");
}

TEUCHOS_UNIT_TEST(GmshReader, ReadsTheNextFileAfterABrokenOne) {
  const Folder folder;
  const std::string sound = folder.write("a.geo", rectangle), broken = folder.write("b.geo", "x = bar\n" + rectangle + "If (1)\n");
  const std::string hash = readGmsh({sound, {}, 1.0}).hash();
  TEST_INEQUALITY(problemsOf([&] { readGmsh({broken, {}, 1.0}); }), "no error");
  TEST_EQUALITY(readGmsh({sound, {}, 1.0}).hash(), hash);
}

TEUCHOS_UNIT_TEST(GmshReader, RefusesAGeometryWithoutSurface) {
  const Folder folder;
  const std::string path = folder.write("a.geo", "Point(1) = {0, 0, 0};\n");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({path, {}, 1.0}); }), "contains no surface elements");
}

// Statements that do more than describe a mesh, each in the ways that a file might hide it.
TEUCHOS_UNIT_TEST(GmshReader, RefusesStatementsThatDoNotDescribeAGeometry) {
  const Folder folder;
  const std::string mark = folder.path() + "/mark";
  const std::pair<std::string, std::string> all[] = {
      {"SystemCall \"touch " + mark + "\";", "line 8: 'SystemCall' runs a program"},
      {"NonBlockingSystemCall Str(\"touch " + mark + "\");", "'NonBlockingSystemCall' runs a program"},
      {"// no comment */ \n/* // \n */System \"touch " + mark + "\";", "line 10: 'System' runs a program"},
      {"Field[1] = ExternalProcess; Field[1].CommandLine = \"touch " + mark + "\";", "'ExternalProcess' runs a program"},
      {"OnelabRun(\"touch\");", "'OnelabRun' runs a program"},
      {"Exit;", "'Exit' ends or holds up the mesher"},
      {"Abort;", "'Abort' ends or holds up the mesher"},
      {"Save \"" + mark + "\";", "'Save' writes a file"},
      {"Print \"" + mark + "\";", "'Print' writes a file"},
      {"Printf(\"%g\", 1 > 0 ? 1 : 2) > \"" + mark + "\";", "'Printf' with '>' writes a file"},
      {"Printf(\"x\") >> \"" + mark + "\";", "'Printf' with '>' writes a file"},
      {"Merge StrCat(\"/etc\", \"/passwd\");", "'Merge' without the literal name of a file"},
      {"Include \"/etc/passwd\";", "is outside the folder"},
      {"Merge \"../../etc/passwd\";", "is outside the folder"},
      {"Include \"none.geo\";", "there is no such file"},
      {"Merge \"text.txt\";", "is neither a .geo file nor a mesh"},
      {"Merge \"text.msh\";", "is neither a .geo file nor a mesh"},
      {"Include \"deeper.geo\";", "deeper.geo, line 2: 'Exit' ends"},
      {"Plugin(Skin).Run;", "'Plugin' runs a plugin"},
      {"x = GetEnv(\"HOME\");", "'GetEnv' reads the environment"},
      {"Systemcall \"touch " + mark + "\";", "'Systemcall' is not known to be a harmless command"},
      {"x = \"" + std::string(1100, 'a') + " ; SystemCall ...\";", "a text of 1117 characters"},
      {"/* \nSystemCall \"x\";", "line 8: an unterminated comment"},
      {"x = \"a", "an unterminated text"},
      {std::string("x = 1;\0SystemCall", 17), "a zero byte"},
  };
  folder.write("text.txt", "SystemCall \"touch " + mark + "\";\n");
  folder.write("text.msh", "SystemCall \"touch " + mark + "\";\n");
  folder.write("deeper.geo", "Include \"deeper.geo\"; // itself\nExit;\n");
  for (const auto& [statement, complaint] : all) {
    const std::string path = folder.write("a.geo", rectangle + statement + "\n");
    const std::string said = problemsOf([&] { readGmsh({path, {}, 1.0}); });
    SUTURE_CHECK_SAYS(said, complaint);
    TEST_ASSERT(!std::filesystem::exists(mark));
  }
  // Gmsh runs a file as a .geo file unless it begins like a mesh, regardless of its name.
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({folder.path() + "/text.msh", {}, 1.0}); }), "is not a Gmsh mesh; expected $MeshFormat");
  TEST_ASSERT(!std::filesystem::exists(mark));
}

TEUCHOS_UNIT_TEST(GmshReader, LetsHarmlessStatementsPass) {
  const Folder folder;
  folder.write("sizes.geo", "w = 0.5;\n");
  const std::string path =
      folder.write("a.geo", rectangle +
                                "Include \"sizes.geo\";\n// SystemCall \"x\"; Exit;\nPrintf(\"SystemCall %g\", w > 1);\n"
                                "Macro Twice\n  For i In {0:1} w = w + i; EndFor\nReturn\nCall Twice;\nIf (w > 2) Exits = 1; EndIf\n"
                                "Print.Background = 1; Geometry.Tolerance = 1e-9; General.Terminal = 1;\n"
                                "Field[1] = MathEval; Field[1].F = \"0.5\"; Background Field = 1; Mesh 2;\n"
                                "Characteristic Length { PointsOf{ Surface{1}; } } = 0.5; Transfinite Curve{1} = 5 Using Progression 1.1;\n"
                                "Physical Curve('left', 7) = {4}; list[] = {1, 2}; list[0] += 1;\n");
  TEST_COMPARE(readGmsh({path, {}, 1.0}).elements(), >, 8);
}

// If permitted, they run; without a result or a message, the reader still reports an error.
TEUCHOS_UNIT_TEST(GmshReader, TakesTheSilenceOfTheMesherForAnError) {
  const Folder folder;
  const std::string mark = folder.path() + "/mark";
  const std::string path = folder.write("a.geo", rectangle + "SystemCall \"touch " + mark + "\";\nExit;\n");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({path, {}, 1.0, 600, true}); }), "ended without a mesh and without a message");
  TEST_ASSERT(std::filesystem::exists(mark));
}

// Gmsh then logs nothing: a file with an error must not pass as if it had none.
TEUCHOS_UNIT_TEST(GmshReader, ReportsErrorsOfAFileThatSilencesGmsh) {
  const Folder folder;
  for (const std::string level : {"0", "-1"}) {
    const std::string path = folder.write("a.geo", rectangle + "General.Verbosity = " + level + ";\nMesh.MeshSizeMax = typo;\n");
    SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({path, {}, 1.0}); }), "a.geo', line 9: Unknown variable 'typo'");
  }
}

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
// The second line of defence, against statements that the check of the file might overlook.
TEUCHOS_UNIT_TEST(GmshReader, ForbidsTheMesherToRunProgramsAndToWrite) {
  const Folder folder;
  const std::string mark = folder.path() + "/mark";
  for (const std::string& statement : {"SystemCall \"touch " + mark + "\";", "Save \"" + mark + ".msh\";", "CreateDir \"" + mark + "\";",
                                       "Printf(\"x\") > \"" + mark + "\";", "Mesh 2; Print \"" + mark + ".vtk\";"}) {
    const std::string path = folder.write("a.geo", rectangle + statement + "\n");
    const auto made = [&] {
      for (const std::string ending : {"", ".msh", ".vtk"})
        if (std::filesystem::exists(mark + ending)) return true;
      return false;
    };
    problemsOf([&] { runMesher({path, path, 1.0, 600.0, false}); });  // some fail, some are silently without effect
    TEST_ASSERT(!made());
    problemsOf([&] { runMesher({path, path, 1.0, 600.0, true}); });
    TEST_ASSERT(made());  // the statement does what this test believes
    for (const std::string ending : {"", ".msh", ".vtk"}) std::filesystem::remove(mark + ending);
  }
}
#endif

TEUCHOS_UNIT_TEST(GmshReader, EndsALoopWithoutEndAndAMacroThatCallsItself) {
  const Folder folder;
  for (const std::string loop : {"For i In {1:1e12}\n x = i;\nEndFor\n", "Macro again\n x = 1;\n Call again;\nReturn\nCall again;\n"}) {
    const std::string path = folder.write("a.geo", rectangle + loop);
    const std::string said = problemsOf([&] { readGmsh({path, {}, 1.0, 20}); });
    const bool ended = said.find("does the file contain an endless loop") != std::string::npos ||
                       said.find("Gmsh produced no mesh: suture_mesher crashed or reached a limit") != std::string::npos;
    if (!ended) out << said;
    TEST_ASSERT(ended);
  }
}

TEUCHOS_UNIT_TEST(GmshReader, CallsGroupsWithoutANameByTheirNumbers) {
  const Folder folder;
  const std::string path = folder.write("a.geo", rectangle + "Physical Curve(33) = {4}; Physical Surface(7) = {1};\n");
  const Mesh mesh = readGmsh({path, {}, 1.0});
  TEST_EQUALITY(mesh.elementGroups.at("surface 7").size(), mesh.elementGroups.at("body").size());
  for (const Side& side : mesh.sideGroups.at("curve 33")) TEST_EQUALITY(mesh.point(mesh.nodesOf(side)[0])[0], 0.0);
  TEST_EQUALITY(mesh.sideGroups.size(), std::size_t(3));
}
