// 3D meshes from .msh files without libgmsh: one element of every type with all its sides, written by hand in every form of the format.
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <algorithm>
#include <cmath>

#include <mesh/ReferenceCells.hpp>
#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;

namespace {

using Tuples = std::vector<std::vector<int>>;  // vertices whose midpoint the node is

/// An element type of Gmsh: its vertices, then the nodes between them, as in the drawings of section 9.2 of Gmsh's manual.
struct Drawn {
  Cell cell;
  int type;
  Tuples nodes;
};

const Tuples tetrahedronEdges{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}};
const Tuples cubeEdges{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
const Tuples cubeFaces{{0, 1, 2, 3}, {0, 1, 5, 4}, {0, 3, 7, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}};

std::vector<Drawn> types() {
  const auto nodes = [](int vertices, const std::vector<Tuples>& more) {
    Tuples all;
    for (int i = 0; i < vertices; ++i) all.push_back({i});
    for (const Tuples& tuples : more) all.insert(all.end(), tuples.begin(), tuples.end());
    return all;
  };
  return {{Cell::Tetrahedron4, 4, nodes(4, {})},
          {Cell::Hexahedron8, 5, nodes(8, {})},
          {Cell::Wedge6, 6, nodes(6, {})},
          {Cell::Pyramid5, 7, nodes(5, {})},
          {Cell::Tetrahedron10, 11, nodes(4, {tetrahedronEdges})},
          {Cell::Hexahedron27, 12, nodes(8, {cubeEdges, cubeFaces})},
          {Cell::Hexahedron20, 17, nodes(8, {cubeEdges})}};
}

/// Elements of a file: type, physical group (also the entity), nodes from 1.
struct Element {
  int dimension, type, group;
  std::vector<int> nodes;
};

/// A mesh for a file, and the result that Suture must read.
struct Sample {
  std::vector<Point> places;
  std::vector<Element> elements;
  Mesh expected;
};

int nodeAt(const std::vector<Point>& places, const Point& place) {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (norm(minus(places[i], place)) < 1e-12) return static_cast<int>(i);
  return -1;
}

/// One element of each type, without common nodes, in the group 1; their sides in the group 2, in any order and orientation. Nodes have the
/// numbers that they have in Suture. \param mirrored  the whole mesh, with its elements inside out
Sample everyType(bool mirrored = false) {
  Sample sample;
  sample.expected.dimension = 3;
  std::vector<Element> sides;
  for (const Drawn& drawn : types()) {
    const CellBlock one = referencecells::image(drawn.cell, {{1, 0.2, 0}, {0, 1, 0.3}, {0.1, 0, 1}}, {4.0 * drawn.type, 0, 0});
    const int first = static_cast<int>(sample.places.size());
    std::vector<Point> own;
    for (int node = 0; node < one.nodes(); ++node) own.push_back(one.point(node));
    Element element{3, drawn.type, 1, {}};
    for (const std::vector<int>& between : drawn.nodes) {
      Point middle{0, 0, 0};
      for (const int vertex : between) middle = plus(middle, scaled(1.0 / double(between.size()), own[vertex]));
      element.nodes.push_back(first + nodeAt(own, middle) + 1);
    }
    sample.elements.push_back(element);
    const int number = sample.expected.elements();
    sample.expected.elementGroups["body"].push_back(number);
    for (std::size_t s = 0; s < cellInfo(drawn.cell).sideNodes.size(); ++s) {
      const Side side{number, static_cast<int>(s)};
      sample.expected.sideGroups["skin"].push_back(side);
      std::vector<int> nodes = one.nodesOf(Side{0, side.side});
      const int type = nodes.size() == 3 ? 2 : nodes.size() == 4 ? 3 : nodes.size() == 6 ? 9 : nodes.size() == 8 ? 16 : 10;
      const std::ptrdiff_t vertices = nodes.size() % 3 == 0 && nodes.size() < 9 ? 3 : 4;
      std::rotate(nodes.begin(), nodes.begin() + std::ptrdiff_t(s) % vertices, nodes.begin() + vertices);
      if (s % 2) std::reverse(nodes.begin(), nodes.begin() + vertices);
      for (int& node : nodes) node += first + 1;
      sides.push_back({2, type, 2, nodes});
    }
    for (const Point& p : own) sample.places.push_back(p);
    sample.expected.cells.push_back(drawn.cell);
    for (int i = 0; i < one.nodes(); ++i) sample.expected.connectivity.push_back(first + i);
    sample.expected.offsets.push_back(static_cast<int>(sample.expected.connectivity.size()));
  }
  for (Point& p : sample.places) {
    if (mirrored) p[0] = -p[0];
    sample.expected.coordinates.insert(sample.expected.coordinates.end(), p.begin(), p.end());
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Element& a, const Element& b) { return a.type < b.type; });
  sample.elements.insert(sample.elements.begin(), sides.begin(), sides.end());
  return sample;
}

/// A file of a version of the format, as text or with binary numbers.
class File {
 public:
  File(bool isVersion4, bool binary) : isVersion4_(isVersion4), binary_(binary) {}

  std::string write(const Sample& sample, const std::string& names = "2\n3 1 \"body\"\n2 2 \"skin\"\n") {
    text_ = std::string("$MeshFormat\n") + (isVersion4_ ? "4.1 " : "2.2 ") + (binary_ ? "1 8\n" : "0 8\n");
    if (binary_) number(1), text_ += "\n";
    text_ += "$EndMeshFormat\n$PhysicalNames\n" + names + "$EndPhysicalNames\n";
    isVersion4_ ? version4(sample) : version2(sample);
    return text_;
  }

 private:
  template <typename T>
  void number(T value) {
    if (binary_)
      text_.append(reinterpret_cast<const char*>(&value), sizeof value);
    else {
      char word[40];
      std::snprintf(word, sizeof word, std::is_same_v<T, double> ? "%.17g " : "%.0f ", double(value));
      text_ += word;
    }
  }
  template <typename... T>
  void row(T... values) {
    (number(values), ...);
    if (!binary_) text_ += "\n";
  }
  using S = std::size_t;

  void version2(const Sample& sample) {
    text_ += "$Nodes\n" + std::to_string(sample.places.size()) + "\n";
    for (S i = 0; i < sample.places.size(); ++i) row(int(i) + 1, sample.places[i][0], sample.places[i][1], sample.places[i][2]);
    text_ += "$EndNodes\n$Elements\n" + std::to_string(sample.elements.size()) + "\n";
    int id = 0;
    for (const Element& element : sample.elements) {
      if (binary_)
        row(element.type, 1, 2, ++id);
      else
        number(++id), number(element.type), number(2);
      number(element.group), number(element.group);
      for (const int node : element.nodes) number(node);
      row();
    }
    text_ += "$EndElements\n";
  }

  void version4(const Sample& sample) {
    std::map<std::pair<int, int>, std::map<int, std::vector<const Element*>>> blocks;  // dimension, group -> type
    for (const Element& element : sample.elements) blocks[{element.dimension, element.group}][element.type].push_back(&element);
    S entities[4] = {}, count = 0;
    for (const auto& [entity, all] : blocks) ++entities[entity.first], count += all.size();
    text_ += "$Entities\n";
    row(entities[0], entities[1], entities[2], entities[3]);
    for (const auto& [entity, all] : blocks)
      if (entity.first == 0)
        row(entity.second, 0., 0., 0., S(1), entity.second);
      else
        row(entity.second, 0., 0., 0., 1., 1., 1., S(1), entity.second, S(0));
    text_ += "$EndEntities\n$Nodes\n";
    const S nodes = sample.places.size();
    row(S(1), nodes, S(1), nodes), row(3, 1, 0, nodes);
    for (S i = 1; i <= nodes; ++i) row(i);
    for (const Point& p : sample.places) row(p[0], p[1], p[2]);
    text_ += "$EndNodes\n$Elements\n";
    row(count, sample.elements.size(), S(1), sample.elements.size());
    S id = 0;
    for (const auto& [entity, all] : blocks)
      for (const auto& [type, elements] : all) {
        row(entity.first, entity.second, type, elements.size());
        for (const Element* element : elements) {
          number(++id);
          for (const int node : element->nodes) number(S(node));
          row();
        }
      }
    text_ += "$EndElements\n";
  }

  bool isVersion4_, binary_;
  std::string text_;
};

Mesh readAs(const Sample& sample, bool isVersion4 = true, bool binary = false) {
  const Folder folder;
  return readGmsh({folder.write("a.msh", File(isVersion4, binary).write(sample)), {}, 1.0});
}
std::string saidAbout(const Sample& sample) {
  return problemsOf([&] { readAs(sample); });
}

/// Two tetrahedra at the triangle 1 2 3, one on each side.
Sample twoTetrahedra(const std::vector<Element>& more = {}) {
  Sample sample;
  sample.places = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  sample.elements = {{3, 4, 1, {1, 2, 3, 4}}, {3, 4, 1, {1, 3, 2, 5}}};
  sample.elements.insert(sample.elements.end(), more.begin(), more.end());
  return sample;
}

}  // namespace

TEUCHOS_UNIT_TEST(MshInSpace, ReadsEveryTypeInEveryForm) {
  const Sample sample = everyType();
  for (const bool isVersion4 : {false, true})
    for (const bool binary : {false, true}) {
      Mesh mesh = readAs(sample, isVersion4, binary);
      TEST_EQUALITY(mesh.dimension, 3);
      TEST_COMPARE_ARRAYS(mesh.coordinates, sample.expected.coordinates);
      TEST_COMPARE_ARRAYS(mesh.connectivity, sample.expected.connectivity);
      TEST_COMPARE_ARRAYS(mesh.offsets, sample.expected.offsets);
      TEST_ASSERT(mesh.cells == sample.expected.cells);
      TEST_EQUALITY(mesh.hash(), sample.expected.hash());
      assignBodies(mesh, {"body"});
    }
}

TEUCHOS_UNIT_TEST(MshInSpace, PutsMiddlesBetweenTheVerticesOfTheirEdges) {
  const Mesh mesh = readAs(everyType());
  int middles = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const auto nodes = mesh.nodesOf(e);
    for (std::size_t k = 0; cell.order == 2 && k < cell.edges.size(); ++k, ++middles) {
      const Point sum = plus(mesh.point(nodes[cell.edges[k][0]]), mesh.point(nodes[cell.edges[k][1]]));
      TEST_COMPARE(norm(minus(scaled(0.5, sum), mesh.point(nodes[std::size_t(cell.vertices) + k]))), <, 1e-14);
    }
    for (std::size_t s = 0; mesh.cells[e] == Cell::Hexahedron27 && s < cell.sideNodes.size(); ++s) {
      Point sum{0, 0, 0};
      for (int k = 0; k < 4; ++k) sum = plus(sum, mesh.point(nodes[cell.sideNodes[s][k]]));
      TEST_COMPARE(norm(minus(scaled(0.25, sum), mesh.point(nodes[cell.sideNodes[s][8]]))), <, 1e-14);
    }
  }
  TEST_EQUALITY(middles, 6 + 12 + 12);
}

TEUCHOS_UNIT_TEST(MshInSpace, TurnsAVolumeRoundThatIsMeshedInsideOut) {
  const Sample mirrored = everyType(true);
  Mesh mesh = readAs(mirrored);
  assignBodies(mesh, {"body"});  // all elements positive, middle nodes in place
  TEST_COMPARE_ARRAYS(mesh.coordinates, mirrored.expected.coordinates);
  const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
  TEST_EQUALITY(mesh.sideGroups.at("skin").size(), everyType().expected.sideGroups.at("skin").size());
  for (int e = 0; e < mesh.elements(); ++e) TEST_COMPARE(smallestJacobian(mesh, e), >, 0.9 * smallestJacobian(everyType().expected, e));
}

TEUCHOS_UNIT_TEST(MshInSpace, LeavesSingleInvertedElementsToTheCheck) {
  Sample sample = twoTetrahedra();
  std::swap(sample.elements[1].nodes[1], sample.elements[1].nodes[2]);
  Mesh mesh = readAs(sample);
  SUTURE_CHECK_SAYS(problemsOf([&] { assignBodies(mesh, {"body"}); }),
                    "1 inverted element (at (0.25, 0.25, -0.25)); element 1 has the volume -0.1666");
}

TEUCHOS_UNIT_TEST(MshInSpace, IgnoresCurvesPointsAndNodesOfNoVolume) {
  Sample sample = twoTetrahedra({{1, 1, 5, {4, 6}}, {0, 15, 6, {6}}, {2, 2, 2, {1, 2, 4}}});
  sample.places.push_back({9, 9, 9});
  const Mesh mesh = readAs(sample);
  TEST_EQUALITY(mesh.nodes(), 5);
  const std::vector<std::string> volumes{"body"}, surfaces{"skin"};
  TEST_COMPARE_ARRAYS(mesh.elementGroupNames(), volumes);
  TEST_COMPARE_ARRAYS(mesh.sideGroupNames(), surfaces);
}

TEUCHOS_UNIT_TEST(MshInSpace, RefusesSurfacesInsideTheMaterialAndOffIt) {
  SUTURE_CHECK_SAYS(
      saidAbout(twoTetrahedra({{2, 2, 2, {2, 3, 1}}})),
      "surface group 'skin': 1 of its elements lie inside the material, between two elements; if two bodies meet there, each must be "
      "a separate shape, never fragmented with the other (the first at (0.333333, 0.333333, 0))");
  SUTURE_CHECK_SAYS(saidAbout(twoTetrahedra({{2, 2, 2, {2, 4, 5}}, {2, 2, 2, {2, 3, 4}}})),
                    "surface group 'skin': 1 of its elements are not sides of any volume element (the first at (0.333333, 0, 0))");
  Sample beside = twoTetrahedra({{2, 2, 2, {1, 2, 6}}});
  beside.places.push_back({0, 0, 9});
  SUTURE_CHECK_SAYS(saidAbout(beside), "are not sides of any volume element (the first at (0.333333, 0, 3))");
  // The key of a quadrilateral consists of three of its vertices: a triangle at these is another side.
  Sample cube;
  for (const Point& p : referencecells::places(Cell::Hexahedron8)) cube.places.push_back(p);
  cube.elements = {{3, 5, 1, {1, 2, 3, 4, 5, 6, 7, 8}}, {2, 2, 2, {1, 2, 3}}};
  SUTURE_CHECK_SAYS(saidAbout(cube), "surface group 'skin': 1 of its elements are not sides of any volume element");
}

TEUCHOS_UNIT_TEST(MshInSpace, LeavesOutSurfacesWithoutNameInsideTheMaterialAndNumbersTheOthers) {
  const Folder folder;
  const Sample sample = twoTetrahedra({{2, 2, 7, {1, 2, 3}}, {2, 2, 8, {1, 2, 4}}});
  for (const bool isVersion4 : {false, true}) {
    const Mesh mesh = readGmsh({folder.write("a.msh", File(isVersion4, false).write(sample, "0\n")), {}, 1.0});
    TEST_EQUALITY(mesh.elementGroups.at("volume 1").size(), 2u);
    TEST_EQUALITY(mesh.sideGroups.size(), 1u);
    TEST_EQUALITY(mesh.sideGroups.at("surface 8").at(0).element, 0);
    TEST_EQUALITY(mesh.sideGroups.at("surface 8").at(0).side, 1);
  }
}

TEUCHOS_UNIT_TEST(MshInSpace, TakesRepeatedElementsOfVersion2Once) {
  const Folder folder;
  Sample sample = twoTetrahedra({{3, 4, 3, {1, 3, 2, 5}}, {2, 2, 2, {1, 2, 4}}, {2, 2, 4, {1, 2, 4}}});
  const Mesh mesh =
      readGmsh({folder.write("a.msh", File(false, false).write(sample, "3\n3 1 \"body\"\n3 3 \"part\"\n2 2 \"skin\"\n")), {}, 1.0});
  TEST_EQUALITY(mesh.elements(), 2);
  TEST_EQUALITY(mesh.elementGroups.at("body").size(), 2u);
  TEST_EQUALITY(mesh.elementGroups.at("part").at(0), 1);
  TEST_EQUALITY(mesh.sideGroups.at("skin").size(), 1u);
  TEST_EQUALITY(mesh.sideGroups.at("surface 4").size(), 1u);
}

TEUCHOS_UNIT_TEST(MshInSpace, NamesElementsThatItDoesNotKnow) {
  Sample sample = twoTetrahedra({{3, 18, 1, {1, 2, 3, 4, 5, 1, 2, 3, 4, 5, 1, 2, 3, 4, 5}}});
  SUTURE_CHECK_SAYS(saidAbout(sample), "1 elements of the kind 'Prism 15' (in the group 'body'); supported are Triangle 3,");
  SUTURE_CHECK_SAYS(saidAbout(sample),
                    "Hexahedron 27, Quadrilateral 8, Hexahedron 20: mesh with elements of order 1 or 2 (-order 2); prisms and "
                    "pyramids, which result from recombined surfaces, with order 1");
}
