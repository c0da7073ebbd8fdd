// Contact rows whose normal forces induce tangential forces: relations of the virtual displacements, and forces.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/DenseAlgebra.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/interface/ContactClusters.hpp>

#include <cmath>
#include <random>
#include <set>

namespace suture {
namespace {

/// Random pairs of one cluster between nodes with Cartesian unknowns: each has a frame, a carrying node and one partner or several.
struct RandomRows {
  std::vector<ContactClusters::Row> rows;  // those along the normals first
  int dimension, pairs, unknowns;
  Vector stiffness;

  /// \param sharing  nodes in two pairs each;  \param partners  nodes on the other side, mortars' more than one
  RandomRows(std::mt19937& random, int dims, int count, bool sharing, int partners) : dimension(dims), pairs(count) {
    std::normal_distribution<double> value;
    const int others = sharing ? std::max({2, partners, (count + 1) / 2}) : count + partners - 1;
    unknowns = dimension * (count + others) + 1;
    stiffness = Vector(unknowns);
    for (double& k : stiffness) k = std::exp(2.0 * value(random));
    std::vector<Matrix> frames;
    std::vector<std::vector<std::pair<int, double>>> ends;
    for (int p = 0; p < count; ++p) {
      Matrix a(dimension, dimension);
      for (double& x : a.reshaped()) x = value(random);
      frames.push_back(dense::orthogonal(a));
      ends.push_back({{p, 1.0}});
      double left = 1.0;
      for (int k = 0; k < partners; ++k) {
        const double share = k + 1 < partners ? left * (0.3 + 0.2 * std::tanh(value(random))) : left;
        left -= share;
        ends.back().emplace_back(count + (p + k) % others, -share);
      }
    }
    for (int component = 0; component < dimension; ++component)
      for (int p = 0; p < count; ++p) {
        ContactClusters::Row row;
        row.cluster = partners > 1 || sharing ? 0 : p;
        row.pair = p;
        row.component = component;
        for (const auto& [node, weight] : ends[p])
          for (int k = 0; k < dimension; ++k) {
            row.places.push_back(dimension * node + k);
            row.coefficients.push_back(weight * frames[p](k, component));
          }
        rows.push_back(row);
      }
  }
  Vector denseRow(const ContactClusters::Row& row) const {
    Vector all = Vector::Zero(unknowns);
    for (std::size_t k = 0; k < row.places.size(); ++k) all(row.places[k]) += row.coefficients[k];
    return all;
  }
  /// Holding rows, with and without the tangential forces induced by normal forces.
  void dense(const std::vector<ContactState>& states, Matrix& holds, Matrix& drags) const {
    std::vector<Vector> first, second;
    for (const ContactClusters::Row& row : rows) {
      const ContactState& state = states[row.pair];
      if (state.status == PairStatus::Open || (row.component > 0 && state.status != PairStatus::Stick)) continue;
      first.push_back(denseRow(row));
      second.push_back(first.back());
      if (state.status == PairStatus::Slip && row.component == 0)
        for (int component = 1; component < dimension; ++component)
          second.back() += state.friction * state.direction[component] * denseRow(rows[component * pairs + row.pair]);
    }
    holds = drags = Matrix(Eigen::Index(first.size()), unknowns);
    for (std::size_t i = 0; i < first.size(); ++i) holds.row(Eigen::Index(i)) = first[i], drags.row(Eigen::Index(i)) = second[i];
  }
  std::vector<ContactState> someStates(std::mt19937& random, double friction) const {
    std::uniform_real_distribution<double> value(0.0, 1.0);
    std::vector<ContactState> states;
    for (int p = 0; p < pairs; ++p) {
      const double choice = value(random), angle = 2 * M_PI * value(random);
      if (choice < 0.2)
        states.emplace_back(PairStatus::Open);
      else if (choice < 0.45)
        states.emplace_back(PairStatus::Stick);
      else
        states.emplace_back(PairStatus::Slip,
                            dimension == 2 ? Point{0, angle < M_PI ? 1.0 : -1.0, 0} : Point{0, std::cos(angle), std::sin(angle)},
                            value(random), value(random) < 0.2 ? 0.0 : friction * value(random));
    }
    return states;
  }
};

/// Columns of the matrix of relations that are not expressed, and the unknowns that are.
Matrix columnsOf(const std::vector<InterfaceRelation>& relations, int unknowns, std::set<int>& expressed) {
  Matrix t = Matrix::Identity(unknowns, unknowns);
  expressed.clear();
  for (const InterfaceRelation& relation : relations) {
    expressed.insert(relation.unknown);
    t.row(relation.unknown).setZero();
    for (std::size_t k = 0; k < relation.others.size(); ++k) t(relation.unknown, relation.others[k]) = relation.coefficients[k];
  }
  std::vector<int> free;
  for (int j = 0; j < unknowns; ++j)
    if (expressed.count(j) == 0) free.push_back(j);
  return t(Eigen::all, free);
}

double offNullSpace(const Matrix& columns, const Matrix& rows) {
  const Matrix basis = orthonormalBasis(columns, 1e-10), expected = nullSpace(rows, 1e-10);
  if (basis.cols() != expected.cols() || basis.cols() != columns.cols()) return 1e300;
  return (basis * basis.transpose() - expected * expected.transpose()).norm();
}

TEUCHOS_UNIT_TEST(DraggingClusters, TestRelationsSpanTheNullSpaceOfTheDraggedRows) {
  std::mt19937 random(1);
  double worst = 0.0;
  int dragged = 0;
  for (const int dimension : {2, 3})
    for (const bool sharing : {false, true})
      for (const int partners : {1, 2, 4})
        for (const double friction : {0.1, 0.6, 1.5})
          for (int trial = 0; trial < 10; ++trial) {
            const RandomRows given(random, dimension, 1 + trial % 6, sharing, partners);
            const ContactClusters clusters(given.rows, given.stiffness);
            const std::vector<ContactState> states = given.someStates(random, friction);
            Matrix holds, drags;
            given.dense(states, holds, drags);
            if (holds.rows() == 0 || dense::rank(drags) < drags.rows() || dense::rank(holds) < holds.rows()) continue;
            std::vector<InterfaceRelation> test;
            std::set<int> expressed, inTest;
            const Matrix t = columnsOf(clusters.relations(states, &test), given.unknowns, expressed);
            worst = std::max(worst, offNullSpace(t, holds) / (1.0 + t.norm()));
            const bool any = std::any_of(states.begin(), states.end(), [](const ContactState& state) { return state.couplesToNormal(); });
            TEST_EQUALITY(test.empty(), !any);
            if (test.empty()) continue;
            ++dragged;
            const Matrix dual = columnsOf(test, given.unknowns, inTest);
            worst = std::max(worst, offNullSpace(dual, drags) / (1.0 + dual.norm()));
            TEST_ASSERT(inTest == expressed);
            for (const InterfaceRelation& relation : test)
              for (const int other : relation.others) TEST_EQUALITY(inTest.count(other), 0u);
          }
  out << dragged << " with friction, worst " << worst << "\n";
  TEST_COMPARE(dragged, >, 150);
  TEST_COMPARE(worst, <, 1e-9);
}

// Rows in balance: the imbalance of planted forces along normals and tangents gives these forces back.
TEUCHOS_UNIT_TEST(DraggingClusters, PlantedForcesAreFoundAgain) {
  std::mt19937 random(2);
  std::normal_distribution<double> value;
  double worst = 0.0;
  int count = 0;
  for (const int dimension : {2, 3})
    for (const bool sharing : {false, true})
      for (const int partners : {1, 3})
        for (int trial = 0; trial < 40; ++trial) {
          const RandomRows given(random, dimension, 1 + trial % 5, sharing, partners);
          const ContactClusters clusters(given.rows, given.stiffness);
          const std::vector<ContactState> states = given.someStates(random, 0.8);
          Matrix holds, drags;
          given.dense(states, holds, drags);
          if (drags.rows() == 0 || dense::singularValues(drags).minCoeff() < 1e-3) continue;
          Vector planted = Vector::Zero(clusters.size()), imbalance = Vector::Zero(given.unknowns);
          for (int i = 0; i < clusters.size(); ++i) {
            const ContactClusters::Row& row = given.rows[i];
            const ContactState& state = states[row.pair];
            if (!state.closed() || (row.component > 0 && state.status != PairStatus::Stick)) continue;
            planted(i) = 2.0 + value(random);
            imbalance -= planted(i) * given.denseRow(row);
            // A pair that slips under Coulomb's law: its normal force induces a tangential force of friction times itself.
            if (row.component == 0 && state.status == PairStatus::Slip)
              for (int component = 1; component < dimension; ++component)
                imbalance -= planted(i) * state.friction * state.direction[component] *
                             given.denseRow(given.rows[component * given.pairs + row.pair]);
          }
          worst = std::max(worst, (clusters.forces(states, imbalance) - planted).norm() / planted.norm());
          ++count;
        }
  TEST_COMPARE(count, >, 200);
  TEST_COMPARE(worst, <, 1e-8);
}

TEUCHOS_UNIT_TEST(DraggingClusters, NothingDragsWhereNoForceIsProportionalToTheNormalOne) {
  std::mt19937 random(3);
  const RandomRows given(random, 3, 3, false, 1);
  const ContactClusters clusters(given.rows, given.stiffness);
  std::vector<InterfaceRelation> test(1);
  const std::vector<ContactState> states{PairStatus::Stick, {PairStatus::Slip, {0, 0.6, 0.8}, 3.0}, PairStatus::Open};
  TEST_EQUALITY(clusters.relations(states, &test).size(), 4u);
  TEST_ASSERT(test.empty());
}

}  // namespace
}  // namespace suture
