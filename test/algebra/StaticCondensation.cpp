#include <Teuchos_UnitTestHarness.hpp>
#include <support/Matrices.hpp>
#include <suture/algebra/elimination/FrontTree.hpp>
#include <suture/algebra/elimination/StaticCondensation.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace suture {
namespace {

using namespace matrices;

// Some unknowns in an order unrelated to the matrix.
std::vector<int> someOf(int n, int count, unsigned seed) {
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  return {all.begin(), all.begin() + count};
}

// Both unknowns of the nodes on the rim of a grid.
std::vector<int> rim(int nx, int ny) {
  std::vector<int> unknowns;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      if (i == 0 || j == 0 || i == nx || j == ny)
        for (int c = 0; c < 2; ++c) unknowns.push_back(2 * (j * (nx + 1) + i) + c);
  return unknowns;
}

Matrix whole(StaticCondensation& condensation) { return condensation.schur().selfadjointView<Eigen::Lower>(); }

// S, g and the least energy from dense algebra.
void compareWithDense(const Sparse& a, const std::vector<int>& boundary, const std::vector<Point>& places, bool& success,
                      Teuchos::FancyOStream& out) {
  const int n = static_cast<int>(a.rows()), nb = static_cast<int>(boundary.size());
  std::vector<int> order = complement(n, boundary);
  order.insert(order.end(), boundary.begin(), boundary.end());
  const Vector load = Vector::Random(n);
  const Matrix turned = Matrix(a)(order, order);
  const Vector f = load(order);
  const Vector response = dense::solveSymmetric(turned.topLeftCorner(n - nb, n - nb), f.head(n - nb));
  StaticCondensation condensation(SymmetricMatrix(a), load, boundary, places);
  if (nb > 0) {
    TEST_COMPARE(difference(whole(condensation), denseSchur(turned, nb)), <, 1e-13);
    TEST_COMPARE(difference(condensation.condensedLoad(), f.tail(nb) - turned.bottomLeftCorner(nb, n - nb) * response), <, 1e-13);
  }
  TEST_COMPARE(std::abs(condensation.interiorEnergy() + 0.5 * f.head(n - nb).dot(response)), <,
               1e-13 * f.head(n - nb).norm() * response.norm() + 1e-300);
  Vector x = load;
  condensation.factor().solve(SymmetricMatrix(a), x);
  for (int i = 0; i < n - nb; ++i) TEST_COMPARE(std::abs(x(order[i]) - response(i)), <, 1e-11 * response.norm());
  for (const int b : boundary) TEST_EQUALITY(x(b), 0.0);
}

TEUCHOS_UNIT_TEST(StaticCondensation, EqualsDenseElimination) {
  for (const int n : {1, 40, 150})
    for (const double part : {0.0, 0.02, 0.3, 1.0})
      for (const unsigned seed : {1u, 2u, 3u})
        compareWithDense(randomDefinite(n, seed), someOf(n, static_cast<int>(part * n), seed), randomPlaces(n, seed), success, out);
}

TEUCHOS_UNIT_TEST(StaticCondensation, EliminatesAnInteriorInPieces) {
  // Two bodies joined only by the boundary, one unknown without neighbours, and a node that is half boundary.
  Sparse one = floatingBody(5, 4);
  const int n = static_cast<int>(one.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int copy = 0; copy < 2; ++copy)
    for (int j = 0; j < n; ++j)
      for (Sparse::InnerIterator it(one, j); it; ++it) entries.emplace_back(copy * n + it.row(), copy * n + j, it.value());
  entries.emplace_back(2 * n, 2 * n, 3.0);
  Sparse both(2 * n + 1, 2 * n + 1);
  both.setFromTriplets(entries.begin(), entries.end());
  std::vector<Point> places = placesOfBody(5, 4);  // one body upon the other
  places.insert(places.end(), places.begin(), places.begin() + n);
  places.push_back({0, 0, 0});
  for (const std::vector<Point>& where : {places, std::vector<Point>(2 * n + 1, Point{1, 1, 1})})
    compareWithDense(both, {n + 1, 0, 7, 1, n, n + 9, 12}, where, success, out);
}

TEUCHOS_UNIT_TEST(StaticCondensation, BoundaryUnknownsMayLackTheirDiagonalEntries) {
  const Sparse body = floatingBody(5, 4);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < body.cols(); ++j)
    for (Sparse::InnerIterator it(body, j); it; ++it)
      if (it.row() != j || j > 5) entries.emplace_back(it.row(), j, it.value());
  Sparse a(body.rows(), body.cols());
  a.setFromTriplets(entries.begin(), entries.end());
  for (const std::vector<int>& boundary : {std::vector<int>{0, 1, 2, 3, 4, 5}, {5, 3, 1, 0, 2, 4, 7, 8}})
    compareWithDense(a, boundary, placesOfBody(5, 4), success, out);
}

TEUCHOS_UNIT_TEST(StaticCondensation, TranslationsOfAFloatingBodyCostNothing) {
  for (const auto& [n, limit] : {std::pair(9, 2e-15), std::pair(30, 1e-14), std::pair(60, 3e-14)}) {
    const std::vector<int> boundary = rim(n, n);
    const Sparse a = floatingBody(n, n);
    StaticCondensation condensation(SymmetricMatrix(a), Vector::Zero(a.rows()), boundary, placesOfBody(n, n));
    const Matrix s = whole(condensation);
    for (int k = 0; k < 2; ++k) {
      Vector z = Vector::Zero(s.rows());
      for (int i = k; i < z.size(); i += 2) z(i) = 1.0;
      TEST_COMPARE((s * z).cwiseAbs().maxCoeff(), <, limit * (s.cwiseAbs() * z).maxCoeff());
    }
  }
}

TEUCHOS_UNIT_TEST(StaticCondensation, RefusesASingularInterior) {
  const Sparse a = floatingBody(12, 9);
  const Vector load = Vector::Zero(a.rows());
  const std::vector<Point> places = placesOfBody(12, 9);
  TEST_THROW(StaticCondensation(SymmetricMatrix(a), load, {}, places), NumericalError);
  TEST_THROW(StaticCondensation(SymmetricMatrix(a), load, {0, 1}, places), NumericalError);  // may still rotate
  Sparse indefinite = randomDefinite(30, 2);
  indefinite.coeffRef(17, 17) = -1;
  try {
    StaticCondensation(SymmetricMatrix(indefinite), Vector::Zero(30), {3, 4}, randomPlaces(30, 1));
    TEST_ASSERT(false);
  } catch (const NumericalError& error) {
    TEST_ASSERT(std::string(error.what()).find("the pivot of dof 17") != std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(FrontTree, EliminatesEachInteriorUnknownOnce) {
  const int nx = 17, ny = 11;
  const Sparse a = floatingBody(nx, ny);
  const std::vector<int> boundary = rim(nx, ny);
  const FrontTree tree(SymmetricMatrix(a), boundary, placesOfBody(nx, ny));
  const int n = static_cast<int>(a.rows());
  TEST_EQUALITY(tree.interior(), n - static_cast<int>(boundary.size()));
  TEST_EQUALITY(tree.groups(), n / 2);  // each node is a group
  std::vector<int> seen(tree.unknownAt);
  std::sort(seen.begin(), seen.end());
  for (int i = 0; i < n; ++i) TEST_EQUALITY(seen[i], i);
  int next = 0;
  for (std::size_t f = 0; f < tree.fronts.size(); ++f) {
    const FrontTree::Front& front = tree.fronts[f];
    TEST_EQUALITY(front.firstGroup, next);
    next = front.endGroup;
    TEST_ASSERT(std::is_sorted(tree.rows.begin() + front.firstRow, tree.rows.begin() + front.endRow));
    if (front.parent >= 0) TEST_COMPARE(front.parent, >, static_cast<int>(f));
  }
  TEST_EQUALITY(next, tree.interiorGroups);
}

// Multiplications in the dense fronts.
double operations(const FrontTree& tree) {
  double sum = 0.0;
  for (const FrontTree::Front& front : tree.fronts) {
    const double pivots = tree.start[front.endGroup] - tree.start[front.firstGroup];
    double below = 0.0;
    for (int r = front.firstRow; r < front.endRow; ++r) below += tree.start[tree.rows[r] + 1] - tree.start[tree.rows[r]];
    sum += pivots * pivots * pivots / 3 + pivots * pivots * below + pivots * below * below;
  }
  return sum;
}

// CHOLMOD's AMD of the interior with its relaxed supernodes, which this order replaced, takes 1.62e8 for the same matrix; here 1.03e8.
TEUCHOS_UNIT_TEST(FrontTree, TakesAThirdFewerOperationsThanMinimumDegree) {
  const int n = 60;
  const Sparse a = floatingBody(n, n);
  const double found = operations(FrontTree(SymmetricMatrix(a), rim(n, n), placesOfBody(n, n)));
  TEST_COMPARE(found, <, 0.7 * 1.62e8);
  // Coordinates unrelated to the matrix: the result is still right.
  TEST_COMPARE(operations(FrontTree(SymmetricMatrix(a), rim(n, n), randomPlaces(static_cast<int>(a.rows()), 1))), >, 2.0 * found);
}

// LAPACK does not stop there, and later pivots are numbers again.
TEUCHOS_UNIT_TEST(StaticCondensation, NamesAPivotThatIsNoNumber) {
  const int n = 6;
  Sparse a(n, n);
  for (int i = 0; i < n; ++i) a.insert(i, i) = i == 2 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  a.makeCompressed();
  try {
    StaticCondensation(SymmetricMatrix(a), Vector::Ones(n), {n - 1}, randomPlaces(n, 1));
    TEST_ASSERT(false);
  } catch (const NumericalError& error) {
    out << error.what() << "\n";
    TEST_ASSERT(std::string(error.what()).find("dof 2") != std::string::npos);
  }
}

}  // namespace
}  // namespace suture
