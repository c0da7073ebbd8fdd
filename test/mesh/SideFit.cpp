// Boxes of different cells, glued together.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/SideFit.hpp>

#include <map>

#include <mesh/ReferenceCells.hpp>
#include <support/CheckSays.hpp>

using namespace suture;

namespace {

/// Two unit cubes of 2 x 2 x 1 cells in one body, the second above the first, or next to it in x.
Mesh gluedCubes(Cell first, Cell second, bool above = true) {
  Box one, other;
  one.name = "one", one.cell = first;
  other.name = "other", other.cell = second;
  (above ? other.z0 : other.x0) = 1, (above ? other.z1 : other.x1) = 2;
  one.nx = one.ny = other.nx = other.ny = 2;
  one.nz = other.nz = above ? 1 : 2;
  Mesh mesh = boxes({one, other});
  std::map<Point, int> numberOf;
  std::vector<double> coordinates;
  for (int& node : mesh.connectivity) {
    const Point place = mesh.point(node);
    const auto [at, isNew] = numberOf.emplace(place, static_cast<int>(numberOf.size()));
    if (isNew) coordinates.insert(coordinates.end(), place.begin(), place.end());
    node = at->second;
  }
  mesh.coordinates = coordinates;
  mesh.elementGroups["both"] = mesh.elementGroups.at("one");
  for (const int e : mesh.elementGroups.at("other")) mesh.elementGroups["both"].push_back(e);
  return mesh;
}

std::string fitOf(Mesh mesh) {
  try {
    assignBodies(mesh, {"both"});
  } catch (const InputError& error) {
    return error.problems().size() == 1 ? error.problems()[0].message : "several problems";
  }
  return "they fit";
}

}  // namespace

TEUCHOS_UNIT_TEST(SideFit, AcceptsCellsThatMeetInEqualSides) {
  for (const Cell cell : referencecells::solid) TEST_EQUALITY(fitOf(gluedCubes(cell, cell)), "they fit");
  for (const auto& [one, other] :
       {std::pair(Cell::Hexahedron8, Cell::Pyramid5), {Cell::Pyramid5, Cell::Hexahedron8}, {Cell::Tetrahedron4, Cell::Wedge6}})
    TEST_EQUALITY(fitOf(gluedCubes(one, other)), "they fit");
  for (const Cell cell : {Cell::Hexahedron8, Cell::Pyramid5}) TEST_EQUALITY(fitOf(gluedCubes(cell, Cell::Wedge6, false)), "they fit");
}

// Four squares between the cubes, two triangles on each.
TEUCHOS_UNIT_TEST(SideFit, RefusesTrianglesOnAQuadrilateral) {
  for (const Cell quadrilateral : {Cell::Hexahedron8, Cell::Pyramid5})
    for (const Cell triangle : {Cell::Tetrahedron4, Cell::Wedge6}) {
      const std::string said = fitOf(gluedCubes(quadrilateral, triangle));
      SUTURE_CHECK_SAYS(said, "elements that do not fit: 8 triangles on a quadrilateral (the first at (0.");
      SUTURE_CHECK_SAYS(said, ", 1)), there element ");
      SUTURE_CHECK_SAYS(said, " (" + cellInfo(triangle).name + ") and element ");
      SUTURE_CHECK_SAYS(said, " (" + cellInfo(quadrilateral).name + "); expected a pyramid between them, or sides with the same vertices");
    }
  SUTURE_CHECK_SAYS(fitOf(gluedCubes(Cell::Wedge6, Cell::Tetrahedron10, false)), "8 triangles on a quadrilateral (the first at (1, 0.");
}

// A wedge whose triangle lies on the quadrilateral of another one: also for cells of one kind.
TEUCHOS_UNIT_TEST(SideFit, RefusesWedgesThatAreTurned) {
  Mesh mesh;
  mesh.dimension = 3;
  mesh.coordinates = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 0, -1, 0, 1, -1, 0, 0, -1, 1};
  mesh.connectivity = {0, 1, 2, 3, 4, 5, 6, 8, 7, 0, 3, 1};
  mesh.cells = {Cell::Wedge6, Cell::Wedge6};
  mesh.offsets = {0, 6, 12};
  mesh.elementGroups["both"] = {0, 1};
  SUTURE_CHECK_SAYS(fitOf(mesh),
                    "1 triangle on a quadrilateral (at (0.333333, 0, 0.333333)), there element 1 (Wedge6) and element 0 (Wedge6)");
}

TEUCHOS_UNIT_TEST(SideFit, RefusesCommonSidesOfDifferentOrder) {
  for (const auto& [one, other] :
       {std::pair(Cell::Hexahedron8, Cell::Hexahedron20), {Cell::Hexahedron20, Cell::Hexahedron27}, {Cell::Hexahedron27, Cell::Pyramid5}}) {
    const std::string said = fitOf(gluedCubes(one, other));
    SUTURE_CHECK_SAYS(said, "elements that do not fit: 4 common sides with nodes that only one of two elements has (the first at (0.");
    SUTURE_CHECK_SAYS(said, "expected the same order of both");
  }
  SUTURE_CHECK_SAYS(fitOf(gluedCubes(Cell::Tetrahedron4, Cell::Tetrahedron10)), "8 common sides");
}
