// FrictionSearch: the complementarity problem of few pairs.
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/algebra/dense/LinearComplementarity.hpp>
#include <suture/contact/FrictionSearch.hpp>
#include <suture/contact/PadProblem.hpp>
#include <suture/contact/PairResponse.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

constexpr std::size_t kMostRows = 240;  // maximum number of rows; each takes a solve
constexpr int kSides = 8;               // sides of the pyramid in a friction cone
constexpr std::array<double, 3> kSoft{
    1e-7, 1e-5, 1e-3};                   // springs of unconstrained bodies, relative to the mean stiffness of a row; limited by round-off
constexpr double kHeldBySprings = 1e-3;  // force of these springs, relative to the loads, above which nothing else holds the bodies
constexpr double kHoldsAnything = 1e3;   // bound of a pair that no force makes slip, relative to the largest force
constexpr double kTouches = 1e-12;       // normal force at which the bound of an unloaded pair is evaluated, relative to the largest force
constexpr double kPushed = 1e150;        // slip, as a force, beyond any finite bound
constexpr int kRounds = 6;               // maximum number of problems, each with bounds from the previous one
constexpr int kPivotPatience = 3;        // steps from its states that change all violated pairs without reducing their number
constexpr int kPivotSolves = 30;         // solves from its states

}  // namespace

/// Forces and jumps of the pairs' complementarity problem (Klarbring 1986; Anitescu and Potra 1997):
///     0 <= force along a direction  |  open + A force + spin >= 0,      0 <= spin  |  bound + mu normal - sum of tangential ones >= 0
/// with the compliance A of the pairs and a pyramid for each friction cone. Lemke's pivots find a solution for any friction if bodies are
/// held; unconstrained ones get soft springs. False if no solution exists without these springs.
bool FrictionSearch::pivot(const PairResponse& response, double softness, FrictionAnswer& found) const {
  const RigidContact::Pairs& data = rigid_.data();
  const std::vector<PairResponse::Row>& rows = response.rows();
  const Eigen::Index n = response.stuck().size();
  const double stiff = response.stiffness().diagonal().mean(), force = response.stuck().cwiseAbs().maxCoeff();
  Matrix springs = Matrix::Zero(n, n);
  if (rigid_.motions() > 0) {
    Matrix motions(n, rigid_.motions());
    for (Eigen::Index r = 0; r < n; ++r) {
      const auto at = static_cast<Eigen::Index>(rows[r].pair);
      motions.row(r) = rows[r].component == 0 ? data.rows.row(at) : data.tangents[rows[r].component - 1].row(at);
    }
    const Matrix basis = orthonormalBasis(motions, kDependentRows);
    springs = softness * stiff * basis * basis.transpose();
  }
  double condition = 0.0;
  const Matrix compliance = generalInverse(response.stiffness() + springs, condition);
  if (!std::isfinite(condition)) return false;
  // Unknowns: forces along directions and the spin of each pair with friction, each scaled to its unit.
  const int sides = data.tangents.size() == 2 ? kSides : 2;
  std::vector<Eigen::Index> rubs;                     // normal rows of pairs with friction
  std::vector<std::pair<Eigen::Index, int>> columns;  // normal row of each direction's pair, and its side; -1: the normal
  for (Eigen::Index r = 0; r < n; ++r) {
    if (rows[r].component > 0) continue;
    columns.emplace_back(r, -1);
    if (r + 1 == n || rows[r + 1].component == 0) continue;
    rubs.push_back(r);
    for (int side = 0; side < sides; ++side) columns.emplace_back(r, side);
  }
  const auto forces = static_cast<Eigen::Index>(columns.size()), all = forces + static_cast<Eigen::Index>(rubs.size());
  Matrix directions = Matrix::Zero(n, forces);
  for (Eigen::Index c = 0; c < forces; ++c) {
    const auto [row, side] = columns[c];
    const double angle = 2.0 * M_PI * side / sides;
    if (side < 0) directions(row, c) = 1.0;
    if (side >= 0) directions(row + 1, c) = std::cos(angle);
    if (side >= 0 && sides > 2) directions(row + 2, c) = std::sin(angle);
  }
  Matrix m = Matrix::Zero(all, all);
  m.topLeftCorner(forces, forces) = stiff * directions.transpose() * compliance * directions;
  Vector q = Vector::Zero(all);
  q.head(forces) = -stiff / force * (directions.transpose() * (compliance * response.stuck()));
  Vector normals = response.stuck().cwiseMax(0.0);
  std::vector<char> isOpen(static_cast<std::size_t>(n), 0);
  for (int round = 0; round < kRounds; ++round) {
    bool changes = round == 0;
    for (std::size_t k = 0; k < rubs.size(); ++k) {
      const Eigen::Index spin = forces + static_cast<Eigen::Index>(k), row = rubs[k];
      const std::size_t pair = rows[row].pair;
      ContactTrial trial;
      trial.place = sites_[pair].place;
      trial.size = sites_[pair].size;
      trial.slipped = sites_[pair].slipped;
      trial.force[0] = std::max(normals(row), kTouches * force);
      trial.jump = {0.0, kPushed, 0.0};
      const ContactState state = laws_.of(data.line[pair]).project(trial, PairStatus::Slip);
      const bool slips = state.status == PairStatus::Slip;
      // A pair that has opened has no tangential force; the bound of its law is that of a closed pair.
      const double bound = isOpen[static_cast<std::size_t>(row)] ? 0.0
                           : slips                               ? state.bound / force
                                                                 : kHoldsAnything,
                   slope = slips ? state.friction : 0.0;
      changes = changes || q(spin) != bound;
      q(spin) = bound;
      for (Eigen::Index c = 0; c < forces; ++c) {
        if (columns[c].first != row) continue;
        if (columns[c].second < 0) changes = changes || m(spin, c) != slope;
        m(spin, c) = columns[c].second < 0 ? slope : -1.0;
        if (columns[c].second >= 0) m(c, spin) = 1.0;
      }
    }
    if (!changes) break;
    const std::optional<Vector> solution = linearComplementarity(m, q);
    if (!solution) return false;
    const Vector felt = force * (directions * solution->head(forces)), jump = compliance * (response.stuck() - felt);
    if ((springs * jump).norm() > kHeldBySprings * response.stuck().norm()) return false;
    found.force = response.spread(felt, data.rows.rows());
    found.jump = response.spread(jump, data.rows.rows());
    normals = felt;
    for (Eigen::Index r = 0; r < n; ++r) isOpen[static_cast<std::size_t>(r)] = !(felt(r) > 0.0);
  }
  return true;
}

/// Solves the complementarity problem if pairs are few, and continues from its states by Newton steps.
FrictionSearch::End FrictionSearch::solveByPivots() {
  stick();
  PairResponse response;
  const bool measured = response.measure(rigid_, oracle_, states_, kMostRows);
  solves_ += response.solves();
  FrictionAnswer found;
  const auto holds = [&](double softness) { return pivot(response, softness, found); };
  if (!measured || std::none_of(kSoft.begin(), kSoft.end(), holds)) return End::Exhausted;
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (rigid_.data().able[i] && !(found.force(static_cast<Eigen::Index>(i), 0) > 0.0)) states_[i] = PairStatus::Open;
  PairStates next;
  violation(found.force, found.jump, &next);
  states_ = guarded(next, next);
  tolerance_ = oracle_.loosest();
  patience_ = kPivotPatience;
  return limited(kPivotSolves, oracle_.tightest());
}

}  // namespace suture
