// Needs SUTURE_GMSH. CAD files of Gmsh's OpenCASCADE (STEP, BREP, STL), and of OpenCASCADE itself (folder cad: an assembly in inches,
// IGES).
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>
#include <tuple>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;
using meshtesting::problemsOf;

namespace {

namespace occ = gmsh::model::occ;
const double pi = std::acos(-1.0);
const std::string samples = SUTURE_SOURCE_DIR "/test/reader/cad/";

/// Writes a CAD file with the shapes that `draw` makes.
std::string drawn(const Folder& folder, const std::string& name, const std::function<void()>& draw) {
  struct Session {
    Session() { gmsh::initialize(0, nullptr, false); }
    ~Session() { gmsh::finalize(); }
  } session;
  gmsh::option::setNumber("General.Terminal", 0);
  draw();
  occ::synchronize();
  const std::string path = folder.path() + "/" + name;
  if (path.substr(path.size() - 4) == ".stl") gmsh::model::mesh::generate(2);
  gmsh::write(path);
  return path;
}

std::string textOf(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}
std::string substituted(std::string text, const std::string& old, const std::string& by) {
  std::size_t count = 0;
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()), ++count)
    text.replace(at, old.size(), by);
  if (count == 0) throw std::logic_error("the text has no " + old);
  return text;
}

GmshInput input(const std::string& path, double largest = 0, int order = 0, const std::string& unit = "mm") {
  GmshInput made;
  made.path = path;
  made.largest = largest;
  made.order = order;
  made.unit = unit;
  made.seconds = 100;
  return made;
}

/// The mesh with its bodies assigned, which checks all elements, and that bodies share no nodes.
Mesh meshOf(const GmshInput& from, SideDescriptions* descriptions = nullptr) {
  Mesh mesh = readGmsh(from, descriptions);
  assignBodies(mesh, mesh.elementGroupNames());
  return mesh;
}

/// Volume of a body of tetrahedra, by the rule of degree 3 with five points, which is exact for curved ones of second order.
double volume(const Mesh& mesh, const std::string& body) {
  const std::vector<std::pair<ReferencePoint, double>> rule{{{1. / 4, 1. / 4, 1. / 4}, -2. / 15},
                                                            {{1. / 6, 1. / 6, 1. / 6}, 3. / 40},
                                                            {{1. / 2, 1. / 6, 1. / 6}, 3. / 40},
                                                            {{1. / 6, 1. / 2, 1. / 6}, 3. / 40},
                                                            {{1. / 6, 1. / 6, 1. / 2}, 3. / 40}};
  double sum = 0;
  std::vector<ShapeJet> jets(kMostCellNodes);
  for (const int e : mesh.elementGroups.at(body))
    for (const auto& [at, weight] : rule) {
      shapeJets(mesh.cells[e], at, jets.data());
      Point d[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
      for (std::size_t n = 0; n < mesh.nodesOf(e).size(); ++n)
        for (std::size_t k = 0; k < 3; ++k) d[k] = plus(d[k], scaled(jets[n].gradient[k], mesh.point(mesh.nodesOf(e)[n])));
      sum += weight * dot(d[0], cross(d[1], d[2]));
    }
  return sum;
}
double area(const Mesh& mesh, const std::string& group) {
  const Surface surface(mesh, mesh.sideGroups.at(group));
  double sum = 0;
  for (const auto& entry : surface.nodes()) sum += entry.second.tributary;
  return sum;
}
std::vector<std::string> sideNames(const Mesh& mesh) { return mesh.sideGroupNames(); }
double longestEdge(const Mesh& mesh) {
  double longest = 0;
  for (int e = 0; e < mesh.elements(); ++e)
    for (const auto& edge : cellInfo(mesh.cells[e]).edges)
      longest = std::max(longest, norm(minus(mesh.point(mesh.nodesOf(e)[edge[0]]), mesh.point(mesh.nodesOf(e)[edge[1]]))));
  return longest;
}

/// A plate of 40 x 20 x 10 with a hole of radius 5 about (15, 10).
void plateWithHole() {
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, occ::addBox(0, 0, 0, 40, 20, 10)}}, {{3, occ::addCylinder(15, 10, -1, 0, 0, 12, 5)}}, out, map);
}

}  // namespace

TEUCHOS_UNIT_TEST(CadReader, MeshesSolidsWithTheirExactVolumesAndAreas) {
  const Folder folder;
  for (const std::string name : {"solids.step", "solids.brep"}) {
    const std::string path = drawn(folder, name, [] {
      occ::addBox(0, 0, 0, 2, 3, 4);
      occ::addCylinder(10, 0, 0, 0, 0, 5, 1.5);
      occ::addSphere(20, 0, 0, 2);
      occ::addCone(30, 0, 0, 0, 0, 3, 2, 1);
      occ::addTorus(40, 0, 0, 3, 1);
    });
    SideDescriptions descriptions;
    const Mesh mesh = meshOf(input(path), &descriptions);
    TEST_ASSERT(std::all_of(mesh.cells.begin(), mesh.cells.end(), [](Cell cell) { return cell == Cell::Tetrahedron10; }));
    TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), 24.0, 1e-10);
    TEST_FLOATING_EQUALITY(volume(mesh, "body_2"), pi * 1.5 * 1.5 * 5, 2e-3);
    TEST_FLOATING_EQUALITY(volume(mesh, "body_3"), 4 * pi / 3 * 8, 2e-3);
    TEST_FLOATING_EQUALITY(volume(mesh, "body_4"), pi * 3 / 3 * (4 + 2 + 1), 2e-3);
    TEST_FLOATING_EQUALITY(volume(mesh, "body_5"), 2 * pi * pi * 3, 2e-3);
    TEST_FLOATING_EQUALITY(area(mesh, "body_1_top"), 6.0, 1e-10);
    TEST_FLOATING_EQUALITY(area(mesh, "body_1_left"), 12.0, 1e-10);
    TEST_FLOATING_EQUALITY(area(mesh, "body_1_front"), 8.0, 1e-10);
    TEST_FLOATING_EQUALITY(area(mesh, "body_2_cylinder_1"), 2 * pi * 1.5 * 5, 1e-3);
    TEST_FLOATING_EQUALITY(area(mesh, "body_2_bottom"), pi * 1.5 * 1.5, 1e-3);
    TEST_FLOATING_EQUALITY(area(mesh, "body_3_sphere_1"), 4 * pi * 4, 1e-3);
    TEST_FLOATING_EQUALITY(area(mesh, "body_4_cone_1"), pi * (2 + 1) * std::sqrt(10.0), 1e-3);
    TEST_FLOATING_EQUALITY(area(mesh, "body_5_torus_1"), 4 * pi * pi * 3, 1e-3);
    TEST_EQUALITY(mesh.sideGroups.size(), std::size_t(6 + 3 + 1 + 3 + 1));
    TEST_EQUALITY(descriptions["body_2_cylinder_1"], "cylinder, radius 1.5, along z");
    TEST_EQUALITY(descriptions["body_3_sphere_1"], "sphere, radius 2");
    TEST_EQUALITY(descriptions["body_5_torus_1"], "torus, radii 3 and 1, around z");
    TEST_EQUALITY(descriptions["body_1_right"], "plane, normal +x");
  }
}

TEUCHOS_UNIT_TEST(CadReader, NamesFacesTheSameWayForAnyMesh) {
  const Folder folder;
  const std::string path = drawn(folder, "plate.step", plateWithHole);
  const std::vector<std::string> names{"body_1_back", "body_1_bottom", "body_1_cylinder_1", "body_1_front",
                                       "body_1_left", "body_1_right",  "body_1_top"};
  const Mesh mesh = meshOf(input(path));
  TEST_COMPARE_ARRAYS(sideNames(mesh), names);
  TEST_EQUALITY(meshOf(input(path)).hash(), mesh.hash());
  for (const int order : {1, 2}) TEST_COMPARE_ARRAYS(sideNames(meshOf(input(path, 4.0, order))), names);
  TEST_FLOATING_EQUALITY(area(mesh, "body_1_cylinder_1"), 2 * pi * 5 * 10, 1e-3);
  TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), 8000 - pi * 25 * 10, 1e-3);
}

// A cylinder from two halves has two faces that meet at straight seams: one group. A circle around it separates two groups.
TEUCHOS_UNIT_TEST(CadReader, JoinsThePartsOfACylinderAtSeamsOnly) {
  const Folder folder;
  const std::string halves = drawn(folder, "halves.step", [] {
    gmsh::option::setNumber("Geometry.OCCUnionUnify", 0);
    const int half = occ::addCylinder(0, 0, 0, 0, 0, 8, 3, -1, pi), other = occ::addCylinder(0, 0, 0, 0, 0, 8, 3, -1, pi);
    occ::rotate({{3, other}}, 0, 0, 0, 0, 0, 1, pi);
    gmsh::vectorpair out;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, half}}, {{3, other}}, out, map);
  });
  const Mesh mesh = meshOf(input(halves));
  TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), pi * 9 * 8, 2e-3);
  TEST_ASSERT(mesh.sideGroups.count("body_1_cylinder_1") == 1 && mesh.sideGroups.count("body_1_cylinder_2") == 0);
  TEST_FLOATING_EQUALITY(area(mesh, "body_1_cylinder_1"), 2 * pi * 3 * 8, 1e-3);

  const std::string ring = drawn(folder, "ring.brep", [] {
    gmsh::vectorpair out;
    std::vector<gmsh::vectorpair> map;
    occ::fragment({{3, occ::addCylinder(0, 0, 0, 0, 0, 8, 3)}}, {{1, occ::addCircle(0, 0, 5, 3)}}, out, map);
  });
  const Mesh parts = meshOf(input(ring));
  TEST_FLOATING_EQUALITY(area(parts, "body_1_cylinder_1"), 2 * pi * 3 * 5, 1e-3);
  TEST_FLOATING_EQUALITY(area(parts, "body_1_cylinder_2"), 2 * pi * 3 * 3, 1e-3);
}

// An assembly in inches: names of the parts, two bolts from one part, and the unit of the mesh.
TEUCHOS_UNIT_TEST(CadReader, ConvertsTheUnitOfTheFileAndTakesItsNames) {
  const std::string path = samples + "bolted_joint_in.step";
  const double plate = 4 * 2 * 0.5 - 2 * pi * 0.26 * 0.26 * 0.5, bolt = pi * 0.25 * 0.25 * 0.75;  // cubic inches
  std::vector<int> elements;
  for (const auto& [unit, inch] :
       {std::make_pair("in", 1.0), std::make_pair("mm", 25.4), std::make_pair("m", 0.0254), std::make_pair("ft", 1 / 12.0)}) {
    SideDescriptions descriptions;
    const Mesh mesh = meshOf(input(path, 0, 0, unit), &descriptions);
    TEST_COMPARE_ARRAYS(mesh.elementGroupNames(), (std::vector<std::string>{"base_plate_steel", "bolt_1", "bolt_2"}));
    TEST_FLOATING_EQUALITY(volume(mesh, "base_plate_steel"), plate * inch * inch * inch, 1e-3);
    TEST_FLOATING_EQUALITY(volume(mesh, "bolt_1"), bolt * inch * inch * inch, 2e-3);
    for (const auto& [name, centre] : {std::make_pair("bolt_1_top", 1.0), std::make_pair("bolt_2_top", 3.0)})
      for (const Side& side : mesh.sideGroups.at(name))
        for (const int node : mesh.nodesOf(side)) {
          TEST_COMPARE(std::abs(mesh.point(node)[2] - 0.75 * inch), <, 1e-9 * inch);
          TEST_COMPARE(std::abs(mesh.point(node)[0] - centre * inch), <, 0.26 * inch);
        }
    std::ostringstream radius;
    radius.precision(6);
    radius << "cylinder, radius " << 0.26 * inch << ", along z, hollow";
    TEST_EQUALITY(descriptions["base_plate_steel_cylinder_1"], radius.str());
    elements.push_back(mesh.elements());
  }
  for (const int count : elements) TEST_EQUALITY(count, elements[0]);  // the same mesh in every unit

  // The same numbers in metres: a file that says so is a thousand times as large.
  const Folder folder;
  const std::string mm = drawn(folder, "mm.step", [] { occ::addBox(0, 0, 0, 2, 3, 4); });
  const std::string m = folder.write("m.step", substituted(textOf(mm), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"));
  TEST_FLOATING_EQUALITY(volume(meshOf(input(mm, 0, 0, "mm")), "body_1"), 24.0, 1e-9);
  TEST_FLOATING_EQUALITY(volume(meshOf(input(m, 0, 0, "m")), "body_1"), 24.0, 1e-9);
  TEST_FLOATING_EQUALITY(volume(meshOf(input(m, 0, 0, "mm")), "body_1"), 24e9, 1e-9);
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input(mm, 0, 0, "unknown")); }), "Mesh/Length Unit: is unknown");
}

TEUCHOS_UNIT_TEST(CadReader, ReadsIgesFilesOfSolidsAndOfSurfaces) {
  for (const std::string name : {"solid.igs", "faces.igs"}) {
    SideDescriptions descriptions;
    const Mesh mesh = meshOf(input(samples + name), &descriptions);
    TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), 8000 - pi * 25 * 10, 1e-3);
    TEST_FLOATING_EQUALITY(area(mesh, "body_1_top"), 800 - pi * 25, 1e-3);
    TEST_EQUALITY(descriptions["body_1_cylinder_1"], "cylinder, radius 5, along z, hollow");  // in IGES a surface of revolution
    TEST_EQUALITY(mesh.sideGroups.size(), std::size_t(7));
  }
}

// Solids that touch, with their own faces or with common ones, become bodies that share no nodes.
TEUCHOS_UNIT_TEST(CadReader, KeepsTouchingSolidsApart) {
  const Folder folder;
  for (const bool fragmented : {false, true})
    for (const std::string ending : {".step", ".brep"}) {
      const std::string path = drawn(folder, "two" + ending, [&] {
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        const int lower = occ::addBox(0, 0, 0, 2, 1, 1), upper = occ::addBox(0, 0, 1, 1, 1, 1);
        if (fragmented) occ::fragment({{3, lower}}, {{3, upper}}, out, map);
      });
      Mesh mesh = meshOf(input(path));  // refuses bodies that share nodes
      TEST_EQUALITY(mesh.bodies.size(), std::size_t(2));
      std::set<int> lower, upper;
      for (int e = 0; e < mesh.elements(); ++e)
        for (const int node : mesh.nodesOf(e)) (mesh.bodyOfElement[e] == 0 ? lower : upper).insert(node);
      TEST_EQUALITY(static_cast<int>(lower.size() + upper.size()), mesh.nodes());
      TEST_FLOATING_EQUALITY(volume(mesh, "body_1") + volume(mesh, "body_2"), 3.0, 1e-10);
      TEST_FLOATING_EQUALITY(area(mesh, "body_1_bottom"), 1.0, 1e-10);  // the upper one is further to the left
      TEST_FLOATING_EQUALITY(area(mesh, "body_2_bottom"), 2.0, 1e-10);
    }
}

TEUCHOS_UNIT_TEST(CadReader, MeshesAnStlFileAsOneBody) {
  const Folder folder;
  const std::string path = drawn(folder, "plate.stl", [] {
    plateWithHole();
    gmsh::option::setNumber("Mesh.MeshSizeMax", 3);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 48);
  });
  SideDescriptions descriptions;
  const Mesh mesh = meshOf(input(path), &descriptions);
  TEST_COMPARE_ARRAYS(mesh.elementGroupNames(), (std::vector<std::string>{"body_1"}));
  TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), 8000 - pi * 25 * 10, 2e-3);  // of facets
  TEST_FLOATING_EQUALITY(area(mesh, "body_1_top"), 800 - pi * 25, 5e-3);
  TEST_ASSERT(mesh.sideGroups.count("body_1_cylinder_1") == 1 && mesh.sideGroups.count("body_1_cylinder_2") == 0);
  TEST_FLOATING_EQUALITY(area(mesh, "body_1_cylinder_1"), 2 * pi * 5 * 10, 5e-3);
  TEST_EQUALITY(descriptions["body_1_cylinder_1"].substr(0, 17), "cylinder, radius ");
  // An open surface, and two closed ones.
  const std::string text = textOf(path);
  const std::size_t end = text.find("endfacet") + 9, begin = text.find("facet");
  const std::string open = folder.write("open.stl", text.substr(0, begin) + text.substr(end));
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input(open)); }), "the surface is not closed");
  const std::string two = drawn(folder, "two.stl", [] {
    occ::addBox(0, 0, 0, 1, 1, 1);
    occ::addBox(3, 0, 0, 1, 1, 1);
  });
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input(two)); }), "contains 2 separate surfaces; expected one");
}

// Size and Order apply to a .geo file and to a CAD file; a file that prescribes its elements is not overridden silently.
TEUCHOS_UNIT_TEST(CadReader, AppliesSizeAndOrderToAnyGeometry) {
  const Folder folder;
  const std::string step = drawn(folder, "plate.step", plateWithHole);
  const std::string geo = folder.write("plate.geo",
                                       "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 40, 20, 10}; Physical Volume(\"body_1\") = {1};\n"
                                       "Physical Surface(\"top\") = {6}; Mesh.MeshSizeMax = 10;\n");
  for (const std::string& path : {step, geo})
    for (const int order : {1, 2}) {
      const Mesh coarse = meshOf(input(path, 0, order)), fine = meshOf(input(path, 2, order));
      const Cell expected = order == 1 ? Cell::Tetrahedron4 : Cell::Tetrahedron10;
      for (const Mesh* mesh : {&coarse, &fine})
        TEST_ASSERT(std::all_of(mesh->cells.begin(), mesh->cells.end(), [&](Cell cell) { return cell == expected; }));
      TEST_COMPARE(fine.elements(), >, 2 * coarse.elements());
      TEST_COMPARE(longestEdge(fine), <, 2.5 * 2);
    }
  TEST_EQUALITY(meshOf(input(geo)).hash(), meshOf(input(geo, 0, 1)).hash());  // the order of the file is 1
  TEST_EQUALITY(meshOf(input(geo)).hash(), meshOf(input(geo, 10)).hash());    // and its size 10
  TEST_EQUALITY(meshOf(input(geo)).hash(), meshOf(input(geo, 20)).hash());    // a larger one has no effect
  const std::string fixed = folder.write("fixed.geo",
                                         "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 40, 20, 10}; Physical Volume(\"body\") = {1};\n"
                                         "Transfinite Curve{:} = 3; Transfinite Surface{:}; Transfinite Volume{:};\n");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input(fixed, 1.0)); }), "Mesh/Size: ");
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input(fixed, 1.0)); }), "the file prescribes the number of elements there");
}

// Walls have elements about as large as their thickness, full circles at least sixteen; sides that face each other are refined.
TEUCHOS_UNIT_TEST(CadReader, TakesSizesFromThicknessCurvatureAndNeighbours) {
  const Folder folder;
  const std::string plate = drawn(folder, "plate.step", [] { occ::addBox(0, 0, 0, 60, 60, 2); });
  const Mesh thin = meshOf(input(plate));
  const double each = std::sqrt(3600 / (static_cast<double>(thin.sideGroups.at("body_1_top").size()) / 2));
  out << "size in the plane of the plate " << each << "\n";
  TEST_COMPARE(each, >, 1.0);
  TEST_COMPARE(each, <, 3.0);
  const Mesh linear = meshOf(input(plate, 0, 1));
  TEST_COMPARE(linear.elements(), >, 3 * thin.elements());  // first-order elements need several in the thickness
  const std::string rod = drawn(folder, "rod.step", [] { occ::addCylinder(0, 0, 0, 0, 0, 2, 10); });
  const Mesh disc = meshOf(input(rod));
  std::set<int> rim;
  for (const Side& side : disc.sideGroups.at("body_1_top"))
    for (const int node : disc.nodesOf(side))
      if (std::hypot(disc.point(node)[0], disc.point(node)[1]) > 10 - 1e-6) rim.insert(node);
  TEST_COMPARE(rim.size(), >=, std::size_t(2 * 16));  // with mid-side nodes
  const std::string near = drawn(folder, "near.step", [] {
    occ::addBox(0, 0, 0, 20, 20, 20);
    occ::addBox(0, 0, 20.1, 20, 20, 20);
  });
  const Mesh pair = meshOf(input(near));
  TEST_COMPARE(pair.sideGroups.at("body_1_top").size(), >, 2 * pair.sideGroups.at("body_1_bottom").size());
}

// Strong curvature in large or thin elements would turn second-order elements inside out; meshOf() refuses tangled ones.
TEUCHOS_UNIT_TEST(CadReader, StraightensElementsThatCurvatureWouldTurnInsideOut) {
  const Folder folder;
  const std::string shell = drawn(folder, "shell.step", [] {
    gmsh::vectorpair out;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{3, occ::addSphere(0, 0, 0, 10)}}, {{3, occ::addSphere(0, 0, 0, 9)}}, out, map);
  });
  const std::string tip = drawn(folder, "tip.step", [] { occ::addCone(0, 0, 0, 0, 0, 20, 5, 0); });
  for (const auto& [path, exact, tolerance] :
       {std::make_tuple(shell, 4 * pi / 3 * (1000 - 729), 5e-3), std::make_tuple(tip, pi * 25 * 20 / 3, 5e-3)}) {
    const Mesh mesh = meshOf(input(path));
    TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), exact, tolerance);
    for (const std::string& note : mesh.notes) out << note << "\n";
    TEST_ASSERT(!mesh.notes.empty() && mesh.notes[0].find("would turn the elements inside out") != std::string::npos);
  }
  const Mesh plate = meshOf(input(drawn(folder, "plate.step", plateWithHole)));
  TEST_ASSERT(plate.notes.empty());
}

// A plate with small holes: sizes grow on its flat faces, too; all holes have at least eight elements on the circle.
TEUCHOS_UNIT_TEST(CadReader, RefinesNearSmallHolesOnly) {
  const Folder folder;
  const std::string path = drawn(folder, "holes.step", [] {
    gmsh::vectorpair holes, out;
    std::vector<gmsh::vectorpair> map;
    for (int i = 0; i < 5; ++i)
      for (int k = 0; k < 5; ++k) holes.emplace_back(3, occ::addCylinder(10 + 20 * i, 10 + 20 * k, -1, 0, 0, 10, 1));
    occ::cut({{3, occ::addBox(0, 0, 0, 100, 100, 8)}}, holes, out, map);
  });
  const Mesh mesh = meshOf(input(path));
  TEST_FLOATING_EQUALITY(volume(mesh, "body_1"), 8e4 - 25 * pi * 8, 1e-4);
  out << mesh.elements() << " elements\n";
  TEST_COMPARE(mesh.elements(), <, 60000);
  for (int hole = 1; hole <= 25; ++hole) {
    std::set<int> rim;
    for (const Side& side : mesh.sideGroups.at("body_1_cylinder_" + std::to_string(hole)))
      for (const int node : mesh.nodesOf(side))
        if (mesh.point(node)[2] < 1e-9) rim.insert(node);
    TEST_COMPARE(rim.size(), >=, std::size_t(2 * 8));  // with mid-side nodes
  }
}

TEUCHOS_UNIT_TEST(CadReader, RefusesDamagedFilesWithTheReason) {
  const Folder folder;
  const std::string step = textOf(drawn(folder, "plate.step", plateWithHole)), brep = textOf(drawn(folder, "plate.brep", plateWithHole));
  const auto says = [&](const std::string& name, const std::string& text, double seconds = 30) {
    GmshInput from = input(folder.write(name, text));
    from.seconds = seconds;
    return problemsOf([&] { readGmsh(from); });
  };
  for (const std::string ending : {"step", "stp", "iges", "igs", "brep", "stl", "STEP"}) {
    SUTURE_CHECK_SAYS(says("empty." + ending, ""), "Mesh/File: " + folder.path() + "/empty." + ending + " is empty");
    SUTURE_CHECK_SAYS(says("text." + ending, "SystemCall \"touch x\";\n"), "is not a");
  }
  SUTURE_CHECK_SAYS(says("cut.step", step.substr(0, step.size() / 2)), "is cut off: the last line, END-ISO-10303-21, is missing");
  SUTURE_CHECK_SAYS(says("cut.brep", brep.substr(0, brep.size() / 2)), "is cut off");
  const std::string iges = textOf(samples + "solid.igs");
  SUTURE_CHECK_SAYS(says("cut.igs", iges.substr(0, iges.size() / 2)), "is cut off: the last line, the terminate section");
  SUTURE_CHECK_SAYS(says("cut.stl", "solid x\n facet normal 0 0 1\n outer loop\n"), "is cut off: the last line, endsolid, is missing");
  // OpenCASCADE leaves out a solid with such a point, without a message.
  SUTURE_CHECK_SAYS(says("far.step", substituted(step, "40.", "1.E+300")), "defines 1 solid, of which OpenCASCADE could read 0");
  const std::string surface = drawn(folder, "surface.step", [] { occ::addRectangle(0, 0, 0, 1, 1); });
  SUTURE_CHECK_SAYS(problemsOf([&] { readGmsh(input(surface)); }), "contains 1 surface but no solid");
  // OpenCASCADE reads this word for ever.
  SUTURE_CHECK_SAYS(says("loop.step", substituted(step, "(40.,", "(NAN,"), 20), "Mesh/File: ");
}
