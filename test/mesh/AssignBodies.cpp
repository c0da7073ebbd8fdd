#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <mesh/ReferenceCells.hpp>
#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::problemsOf;

namespace {

Mesh twoSquares() {
  Box lower, upper;
  lower.name = "lower";
  lower.nx = lower.ny = 2;
  upper = lower;
  upper.name = "upper";
  upper.y0 = 1, upper.y1 = 2;
  return boxes({lower, upper});
}

std::string saidOf(Mesh mesh, const std::vector<std::string>& names = {"lower", "upper"}) {
  return problemsOf([&] { assignBodies(mesh, names); });
}

}  // namespace

TEUCHOS_UNIT_TEST(AssignBodies, FollowsTheOrderOfTheScene) {
  Mesh mesh = twoSquares();
  assignBodies(mesh, {"upper", "lower"});
  TEST_EQUALITY(mesh.bodyOfElement[mesh.elementGroups.at("upper")[0]], 0);
  TEST_EQUALITY(mesh.bodyOfElement[mesh.elementGroups.at("lower")[0]], 1);
  for (int e = 0; e < mesh.elements(); ++e)
    for (const int node : mesh.nodesOf(e)) TEST_EQUALITY(mesh.bodyOfNode[node], mesh.bodyOfElement[e]);
}

TEUCHOS_UNIT_TEST(AssignBodies, NamesTheNearestGroupForAnUnknownBody) {
  const std::string said = saidOf(twoSquares(), {"lowr", "upper"});
  SUTURE_CHECK_SAYS(said, "Bodies/lowr: ");
  SUTURE_CHECK_SAYS(said, "no such surface group 'lowr'. Did you mean 'lower'?");
  SUTURE_CHECK_SAYS(said, "subdomain_upper_0_0");
  TEST_ASSERT(!meshtesting::contains(said, "none of the bodies"));  // a consequence, not a second error
}

TEUCHOS_UNIT_TEST(AssignBodies, RefusesElementsInNoBody) {
  const std::string said = saidOf(twoSquares(), {"lower"});
  SUTURE_CHECK_SAYS(said, "8 elements (the first at (0.333333, 1.16667)) in none of the bodies (lower)");
}

TEUCHOS_UNIT_TEST(AssignBodies, RefusesElementsInTwoBodies) {
  Mesh mesh = twoSquares();
  mesh.elementGroups["upper"].push_back(0);
  SUTURE_CHECK_SAYS(saidOf(mesh), "Bodies/upper: 1 element (at (0.333333, 0.166667)) also in the body 'lower'");
}

TEUCHOS_UNIT_TEST(AssignBodies, RefusesBodiesThatShareNodes) {
  Mesh mesh = twoSquares();
  const Mesh sound = mesh;
  // glue the three nodes of the line y = 1: the upper body's nodes take the numbers of the lower
  for (int& node : mesh.connectivity)
    if (node >= 9 && node < 12) node -= 3;
  const std::string said = saidOf(mesh);
  SUTURE_CHECK_SAYS(said, "Bodies/lower: shares 3 nodes (the first at (0, 1)) with the body 'upper'");
  SUTURE_CHECK_SAYS(said, "Mesh: boxes: 3 nodes (the first at (0, 1)) in no element");  // the upper body's old nodes are orphans now
  TEST_EQUALITY(saidOf(sound), "no error");
}

TEUCHOS_UNIT_TEST(AssignBodies, RefusesInvertedAndCollapsedElementsWithTheirPlace) {
  Mesh mesh = twoSquares();
  std::swap(mesh.connectivity[0], mesh.connectivity[1]);
  mesh.connectivity[mesh.offsets[8] + 1] = mesh.connectivity[mesh.offsets[8]];
  const std::string said = saidOf(mesh);
  SUTURE_CHECK_SAYS(said, "1 inverted element (at (0.333333, 0.166667)); element 0 has the area -0.125");
  SUTURE_CHECK_SAYS(said, "1 element without area");
  SUTURE_CHECK_SAYS(said, "element 8 has the area 0,");
}

TEUCHOS_UNIT_TEST(AssignBodies, RefusesTangledCurvedElementsWithTheirPlace) {
  Box box;
  box.nx = box.ny = 2;
  box.cell = Cell::Triangle6;
  Mesh mesh = boxes({box});
  for (int node = 0; node < mesh.nodes(); ++node)
    if (mesh.point(node) == Point{0.25, 0, 0}) mesh.coordinates[2 * node + 1] = 0.4;  // the middle of a side of element 0, moved into it
  std::string said = "no error";
  try {
    assignBodies(mesh, {"body"});
  } catch (const InputError& error) {
    said = error.problems()[0].message;
  }
  SUTURE_CHECK_SAYS(said, "1 tangled element (at (");
  SUTURE_CHECK_SAYS(said, "in element 0 (Triangle6) the determinant of the map from the reference element is -");
  SUTURE_CHECK_SAYS(said, "a node of a side is too far from its middle");
}

TEUCHOS_UNIT_TEST(AssignBodies, AcceptsSlivers) {
  Mesh mesh = twoSquares();
  for (std::size_t i = 1; i < mesh.coordinates.size(); i += 2) mesh.coordinates[i] *= 1e-7;
  TEST_EQUALITY(saidOf(mesh), "no error");
}

TEUCHOS_UNIT_TEST(AssignBodies, ChecksTheShapesOfCellsIn3D) {
  for (const Cell cell : referencecells::solid) {
    Box lower, upper;
    lower.name = "lower", lower.cell = cell;
    lower.nx = lower.ny = lower.nz = 2;
    upper = lower;
    upper.name = "upper", upper.z0 = 1, upper.z1 = 2;
    const Mesh mesh = boxes({lower, upper});
    TEST_EQUALITY(saidOf(mesh), "no error");
    Mesh slivers = mesh;
    for (std::size_t i = 2; i < slivers.coordinates.size(); i += 3) slivers.coordinates[i] *= 1e-7;
    TEST_EQUALITY(saidOf(slivers), "no error");
    Mesh mirrored = mesh;
    for (std::size_t i = 1; i < mirrored.coordinates.size(); i += 3) mirrored.coordinates[i] *= -1;
    SUTURE_CHECK_SAYS(saidOf(mirrored), std::to_string(mesh.elements()) + " inverted elements (the first at (");
    SUTURE_CHECK_SAYS(saidOf(mirrored), "has the volume -0.");
    Mesh flat = mesh;
    for (std::size_t i = 2; i < flat.coordinates.size(); i += 3) flat.coordinates[i] = 0;
    SUTURE_CHECK_SAYS(saidOf(flat), std::to_string(mesh.elements()) + " elements without volume (the first at (");
  }
}

// Most elements are accepted by a bound without computing their least determinant; none whose least determinant is not positive is
// accepted.
TEUCHOS_UNIT_TEST(AssignBodies, AcceptsExactlyThoseCellsIn3DWhoseLeastDeterminantIsPositive) {
  std::mt19937 random(11);
  int accepted = 0, refused = 0;
  for (const Cell cell : referencecells::solid)
    for (int k = 0; k < 60; ++k) {
      Mesh mesh;
      static_cast<CellBlock&>(mesh) = referencecells::image(cell, {{1, 0, 0}, {0.3, 1, 0}, {0, 0.2, 1}});
      mesh.elementGroups["lower"] = {0};
      for (double& x : mesh.coordinates) x += 0.005 * k * (random() / 2147483648.0 - 1);
      const bool isSound = saidOf(mesh, {"lower"}) == "no error";
      TEST_EQUALITY(isSound, smallestJacobian(mesh, 0) > 1e-9);
      ++(isSound ? accepted : refused);
    }
  TEST_COMPARE(accepted, >, 100);
  TEST_COMPARE(refused, >, 20);
}

TEUCHOS_UNIT_TEST(AssignBodies, NamesTangledCellsIn3D) {
  Mesh mesh;
  static_cast<CellBlock&>(mesh) = referencecells::image(Cell::Hexahedron8, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0});
  mesh.elementGroups["lower"] = {0};
  for (int k = 0; k < 3; ++k) mesh.coordinates[3 * 6 + k] = -0.5;
  SUTURE_CHECK_SAYS(saidOf(mesh, {"lower"}), "1 tangled element (at (-0.5, -0.5, -0.5)); in element 0 (Hexahedron8) the determinant");
  SUTURE_CHECK_SAYS(saidOf(mesh, {"lower"}), "its vertices are too far from those of a convex cell");
  SUTURE_CHECK_SAYS(saidOf(mesh, {"lowr"}), "no such volume group 'lowr'. Did you mean 'lower'?");
  SUTURE_CHECK_SAYS(saidOf(mesh, {}), "in none of the bodies (). Volume groups: lower");
}

TEUCHOS_UNIT_TEST(Mesh, HashSeesEveryChangeAndNothingElse) {
  const Mesh mesh = twoSquares();
  Mesh same = twoSquares();
  same.source = "elsewhere";
  same.coordinates[0] = -same.coordinates[0];  // -0.0
  TEST_EQUALITY(same.hash(), mesh.hash());
  TEST_EQUALITY(mesh.hash().size(), std::size_t(16));

  std::vector<Mesh> others(9, mesh);
  others[0].coordinates[1] += 1e-16;
  std::swap(others[1].connectivity[0], others[1].connectivity[1]);
  others[2].elementGroups["lower"].pop_back();
  others[3].sideGroups["lower_top"][0].side += 1;
  others[4].sideGroups["new"];
  // Numbers are hashed in four interleaved chains: exchanged within one, between two, the last number changed, one number more.
  std::swap(others[5].coordinates[1], others[5].coordinates[1 + 4 * 2]);
  std::swap(others[6].coordinates[0], others[6].coordinates[1 + 4 * 2]);
  others[7].coordinates.back() += 1e-15;
  others[8].elementGroups["lower"].push_back(0);
  for (const Mesh& other : others) TEST_INEQUALITY(other.hash(), mesh.hash());
}
