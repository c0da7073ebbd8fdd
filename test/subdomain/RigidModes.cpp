#include <Teuchos_UnitTestHarness.hpp>
#include <support/DenseAlgebra.hpp>
#include <suture/algebra/RigidAssembly.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/subdomain/RigidModes.hpp>

namespace suture {
namespace {

// (1, 0), (0, 1) and (-y, x) at each point, from the formulas.
Matrix motions(const std::vector<Point>& points) {
  Matrix modes(2 * points.size(), 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    modes.row(2 * i) << 1, 0, -points[i][1];
    modes.row(2 * i + 1) << 0, 1, points[i][0];
  }
  return modes;
}

double distanceToSpan(const Matrix& vectors, const Matrix& span) { return dense::withoutSpan(span, vectors).norm() / vectors.norm(); }

RigidMember part(std::vector<GlobalId> nodes, const std::vector<Point>& points) {
  RigidMember made;
  for (GlobalId node : nodes) {
    made.dofs.push_back(2 * node);
    made.dofs.push_back(2 * node + 1);
  }
  made.modes = motions(points);
  made.held.resize(0, 3);
  return made;
}

TEUCHOS_UNIT_TEST(RigidModes, SpanTranslationsAndTheRotation) {
  Box box;
  box.x0 = 1000;  // far from the origin and small: the columns are still of the order of one and well apart
  box.x1 = 1000.5;
  box.nx = 4;
  box.ny = 3;
  const Mesh mesh = boxes({box});
  const Matrix modes = rigidModes(mesh);
  std::vector<Point> points;
  for (int node = 0; node < mesh.nodes(); ++node) points.push_back(mesh.point(node));
  TEST_EQUALITY(modes.cols(), 3);
  TEST_EQUALITY(modes.rows(), 2 * mesh.nodes());
  TEST_COMPARE(distanceToSpan(motions(points), modes), <, 1e-13);
  TEST_COMPARE(modes.cwiseAbs().maxCoeff(), <, 1.5);
  const Vector singular = dense::singularValues(modes);
  TEST_COMPARE(singular(2), >, 0.2 * singular(0));
}

TEUCHOS_UNIT_TEST(RigidModes, OfAxisymmetricBodiesAreTheTranslationAlongTheAxis) {
  Mesh mesh = boxes({Box()});
  const Matrix plane = rigidModes(mesh);
  makeAxisymmetric(mesh);
  const Matrix modes = rigidModes(mesh);
  TEST_EQUALITY(modes.cols(), 1);
  for (int node = 0; node < mesh.nodes(); ++node) {
    TEST_EQUALITY(modes(2 * node, 0), 0.0);
    TEST_EQUALITY(modes(2 * node + 1, 0), 1.0);
  }
  TEST_EQUALITY((sectionModes(mesh) - plane).norm(), 0.0);  // the motions used by coarse spaces
}

TEUCHOS_UNIT_TEST(RigidModes, NullSpaceIsTheSpaceThatTheRowsLeaveFree) {
  TEST_EQUALITY((nullSpace(Matrix(0, 3)) - Matrix::Identity(3, 3)).norm(), 0.0);
  Matrix rows(5, 3);  // matrix of rank two, its last rows round-off
  rows << 1, 2, 3, 2, 4, 6, 0, 1, -1, 1, 3, 2, 1e-14, 0, 0;
  const Matrix free = nullSpace(rows);
  TEST_EQUALITY(free.cols(), 1);
  Vector expected(3);
  expected << -5, 1, 1;  // orthogonal to (1, 2, 3) and (0, 1, -1)
  TEST_COMPARE(distanceToSpan(expected, free), <, 1e-13);
  TEST_COMPARE(std::abs(free.norm() - 1.0), <, 1e-14);
  TEST_EQUALITY(nullSpace(Matrix::Identity(3, 3)).cols(), 0);
  TEST_EQUALITY(nullSpace(Matrix::Zero(2, 3)).cols(), 3);
}

TEUCHOS_UNIT_TEST(RigidModes, TwoPartsJoinedAtOneNodeHaveAHinge) {
  const RigidMember a = part({0, 1}, {{0, 0, 0}, {1, 0, 0}}), b = part({1, 2}, {{1, 0, 0}, {1, 2, 0}});
  const Matrix together = commonRigidMotions({a, b});
  TEST_EQUALITY(together.rows(), 6);
  TEST_EQUALITY(together.cols(), 4);  // three motions of the plane, and the angle between the parts
  const Matrix atHinge = a.modes.bottomRows(2) * together.topRows(3) - b.modes.topRows(2) * together.bottomRows(3);
  TEST_COMPARE(atHinge.norm(), <, 1e-14);
  TEST_COMPARE((together.transpose() * together - Matrix::Identity(4, 4)).norm(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(RigidModes, TwoPartsJoinedAlongALineMoveAsOne) {
  const RigidMember a = part({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), b = part({1, 2, 3}, {{1, 0, 0}, {1, 1, 0}, {2, 0, 0}});
  const Matrix together = commonRigidMotions({a, b});
  TEST_EQUALITY(together.cols(), 3);
  TEST_COMPARE((together.topRows(3) - together.bottomRows(3)).norm(), <, 1e-13);  // the same coefficients: the modes have one origin
}

TEUCHOS_UNIT_TEST(RigidModes, HeldRowsAreLeftOut) {
  RigidMember a = part({0, 1}, {{0, 0, 0}, {1, 0, 0}});
  const RigidMember b = part({1, 2}, {{1, 0, 0}, {1, 2, 0}});
  a.held = a.modes;  // clamped: only the hinge remains, b rotates about the point (1, 0)
  const Matrix together = commonRigidMotions({a, b});
  TEST_EQUALITY(together.cols(), 1);
  Vector turning(6);
  turning << 0, 0, 0, 0, -1, 1;  // u = (-y, x - 1)
  TEST_COMPARE(distanceToSpan(turning, together), <, 1e-13);
}

}  // namespace
}  // namespace suture
