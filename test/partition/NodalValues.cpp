#include <Teuchos_UnitTestHarness.hpp>
#include <suture/partition/NodalValues.hpp>
#include <suture/partition/TurnFromDrawn.hpp>

#include <cmath>

#include "Scenes.hpp"

using namespace suture;
using namespace partitiontesting;

namespace {

struct Parts {
  Mesh whole = mesh({box("low", 0, 4, 0, 1, 12, 4), box("top", 0, 4, 1, 2, 10, 4)});
  Partition partition = makePartition(*comm(), whole, Constraints(), metis(9).list(), false);
  std::vector<SubdomainMesh> meshes = distribute(*comm(), whole, Constraints(), partition);
};

// Coordinates as values: each subdomain gets those of its nodes, and gives them back.
TEUCHOS_UNIT_TEST(NodalValues, GoToTheSubdomainsAndBack) {
  Parts parts;
  Vector values;
  if (onRoot()) values = Eigen::Map<const Vector>(parts.whole.coordinates.data(), Eigen::Index(parts.whole.coordinates.size()));
  const std::vector<Vector> own = scatterNodes(*comm(), parts.meshes, values, 2);
  TEST_EQUALITY(own.size(), parts.meshes.size());
  for (std::size_t s = 0; s < own.size(); ++s)
    TEST_ASSERT(std::equal(own[s].begin(), own[s].end(), parts.meshes[s].coordinates.begin(), parts.meshes[s].coordinates.end()));
  const Vector back = gatherNodes(*comm(), parts.meshes, own, onRoot() ? parts.whole.nodes() : 0, 2);
  TEST_ASSERT(back.size() == values.size() && back == values);  // both are empty on other ranks
}

TEUCHOS_UNIT_TEST(NodalValues, TurnFromTheDrawnBody) {
  Parts parts;
  const double angle = 2.3;
  for (SubdomainMesh& mesh : parts.meshes) {
    TEST_ASSERT(turnFromDrawn(mesh) == Matrix::Identity(2, 2));  // it does not move far
    mesh.drawn = mesh.coordinates;
    TEST_ASSERT(turnFromDrawn(mesh) == Matrix::Identity(2, 2));
    for (int node = 0; node < mesh.nodes(); ++node) {
      const double x = mesh.drawn[2 * node], y = mesh.drawn[2 * node + 1];
      mesh.coordinates[2 * node] = 5 + x * std::cos(angle) - y * std::sin(angle);
      mesh.coordinates[2 * node + 1] = -1 + x * std::sin(angle) + y * std::cos(angle);
    }
    const Matrix turn = turnFromDrawn(mesh);
    TEST_FLOATING_EQUALITY(turn(0, 0), std::cos(angle), 1e-12);
    TEST_FLOATING_EQUALITY(turn(1, 0), std::sin(angle), 1e-12);
    TEST_FLOATING_EQUALITY(turn.determinant(), 1.0, 1e-12);
  }
}

}  // namespace
