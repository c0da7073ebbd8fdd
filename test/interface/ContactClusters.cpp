#include <Teuchos_UnitTestHarness.hpp>
#include <support/DenseAlgebra.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/interface/ContactClusters.hpp>

namespace suture {
namespace {

using Row = ContactClusters::Row;
constexpr PairStatus kOpen = PairStatus::Open, kClosed = PairStatus::Slip;

// A point where four bodies meet, their seams inclined: body b has unknowns 2b, 2b + 1 (Cartesian), the seams 0-1 and 2-3 have the normal
// n, 0-2 and 1-3 the normal m. A ninth unknown belongs to no row.
struct CrossPoint {
  std::vector<Row> rows;
  Vector stiffness{9};

  explicit CrossPoint(double angle = 0.4, double skew = 1.3) {
    stiffness << 1.0, 2.0, 3e3, 5e3, 7.0, 11.0, 13.0, 17.0, 1.0;
    const double n[2] = {std::cos(angle), std::sin(angle)}, m[2] = {std::cos(angle + skew), std::sin(angle + skew)};
    add(0, 1, n, 0.0);
    add(2, 3, n, 0.02);
    add(0, 2, m, -0.01);
    add(1, 3, m, 0.03);
  }
  void add(int a, int b, const double* normal, double gap) {
    rows.push_back({{2 * a, 2 * a + 1, 2 * b, 2 * b + 1}, {normal[0], normal[1], -normal[0], -normal[1]}, gap, 4});
  }
  Matrix dense(const std::vector<ContactState>& status) const {
    int count = 0;
    for (const ContactState& s : status) count += s.closed();
    Matrix c = Matrix::Zero(count, 9);
    int r = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!status[i].closed()) continue;
      for (std::size_t k = 0; k < rows[i].places.size(); ++k) c(r, rows[i].places[k]) += rows[i].coefficients[k];
      ++r;
    }
    return c;
  }
};

// Columns: the space that the relations leave free.
Matrix freeColumns(const std::vector<InterfaceRelation>& relations, int unknowns) {
  Matrix t = Matrix::Identity(unknowns, unknowns);
  for (const InterfaceRelation& relation : relations) {
    t.row(relation.unknown).setZero();
    for (std::size_t k = 0; k < relation.others.size(); ++k) t(relation.unknown, relation.others[k]) = relation.coefficients[k];
  }
  std::vector<char> expressed(unknowns, 0);
  for (const InterfaceRelation& relation : relations) expressed[relation.unknown] = 1;
  Matrix columns(unknowns, 0);
  for (int j = 0; j < unknowns; ++j)
    if (!expressed[j]) {
      columns.conservativeResize(unknowns, columns.cols() + 1);
      columns.col(columns.cols() - 1) = t.col(j);
    }
  return columns;
}

// The same subspace as the null space found by a singular value decomposition.
void spansTheNullSpace(const std::vector<InterfaceRelation>& relations, const Matrix& rows, bool& success, Teuchos::FancyOStream& out) {
  const Matrix columns = freeColumns(relations, int(rows.cols())), expected = nullSpace(rows);
  TEST_EQUALITY(columns.cols(), expected.cols());
  const Matrix basis = orthonormalBasis(columns, 1e-8);
  TEST_EQUALITY(basis.cols(), columns.cols());
  TEST_COMPARE((basis * basis.transpose() - expected * expected.transpose()).norm(), <, 1e-12);
  for (const InterfaceRelation& relation : relations)  // no unknown is expressed by expressed ones
    for (const InterfaceRelation& other : relations)
      TEST_ASSERT(std::find(relation.others.begin(), relation.others.end(), other.unknown) == relation.others.end());
}

// V1 with second-order quadrilaterals: coefficients between 1e-12 and 1e-10, of nodes that a mesher has put nearly on the line, were
// dropped, and nodal pressures wrong by 1.4e-10.
TEUCHOS_UNIT_TEST(ContactClusters, SmallCoefficientsAreKept) {
  Vector stiffness = Vector::Ones(5);
  const ContactClusters clusters({{{0, 2, 3, 4}, {1.0, -0.6, -0.4, 6e-11}, 0.0, 0}, {{1, 2, 3, 4}, {1.0, 3e-11, -0.5, -0.5}, 0.0, 0}},
                                 stiffness);
  Matrix rows(2, 5);
  rows << 1.0, 0.0, -0.6, -0.4, 6e-11, 0.0, 1.0, 3e-11, -0.5, -0.5;
  const Matrix columns = freeColumns(clusters.relations({kClosed, kClosed}), 5);
  TEST_EQUALITY(columns.cols(), 3);
  TEST_COMPARE((rows * columns).cwiseAbs().maxCoeff(), <, 1e-15);
}

TEUCHOS_UNIT_TEST(ContactClusters, RelationsSpanTheNullSpaceOfEverySubsetOfRows) {
  for (const double skew : {1.3, M_PI / 2, 1e-3}) {
    const CrossPoint cross(0.4, skew);
    const ContactClusters clusters(cross.rows, cross.stiffness);
    for (int subset = 0; subset < 16; ++subset) {
      std::vector<ContactState> status(4, kOpen);
      for (int i = 0; i < 4; ++i)
        if (subset >> i & 1) status[i] = kClosed;
      spansTheNullSpace(clusters.relations(status), cross.dense(status), success, out);
    }
  }
}

TEUCHOS_UNIT_TEST(ContactClusters, ARowThatFollowsFromOthersIsLeftOut) {
  CrossPoint cross(0.4, 0.0);  // all normals parallel: around the point the four rows are linearly dependent
  const std::vector<ContactState> closed(4, kClosed);
  TEST_EQUALITY(dense::rank(cross.dense(closed)), 3);
  const ContactClusters clusters(cross.rows, cross.stiffness);
  TEST_EQUALITY(clusters.relations(closed).size(), 3u);
  spansTheNullSpace(clusters.relations(closed), cross.dense(closed), success, out);
}

// Two pairs between Cartesian nodes, each with a row along its normal and one along its tangent: one state determines both.
TEUCHOS_UNIT_TEST(ContactClusters, APairThatSticksHoldsItsTangentToo) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  std::vector<Row> rows;
  for (int component = 0; component < 2; ++component)
    for (int pair = 0; pair < 2; ++pair) {
      const double n[2] = {component == 0 ? c : -s, component == 0 ? s : c};
      rows.push_back({{4 * pair, 4 * pair + 1, 4 * pair + 2, 4 * pair + 3}, {n[0], n[1], -n[0], -n[1]}, 0.0, pair, pair, component});
    }
  const ContactClusters clusters(rows, Vector::LinSpaced(9, 1.0, 5.0));
  const std::vector<PairStatus> all{PairStatus::Open, PairStatus::Slip, PairStatus::Stick};
  for (const PairStatus first : all)
    for (const PairStatus second : all) {
      const std::vector<ContactState> states{first, second};
      Matrix dense(0, 9);
      for (const Row& row : rows) {
        if (states[row.pair] == PairStatus::Open || (row.component == 1 && states[row.pair] != PairStatus::Stick)) continue;
        dense.conservativeResize(dense.rows() + 1, 9);
        dense.row(dense.rows() - 1).setZero();
        for (int k = 0; k < 4; ++k) dense(dense.rows() - 1, row.places[k]) = row.coefficients[k];
      }
      spansTheNullSpace(clusters.relations(states), dense, success, out);
      // Sticking nodes move together: forces of the two rows are those of the vector between the nodes.
      if (first != PairStatus::Stick) continue;
      Vector imbalance = Vector::Zero(9);
      imbalance.head(4) << -3.0, 5.0, 3.0, -5.0;  // side A is pushed back by (3, -5)
      const Vector force = clusters.forces(states, imbalance);
      TEST_FLOATING_EQUALITY(force(0), 3.0 * c - 5.0 * s, 1e-13);
      TEST_FLOATING_EQUALITY(force(2), -3.0 * s - 5.0 * c, 1e-13);
    }
}

TEUCHOS_UNIT_TEST(ContactClusters, ClustersDoNotMeet) {
  // two single rows with normal components for unknowns, one of them against a scaled unknown; one row held on one side; one empty row
  const std::vector<Row> rows{{{0, 1}, {1.0, -1.0}, 0.0, 0}, {{3, 2}, {0.5, -1.0}, 0.1, 1}, {{4}, {1.0}, 0.0, 2}, {{}, {}, 0.3, 3}};
  const ContactClusters clusters(rows, Vector::Constant(6, 2.0));
  const std::vector<InterfaceRelation> all = clusters.relations({kClosed, kClosed, kClosed, kOpen});
  TEST_EQUALITY(all.size(), 3u);
  Matrix dense = Matrix::Zero(3, 6);
  dense(0, 0) = 1.0;
  dense(0, 1) = -1.0;
  dense(1, 3) = 0.5;
  dense(1, 2) = -1.0;
  dense(2, 4) = 1.0;
  spansTheNullSpace(all, dense, success, out);
  TEST_EQUALITY(clusters.relations({kOpen, kOpen, kOpen, kOpen}).size(), 0u);
}

TEUCHOS_UNIT_TEST(ContactClusters, ForceOfASinglePairIsThatOfTheSofterSide) {
  const double soft = 3.0, stiff = 3e6;
  Vector stiffness(2);
  stiffness << stiff, soft;
  const ContactClusters clusters({{{0, 1}, {1.0, -1.0}, 0.0, 0}}, stiffness);
  // 1/k = 1/k_A + 1/k_B
  TEST_FLOATING_EQUALITY(clusters.stiffness()(0), stiff * soft / (stiff + soft), 1e-14);
  // Side A sees the force -f_A, side B +f_B. Weights k_m / (k_s + k_m): the force of the softer side counts (doc/numerics.md).
  Vector imbalance(2);
  imbalance << -5.0, 7.0;
  const double expected = (soft * 5.0 + stiff * 7.0) / (soft + stiff);
  TEST_FLOATING_EQUALITY(clusters.forces({kClosed}, imbalance)(0), expected, 1e-14);
  TEST_FLOATING_EQUALITY(expected, 7.0, 1e-5);
  TEST_EQUALITY(clusters.forces({kOpen}, imbalance)(0), 0.0);
}

TEUCHOS_UNIT_TEST(ContactClusters, ForcesInBalanceAreFoundExactly) {
  const CrossPoint cross;
  const ContactClusters clusters(cross.rows, cross.stiffness);
  const std::vector<ContactState> status{kClosed, kClosed, kOpen, kClosed};
  Vector force(3);
  force << 2.0, -1.5, 4.0;
  // S U - F = -C^T f, forces pull back the unknowns on side A; C^T has full rank here, so that the answer is unique
  const Vector found = clusters.forces(status, -cross.dense(status).transpose() * force);
  TEST_COMPARE(std::abs(found(0) - 2.0) + std::abs(found(1) + 1.5) + std::abs(found(2)) + std::abs(found(3) - 4.0), <, 1e-12);
  // The unbalanced remainder is weighted by compliance: C K^-1 (S U - F + C^T f) = 0
  Vector imbalance = Vector::LinSpaced(9, -1.0, 2.0);
  const Vector f = clusters.forces(status, imbalance);
  Vector closed(3);
  closed << f(0), f(1), f(3);
  const Matrix c = cross.dense(status);
  const Vector rest = c * (imbalance + c.transpose() * closed).cwiseQuotient(cross.stiffness);
  TEST_COMPARE(rest.norm(), <, 1e-12);
}

TEUCHOS_UNIT_TEST(ContactClusters, CorrectionMeetsTheClosedRowsAndIsTheSmallest) {
  const CrossPoint cross;
  const ContactClusters clusters(cross.rows, cross.stiffness);
  const std::vector<ContactState> status{kClosed, kOpen, kClosed, kClosed};
  const Vector trace = Vector::LinSpaced(9, 0.05, -0.07);
  const Vector change = clusters.correction(status, trace), gaps = clusters.gaps(trace + change), before = clusters.gaps(trace);
  for (int i : {0, 2, 3}) TEST_COMPARE(std::abs(gaps(i)), <, 1e-15);
  const Matrix c = cross.dense({kClosed, kClosed, kClosed, kClosed});
  for (int i = 0; i < 4; ++i) TEST_FLOATING_EQUALITY(before(i), cross.rows[i].gap - c.row(i).dot(trace), 1e-14);
  // smallest in the energy of the diagonal: orthogonal, in that energy, to all vectors that do not change the rows
  const Matrix free = nullSpace(cross.dense(status));
  TEST_COMPARE((free.transpose() * cross.stiffness.cwiseProduct(change)).norm(), <, 1e-12 * cross.stiffness.norm() * change.norm());
  TEST_EQUALITY(clusters.correction(status, trace + change).norm(), 0.0);
  TEST_EQUALITY(clusters.correction({kOpen, kOpen, kOpen, kOpen}, trace).norm(), 0.0);
}

}  // namespace
}  // namespace suture
