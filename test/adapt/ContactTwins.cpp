#include <suture/adapt/ContactTwins.hpp>
#include <suture/base/Errors.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>

#include <adapt/AdaptTesting.hpp>

using namespace suture;
using namespace adapttesting;

namespace {

Mesh touching(Cell cell, double gap) {
  Mesh mesh = boxes({box("lower", cell, 3), box("upper", cell, 3, 1 + gap, 2 + gap)});
  return mesh;
}

/// Largest distance of opposite nodes along the faces, and of the distance across them from the gap.
double worstOffset(const Mesh& mesh, const NodePairs& pairs, double gap) {
  double worst = 0;
  for (const auto& [a, b] : pairs) {
    Point away = minus(mesh.point(b), mesh.point(a));
    away[mesh.dimension - 1] -= gap;
    worst = std::max(worst, norm(away));
  }
  return worst;
}

}  // namespace

TEUCHOS_UNIT_TEST(ContactTwins, AreOppositeNodesAlsoAcrossAGap) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral8, Cell::Tetrahedron4, Cell::Hexahedron8})
    for (const double gap : {0.0, 0.2}) {
      const Mesh mesh = touching(cell, gap);
      const std::vector<NodePairs> twins = contactTwins(mesh, contact());
      TEST_EQUALITY(twins.size(), std::size_t(1));
      const int line = cell == Cell::Quadrilateral8 ? 7 : 4;
      TEST_EQUALITY(static_cast<int>(twins[0].size()), mesh.dimension == 2 ? line : line * line);
      TEST_COMPARE(worstOffset(mesh, twins[0], gap), <, 1e-15);
    }
}

TEUCHOS_UNIT_TEST(ContactTwins, AreCoincidentNodesWhereFacesHaveNoMatchingPairs) {
  // Six-node sides, whose vertices carry no pressure, and a face that is longer than the other.
  Mesh mesh = touching(Cell::Tetrahedron10, 0);
  NodePairs twins = contactTwins(mesh, contact()).front();
  TEST_EQUALITY(twins.size(), std::size_t(49));
  TEST_COMPARE(worstOffset(mesh, twins, 0), <, 1e-15);
  std::vector<Box> all{box("lower", Cell::Triangle3, 3), box("upper", Cell::Triangle3, 3, 1, 2)};
  all[0].x1 = 2;
  all[0].nx = 6;
  mesh = boxes(all);
  twins = contactTwins(mesh, contact()).front();
  TEST_EQUALITY(twins.size(), std::size_t(4));
  TEST_COMPARE(worstOffset(mesh, twins, 0), <, 1e-15);
}

TEUCHOS_UNIT_TEST(ContactTwins, AreEmptyForObstaclesAndUnknownGroups) {
  const Mesh mesh = touching(Cell::Triangle3, 0);
  Contact unknown = Contact::between("lower_top", "uper_bottom"), obstacle = contact().front();
  obstacle.groupsB.clear();
  const std::vector<NodePairs> twins = contactTwins(mesh, {unknown, obstacle, contact().front()});
  TEST_EQUALITY(twins.size(), std::size_t(3));
  TEST_ASSERT(twins[0].empty() && twins[1].empty());
  TEST_EQUALITY(twins[2].size(), std::size_t(4));
}

TEUCHOS_UNIT_TEST(ContactTwins, AreThoseOfTheListOfAScene) {
  const Mesh mesh = touching(Cell::Triangle6, 0.1);
  Parameters list("Contact");
  list.sublist("seam").set<std::string>("Side A", "lower_top").set<std::string>("Side B", "upper_bottom").set("Tolerance", 1e-3);
  list.sublist("floor").set<std::string>("Side A", "lower_bottom");
  const std::vector<NodePairs> twins = contactTwins(mesh, list), same = contactTwins(mesh, contact());
  TEST_EQUALITY(twins.size(), std::size_t(2));
  TEST_ASSERT(twins[0] == same[0] || twins[1] == same[0]);
  TEST_ASSERT(twins[0].empty() || twins[1].empty());
}

TEUCHOS_UNIT_TEST(ContactTwins, NeedAMeshWithoutCoatings) {
  Mesh mesh = touching(Cell::Triangle3, 0);
  mesh.coatings.emplace_back();
  TEST_THROW(contactTwins(mesh, contact()), InternalError);
}
