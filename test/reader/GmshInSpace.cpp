// Needs SUTURE_GMSH. 3D geometries, meshed by Gmsh with every cell.
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <set>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;

namespace {

// A block of 2 x 1 x 1 with everything that a mesh needs.
const std::string block =
    "SetFactory(\"OpenCASCADE\");\n"
    "DefineConstant[ W = 2 ];\n"
    "Box(1) = {0, 0, 0, W, 1, 1};\n"
    "Physical Volume(\"body\") = {1};\n"
    "Physical Surface(\"left\") = {1};\n"
    "Physical Surface(\"bottom\") = {5};\n"
    "Physical Curve(\"edge\") = {1};\n"
    "Mesh.MeshSizeMax = 0.5;\n";
// The same by extrusion.
const std::string extruded =
    "SetFactory(\"OpenCASCADE\");\n"
    "Rectangle(1) = {0, 0, 0, 2, 1};\n"
    "out[] = Extrude {0, 0, 1} { Surface{1}; Layers{3}; Recombine; };\n"
    "Physical Volume(\"body\") = {out[1]};\n"
    "Physical Surface(\"bottom\") = {1};\n"
    "Mesh.MeshSizeMax = 0.5;\n";
const std::string transfinite = "Transfinite Surface{:}; Transfinite Volume{:}; Recombine Surface{:};\n";

double volume(const Mesh& mesh) {
  double sum = 0;
  for (int e = 0; e < mesh.elements(); ++e) sum += signedSize(mesh, e);
  return sum;
}

double area(const Mesh& mesh, const std::vector<Side>& sides) {
  const Surface surface(mesh, sides);
  double sum = 0;
  for (const auto& entry : surface.nodes()) sum += entry.second.tributary;
  return sum;
}

std::vector<Side> boundaryOf(const Mesh& mesh) {
  const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
  std::vector<Side> all;
  for (int e = 0; e < mesh.elements(); ++e)
    forEachSide(mesh, e, [&](const SideKey&, const Side& side) {
      if (table.onBoundary(side)) all.push_back(side);
    });
  return all;
}

/// Largest distance of a middle node of an edge or a side from the mean of the vertices there.
double bow(const Mesh& mesh) {
  double most = 0;
  const auto look = [&](Span<const int> nodes, int middle, const auto& vertices, int count) {
    Point mean{0, 0, 0};
    for (int k = 0; k < count; ++k) mean = plus(mean, scaled(1.0 / count, mesh.point(nodes[vertices[k]])));
    most = std::max(most, norm(minus(mean, mesh.point(nodes[middle]))));
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    for (std::size_t k = 0; cell.order == 2 && k < cell.edges.size(); ++k)
      look(mesh.nodesOf(e), cell.vertices + static_cast<int>(k), cell.edges[k], 2);
    for (std::size_t s = 0; mesh.cells[e] == Cell::Hexahedron27 && s < cell.sideNodes.size(); ++s)
      look(mesh.nodesOf(e), cell.sideNodes[s][8], cell.sideNodes[s], 4);
  }
  return most;
}

}  // namespace

TEUCHOS_UNIT_TEST(GmshInSpace, ReadsEveryCell) {
  const Folder folder;
  const std::pair<std::string, Cell> all[] = {
      {block, Cell::Tetrahedron4},
      {block + "Mesh.ElementOrder = 2;\n", Cell::Tetrahedron10},
      {block + transfinite, Cell::Hexahedron8},
      {block + transfinite + "Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;\n", Cell::Hexahedron20},
      {block + transfinite + "Mesh.ElementOrder = 2;\n", Cell::Hexahedron27},
      {extruded, Cell::Wedge6},
      {extruded + "Recombine Surface{1}; Mesh.RecombineAll = 1;\n", Cell::Hexahedron8}};
  for (const auto& [text, cell] : all) {
    Mesh mesh = readGmsh({folder.write("a.geo", text), {}, 1.0});
    TEST_EQUALITY(mesh.dimension, 3);
    assignBodies(mesh, {"body"});  // all elements positive, middle nodes in place
    TEST_EQUALITY(static_cast<std::ptrdiff_t>(mesh.elements()), std::count(mesh.cells.begin(), mesh.cells.end(), cell));
    TEST_FLOATING_EQUALITY(volume(mesh), 2.0, 1e-12);
    TEST_COMPARE(bow(mesh), <, 1e-12);
    const Surface bottom(mesh, mesh.sideGroups.at("bottom"));
    for (const auto& [node, data] : bottom.nodes()) {
      TEST_COMPARE(std::abs(data.position[2]), <, 1e-14);
      TEST_COMPARE(norm(minus(bottom.normal(node), {0, 0, -1})), <, 1e-12);
    }
    TEST_FLOATING_EQUALITY(area(mesh, mesh.sideGroups.at("bottom")), 2.0, 1e-12);
    if (mesh.sideGroups.count("left")) TEST_FLOATING_EQUALITY(area(mesh, mesh.sideGroups.at("left")), 1.0, 1e-12);
    TEST_ASSERT(mesh.sideGroups.count("edge") == 0 && mesh.elementGroups.size() == 1);
    TEST_FLOATING_EQUALITY(area(mesh, boundaryOf(mesh)), 10.0, 1e-12);
  }
}

// A block of hexahedra with tetrahedra on top: Gmsh puts pyramids between them.
TEUCHOS_UNIT_TEST(GmshInSpace, ReadsAMeshOfSeveralCells) {
  const Folder folder;
  const std::string text =
      "SetFactory(\"OpenCASCADE\");\n"
      "Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 1}; BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
      "Transfinite Curve{:} = 4; Transfinite Surface{1:6}; Recombine Surface{1:6}; Transfinite Volume{1};\n"
      "Physical Volume(\"body\") = {1, 2}; Physical Surface(\"bottom\") = {5}; Physical Surface(\"top\") = {11};\n";
  Mesh mesh = readGmsh({folder.write("a.geo", text), {}, 1.0});
  assignBodies(mesh, {"body"});
  std::set<std::string> cells;
  for (const Cell cell : mesh.cells) cells.insert(cellInfo(cell).name);
  TEST_ASSERT(cells == (std::set<std::string>{"Hexahedron8", "Pyramid5", "Tetrahedron4"}));
  TEST_FLOATING_EQUALITY(volume(mesh), 2.0, 1e-12);
  TEST_FLOATING_EQUALITY(area(mesh, boundaryOf(mesh)), 10.0, 1e-12);
  for (const char* end : {"bottom", "top"}) TEST_FLOATING_EQUALITY(area(mesh, mesh.sideGroups.at(end)), 1.0, 1e-12);
}

// Consecutive elements are on average little more than one element size apart: 0.8 of it.
TEUCHOS_UNIT_TEST(GmshInSpace, NumbersWhatItMeshesAlongACurve) {
  const Folder folder;
  const Mesh mesh = readGmsh({folder.write("a.geo", block), {}, 0.3});
  TEST_COMPARE(mesh.elements(), >, 5000);
  double steps = 0;
  for (int e = 1; e < mesh.elements(); ++e) steps += norm(minus(centreOf(mesh, e - 1), centreOf(mesh, e))) / diameterOf(mesh, e);
  out << "steps " << steps / mesh.elements() << "\n";
  TEST_COMPARE(steps / mesh.elements(), <, 1.0);
}

// A ball: with straight sides its surface is too small by O(h^2), with curved ones by O(h^4).
TEUCHOS_UNIT_TEST(GmshInSpace, ReadsCurvedElements) {
  const Folder folder;
  const double exact = 16 * std::acos(-1.0);
  double wrong[2];
  for (const int order : {1, 2}) {
    const std::string text =
        "SetFactory(\"OpenCASCADE\"); Sphere(1) = {0, 0, 0, 2}; Physical Volume(\"ball\") = {1}; Physical Surface(\"skin\") = {1};\n"
        "Mesh.MeshSizeMax = 0.8; Mesh.ElementOrder = " +
        std::to_string(order) + ";\n";
    Mesh mesh = readGmsh({folder.write("a.geo", text), {}, 1.0});
    assignBodies(mesh, {"ball"});
    const std::vector<Side>& skin = mesh.sideGroups.at("skin");
    TEST_EQUALITY(skin.size(), boundaryOf(mesh).size());
    for (const Side& side : skin)
      for (const int node : mesh.nodesOf(side)) TEST_FLOATING_EQUALITY(norm(mesh.point(node)), 2.0, 1e-6);
    wrong[order - 1] = std::abs(area(mesh, skin) / exact - 1);
    TEST_ASSERT((bow(mesh) > 0.01) == (order == 2));
  }
  out << "area of the ball wrong by " << wrong[0] << " and " << wrong[1] << "\n";
  TEST_COMPARE(wrong[0], >, 0.01);
  TEST_COMPARE(wrong[0], <, 0.05);
  TEST_COMPARE(wrong[1], <, 1e-3);
}

TEUCHOS_UNIT_TEST(GmshInSpace, ScalesTheMeshSizeAndTakesConstants) {
  const Folder folder;
  const std::string path = folder.write("a.geo", block);
  const Mesh coarse = readGmsh({path, {{"W", 4}}, 1.0}), fine = readGmsh({path, {{"W", 4}}, 0.5});
  TEST_FLOATING_EQUALITY(volume(coarse), 4.0, 1e-12);
  TEST_COMPARE(fine.elements(), >, 5 * coarse.elements());
  TEST_EQUALITY(readGmsh({path, {{"W", 4}}, 1.0}).hash(), coarse.hash());
}

TEUCHOS_UNIT_TEST(GmshInSpace, KeepsBodiesApartThatAreNotFragmented) {
  const Folder folder;
  const std::string text =
      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 1};\n"
      "Physical Volume(\"lower\") = {1}; Physical Volume(\"upper\") = {2};\n"
      "Physical Surface(\"lower_top\") = {6}; Physical Surface(\"upper_bottom\") = {11}; Mesh.MeshSizeMax = 0.5;\n";
  Mesh mesh = readGmsh({folder.write("a.geo", text), {}, 1.0});
  assignBodies(mesh, {"lower", "upper"});
  TEST_FLOATING_EQUALITY(area(mesh, mesh.sideGroups.at("lower_top")), 1.0, 1e-12);
  TEST_FLOATING_EQUALITY(area(mesh, mesh.sideGroups.at("upper_bottom")), 1.0, 1e-12);
  const std::string glued = "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n";
  const std::string together =
      folder.write("b.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 1};\n" + glued +
                                "Physical Volume(\"lower\") = {1}; Physical Volume(\"upper\") = {2};\n"
                                "Physical Surface(\"between\") = {6}; Mesh.MeshSizeMax = 0.5;\n");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({together, {}, 1.0}); }), "surface group 'between': ");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh({together, {}, 1.0}); }), "lie inside the material");
}

TEUCHOS_UNIT_TEST(GmshInSpace, RefusesTypesThatItDoesNotHave) {
  const Folder folder;
  SUTURE_CHECK_SAYS(problemsOf([&] {
                      readGmsh({folder.write("a.geo", extruded + "Mesh.ElementOrder = 2;\n"), {}, 1.0});
                    }),
                    "elements of the kind 'Prism 18' (in the group 'body')");
  const std::string third = problemsOf([&] { readGmsh({folder.write("a.geo", block + "Mesh.ElementOrder = 3;\n"), {}, 1.0}); });
  SUTURE_CHECK_SAYS(third, "elements of the kind 'Tetrahedron 20' (in the group 'body')");
  SUTURE_CHECK_SAYS(third, "mesh with elements of order 1 or 2 (-order 2)");
}
