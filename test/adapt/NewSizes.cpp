#include <suture/adapt/NewSizes.hpp>
#include <suture/base/Errors.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <adapt/AdaptTesting.hpp>

using namespace suture;
using namespace adapttesting;

namespace {

/// Bodies far from each other, of two equal triangles (six tetrahedra) each, so that sizes do not influence each other.
Mesh scattered(Cell cell, int bodies) {
  std::vector<Box> all;
  for (int k = 0; k < bodies; ++k) {
    all.push_back(box("body" + std::to_string(k), cell, 1));
    all.back().x0 = 10 * k;
    all.back().x1 = 10 * k + 1;
  }
  return boxes(all);
}

}  // namespace

TEUCHOS_UNIT_TEST(NewSizes, FollowTheRateOfUniformRefinement) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Tetrahedron4, Cell::Hexahedron20})
    for (const int degree : {1, 2}) {
      const Mesh mesh = boxes({box("body", cell, 4)});
      // The error of degree k is proportional to h^k.
      const double target = 0.6, ratio = std::pow(target, 1.0 / degree);
      const NewSizes sizes = newSizes(mesh, std::vector<double>(mesh.elements(), 0.3), degree, target, {});
      const double size = signedSize(mesh, 0);
      const double h = cell == Cell::Hexahedron20     ? 0.25
                       : cell == Cell::Quadrilateral4 ? 0.25
                       : dimensionOf(cell) == 3       ? std::cbrt(size * 12 / std::sqrt(2.0))
                                                      : std::sqrt(size * 4 / std::sqrt(3.0));
      for (const double each : sizes.size) TEST_FLOATING_EQUALITY(each, ratio * h, 1e-4);
      TEST_FLOATING_EQUALITY(sizes.elements, mesh.elements() * std::pow(ratio, -dimensionOf(cell)), 1e-3);
    }
}

TEUCHOS_UNIT_TEST(NewSizes, AreThoseOfTheFewestElements) {
  for (const Cell cell : {Cell::Triangle3, Cell::Tetrahedron4})
    for (const int degree : {1, 2}) {
      const int bodies = 8, dimension = dimensionOf(cell);
      const Mesh mesh = scattered(cell, bodies);
      std::mt19937 random(1);
      std::uniform_real_distribution<double> uniform(1, 4);
      std::vector<double> ofBody(bodies), squares;
      for (double& square : ofBody) square = uniform(random);
      for (int e = 0; e < mesh.elements(); ++e) squares.push_back(ofBody[mesh.bodyOfElement[e]]);
      const double target = 0.5;
      const NewSizes sizes = newSizes(mesh, squares, degree, target, {});
      std::vector<double> ratio(bodies);
      const double h = newSizes(mesh, std::vector<double>(mesh.elements(), 0), degree, target, {}).size[0] / 2;  // no error: twice the size
      for (int n = 0; n < mesh.nodes(); ++n) ratio[mesh.bodyOfNode[n]] = sizes.size[n] / h;
      const auto error = [&](const std::vector<double>& r) {
        double sum = 0;
        for (int k = 0; k < bodies; ++k) sum += ofBody[k] * std::pow(r[k], 2 * degree);
        return sum;
      };
      const auto count = [&](const std::vector<double>& r) {
        double sum = 0;
        for (const double each : r) sum += std::pow(each, -dimension);
        return sum * mesh.elements() / bodies;
      };
      TEST_FLOATING_EQUALITY(error(ratio), target * target * std::accumulate(ofBody.begin(), ofBody.end(), 0.0), 1e-3);
      TEST_FLOATING_EQUALITY(sizes.elements, count(ratio), 1e-6);
      // Other sizes with the same error need more elements.
      for (int trial = 0; trial < 100; ++trial) {
        std::vector<double> other = ratio;
        for (double& each : other) each *= std::uniform_real_distribution<double>(0.8, 1.25)(random);
        const double scale = std::pow(error(ratio) / error(other), 0.5 / degree);
        for (double& each : other) each *= scale;
        TEST_COMPARE(count(other), >, count(ratio));
      }
    }
}

TEUCHOS_UNIT_TEST(NewSizes, StayWithinTheLimitsAndGrowSlowly) {
  for (const Cell cell : {Cell::Triangle6, Cell::Tetrahedron4}) {
    const Mesh mesh = boxes({box("body", cell, 8)});
    std::vector<double> squares(mesh.elements(), 1e-12);
    squares[mesh.elements() / 2] = 1;
    const NewSizes sizes = newSizes(mesh, squares, 2, 0.01, {});
    const double h = newSizes(mesh, std::vector<double>(mesh.elements(), 0), 2, 0.5, {}).size[0] / 2;
    double least = 1e9, most = 0, growth = 0;
    for (int e = 0; e < mesh.elements(); ++e)
      for (const auto& [i, j] : cellInfo(mesh.cells[e]).edges) {
        const int a = mesh.nodesOf(e)[i], b = mesh.nodesOf(e)[j];
        least = std::min({least, sizes.size[a], sizes.size[b]});
        most = std::max({most, sizes.size[a], sizes.size[b]});
        growth = std::max(growth, std::abs(sizes.size[a] - sizes.size[b]) / norm(minus(mesh.point(a), mesh.point(b))));
      }
    TEST_FLOATING_EQUALITY(least, h / 4, 1e-12);
    TEST_COMPARE(most, <=, 2 * h * (1 + 1e-12));
    TEST_COMPARE(growth, <=, 0.35 * (1 + 1e-12));
    for (const double size : sizes.size) TEST_ASSERT(std::isfinite(size));
  }
}

TEUCHOS_UNIT_TEST(NewSizes, AreEqualAtOppositeNodesOfAContact) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4}) {
    Mesh mesh = boxes({box("lower", cell, 4), box("upper", cell, 4, 1, 2)});
    openGap(mesh);
    const std::vector<NodePairs> twins = contactTwins(mesh, contact());
    TEST_COMPARE(twins.front().size(), >, std::size_t(4));
    std::vector<double> squares(mesh.elements(), 1e-3);
    for (int e = 0; e < mesh.elements(); ++e)
      if (mesh.bodyOfElement[e] == 0) squares[e] = 1 + centreOf(mesh, e)[0];
    const NewSizes sizes = newSizes(mesh, squares, 2, 0.4, twins);
    for (const auto& [a, b] : twins.front()) TEST_FLOATING_EQUALITY(sizes.size[a], sizes.size[b], 1e-14);
  }
}

TEUCHOS_UNIT_TEST(NewSizes, RefuseWhatIsNoErrorAndNoTarget) {
  const Mesh mesh = boxes({box("body", Cell::Triangle3, 2)});
  std::vector<double> squares(mesh.elements(), 1);
  TEST_THROW(newSizes(mesh, squares, 0, 0.5, {}), InternalError);
  TEST_THROW(newSizes(mesh, squares, 2, 1.5, {}), InternalError);
  TEST_THROW(newSizes(mesh, {1, 2}, 2, 0.5, {}), InternalError);
  squares[0] = -1;
  TEST_THROW(newSizes(mesh, squares, 2, 0.5, {}), InternalError);
}
