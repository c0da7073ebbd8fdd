#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/reference/FrictionConditions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double ofStiffness = 0.1;        // c relative to the local stiffness
constexpr double accuracy = 1e-11;         // accuracy of forces, relative to the largest
constexpr double singular = 1e12;          // condition number of the scaled equations above which a step is rejected
constexpr double givesWay = 1e-10;         // compliance of a tangential row without free nodes, relative to the largest
constexpr double roundoff = 1e-15;         // round-off of a jump, relative to the sizes of its terms
constexpr double beyondItsElements = 2.0;  // ratio of a row's compliance to that of its elements (as in ContactCompliance)
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

bool FrictionConditions::Branch::like(const Branch& other) const {
  return pressed == other.pressed && sliding == other.sliding && (sliding != Sliding::Slip || dot(direction, other.direction) > 0.99);
}

FrictionConditions::FrictionConditions(const CondensedContact& problem, const Delassus& delassus)
    : pairs_(problem.pairs),
      open_(delassus.open()),
      work_(delassus.work()),
      compliance_(delassus.compliance()),
      motions_(delassus.motions()),
      rounding_(delassus.rounding()) {
  const double largest = compliance_.size() > 0 ? compliance_.diagonal().maxCoeff() : 0.0;
  const double least = largest > 0.0 ? givesWay * largest : 1.0;
  local_ = compliance_.diagonal();
  for (int i = 0; i < rows(); ++i) {
    if (problem.dofs[i].empty()) local_[i] = compliance_(i, i) = least;
    double own = 0.0;
    for (std::size_t k = 0; k < problem.dofs[i].size(); ++k)
      own += problem.coefficients[i][k] * problem.coefficients[i][k] / problem.stiffness(problem.dofs[i][k], problem.dofs[i][k]);
    if (own > 0.0) local_[i] = std::min(local_[i], beyondItsElements * own);
  }
  sizes_ = compliance_.cwiseAbs();
  factor_ = Vector::Zero(rows());
  scale_ = local_.cwiseSqrt().cwiseInverse();
  for (const CondensedContact::Pair& pair : pairs_) {
    able_.push_back(!problem.dofs[pair.first].empty());
    touches_.push_back(problem.bounds[pair.first] <= 0.0);
    factor_[pair.first] = able_.back() ? ofStiffness / compliance_(pair.first, pair.first) : 0.0;
    if (pair.rows == 1) continue;
    // One factor for both tangents, so that the trial force of a slipping pair points along its slip.
    const auto own = Eigen::seqN(pair.first + 1, pair.rows - 1);
    factor_(own).setConstant(ofStiffness / compliance_.diagonal()(own).maxCoeff());
  }
  amplitude_ = Vector::Ones(motions());
  for (int m = 0; m < motions(); ++m) {
    const double size = motions_.col(m).cwiseProduct(scale_).norm();
    if (size > 0.0) amplitude_[m] = 1.0 / size;
  }
}

FrictionConditions::Evaluation FrictionConditions::begin(const Unknowns& at) const {
  Evaluation evaluation;
  evaluation.jump = open_ - compliance_ * at.force + motions_ * at.place;
  evaluation.defect = work_ - motions_.transpose() * at.force;
  evaluation.branches.resize(pairs_.size());
  return evaluation;
}

ContactState FrictionConditions::project(std::size_t pair, const Point& force, const Point& jump, const ContactState& now) const {
  ContactTrial trial;
  trial.force = force;
  trial.jump = jump;
  trial.place = pairs_[pair].place;
  trial.size = pairs_[pair].size;
  trial.slipped = pairs_[pair].slipped;
  if (able_[pair]) return pairs_[pair].law->project(trial, now);
  trial.force[0] = trial.jump[0] = 0.0;
  return pairs_[pair].law->project(trial, touches_[pair] ? PairStatus::Slip : PairStatus::Open);
}

Vector FrictionConditions::projection(const Evaluation& evaluation, const Vector& trial) const {
  Vector all = Vector::Zero(rows());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Branch& branch = evaluation.branches[p];
    const int first = pairs_[p].first;
    if (branch.pressed) all[first] = trial[first];
    for (int k = 1; k < pairs_[p].rows; ++k) {
      if (branch.sliding == Sliding::Stick) all[first + k] = trial[first + k];
      if (branch.sliding == Sliding::Slip) all[first + k] = branch.bound * branch.direction[k];
    }
  }
  return all;
}

void FrictionConditions::finish(const Unknowns& at, const Vector& projection, Evaluation& evaluation) const {
  evaluation.residual = at.force - projection;
  evaluation.merit = std::hypot(evaluation.residual.norm(), evaluation.defect.norm());
  const auto over = [](double value, double tolerance) { return value == 0.0 ? 0.0 : tolerance > 0.0 ? value / tolerance : infinite; };
  const double size = rows() == 0 ? 0.0 : std::max(at.force.cwiseAbs().maxCoeff(), projection.cwiseAbs().maxCoeff());
  evaluation.error = evaluation.violation = 0.0;
  double noise = 0.0;
  const Vector rounding = rounding_ + roundoff * (sizes_ * at.force.cwiseAbs() + motions_.cwiseAbs() * at.place.cwiseAbs());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const Branch& branch = evaluation.branches[p];
    for (int k = 0; k < pairs_[p].rows; ++k) {
      const int i = pairs_[p].first + k;
      const double residual = std::abs(evaluation.residual[i]);
      // A jump that should vanish is measured by its force in the row's own elements, which is independent of soft springs under the body.
      const bool isJump = factor_[i] > 0.0 && (k == 0 ? branch.pressed : branch.sliding == Sliding::Stick);
      const double tolerance = accuracy * size * (isJump ? factor_[i] * local_[i] / ofStiffness : 1.0);
      evaluation.error = std::max(evaluation.error, over(residual, tolerance + factor_[i] * rounding_[i]));
      noise = std::max(noise, over(residual, tolerance + factor_[i] * rounding[i]));
      evaluation.violation = std::max(evaluation.violation, isJump ? residual / factor_[i] : residual * local_[i]);
    }
  }
  double unbalanced = 0.0;
  for (int m = 0; m < motions(); ++m)
    unbalanced = std::max(unbalanced, over(std::abs(evaluation.defect[m]),
                                           accuracy * (motions_.col(m).cwiseAbs().dot(at.force.cwiseAbs()) + std::abs(work_[m]))));
  evaluation.error = std::max(evaluation.error, unbalanced);
  evaluation.withinRounding = std::max(noise, unbalanced) <= 1.0;
}

FrictionConditions::Evaluation FrictionConditions::evaluate(const Unknowns& at, const States& now) const {
  Evaluation evaluation = begin(at);
  const Vector z = trial(at, evaluation.jump);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const CondensedContact::Pair& pair = pairs_[p];
    Point force{0, 0, 0}, jump{0, 0, 0};
    for (int k = 0; k < pair.rows; ++k) {
      force[k] = at.force[pair.first + k];
      jump[k] = factor_[pair.first + k] * evaluation.jump[pair.first + k];
    }
    const ContactState state = project(p, force, jump, now[p]);
    Branch& branch = evaluation.branches[p];
    branch.pressed = able_[p] && (state.closed() || !pair.law->separates());
    branch.normal = z[pair.first];
    for (int k = 1; k < pair.rows; ++k) branch.length = std::hypot(branch.length, z[pair.first + k]);
    if (pair.rows > 1 && state.status == PairStatus::Stick) branch.sliding = Sliding::Stick;
    if (pair.rows > 1 && state.status == PairStatus::Slip && norm(state.direction) > 0.0) {
      branch.sliding = Sliding::Slip;
      branch.direction = state.direction;
      branch.bound = state.largest(branch.normal);
      branch.slope = branch.normal > 0.0 && branch.bound > 0.0 ? state.friction : 0.0;
    }
    evaluation.states.push_back(state);
  }
  finish(at, projection(evaluation, z), evaluation);
  return evaluation;
}

FrictionConditions::Evaluation FrictionConditions::evaluate(const Unknowns& at, const Vector& bounds) const {
  Evaluation evaluation = begin(at);
  const Vector z = trial(at, evaluation.jump);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const CondensedContact::Pair& pair = pairs_[p];
    Branch& branch = evaluation.branches[p];
    const double bound = bounds[Eigen::Index(p)];
    branch.normal = z[pair.first];
    branch.pressed = able_[p] && (branch.normal > 0.0 || !pair.law->separates());
    for (int k = 1; k < pair.rows; ++k) branch.length = std::hypot(branch.length, z[pair.first + k]);
    if (pair.rows == 1 || bound == 0.0) continue;
    if (branch.length <= bound) {
      branch.sliding = Sliding::Stick;
      continue;
    }
    branch.sliding = Sliding::Slip;
    branch.bound = bound;
    for (int k = 1; k < pair.rows; ++k) branch.direction[k] = z[pair.first + k] / branch.length;
  }
  finish(at, projection(evaluation, z), evaluation);
  return evaluation;
}

std::vector<FrictionConditions::Branch> FrictionConditions::branchesOf(const States& states) const {
  std::vector<Branch> branches(pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const ContactState& state = states[p];
    Branch& branch = branches[p];
    branch.pressed = able_[p] && (state.closed() || !pairs_[p].law->separates());
    if (pairs_[p].rows == 1 || !state.closed()) continue;
    if (state.status == PairStatus::Stick) branch.sliding = Sliding::Stick;
    if (state.status == PairStatus::Stick || norm(state.direction) == 0.0) continue;
    branch.sliding = Sliding::Slip;
    branch.direction = state.direction;
    branch.bound = state.bound;
    branch.slope = state.friction;
  }
  return branches;
}

Vector FrictionConditions::bounds(const Unknowns& at, const States& now) const {
  constexpr double beyond = 1e150;  // exceeds every finite bound
  const Evaluation evaluation = begin(at);
  const Vector z = trial(at, evaluation.jump);
  Vector bounds = Vector::Zero(Eigen::Index(pairs_.size()));
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const CondensedContact::Pair& pair = pairs_[p];
    if (pair.rows == 1) continue;
    Point force{at.force[pair.first], 0, 0}, jump{z[pair.first] - at.force[pair.first], 0, 0}, along{0, 0, 0};
    for (int k = 1; k < pair.rows; ++k) along[k] = z[pair.first + k];
    const double length = norm(along);
    for (int k = 1; k < pair.rows; ++k) jump[k] = beyond * (length > 0.0 ? along[k] / length : k == 1 ? 1.0 : 0.0);
    const ContactState state = project(p, force, jump, now[p]);
    if (state.status == PairStatus::Stick) bounds[Eigen::Index(p)] = infinite;
    if (state.status == PairStatus::Slip) bounds[Eigen::Index(p)] = state.largest(z[pair.first]);
  }
  return bounds;
}

bool FrictionConditions::solveOnce(const std::vector<Branch>& branches, const Unknowns& at, double held, double drag,
                                   Unknowns& next) const {
  std::vector<int> unknown;  // rows with unknown forces
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (branches[p].pressed) unknown.push_back(pairs_[p].first);
    if (branches[p].sliding != Sliding::Free)
      for (int k = 1; k < pairs_[p].rows; ++k) unknown.push_back(pairs_[p].first + k);
  }
  const int forces = int(unknown.size()), all = forces + motions();
  next = {Vector::Zero(rows()), at.place};
  if (all == 0) return true;
  std::vector<int> place(rows(), -1);
  for (int i = 0; i < forces; ++i) place[unknown[i]] = i;

  // Jumps of the rows as functions of the unknowns, with added compliance if forces are held.
  Matrix jumps(forces, all);
  jumps.leftCols(forces) = -compliance_(unknown, unknown);
  jumps.rightCols(motions()) = motions_(unknown, Eigen::all);
  Matrix a = Matrix::Zero(all, all);
  Vector b = Vector::Zero(all), scale(all), rowScale(all);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const int first = pairs_[p].first;
    const Branch& branch = branches[p];
    for (int k = 0; k < pairs_[p].rows; ++k) {
      const int row = first + k, i = place[row];
      if (i < 0) continue;
      scale[i] = scale_[row];
      if (k > 0 && branch.sliding == Sliding::Slip) {
        rowScale[i] = 1.0 / scale_[row];
        a(i, i) += 1.0;
        if (place[first] >= 0) a(i, place[first]) -= branch.slope * branch.direction[k];
        b[i] = (branch.bound - branch.slope * branch.normal) * branch.direction[k];
        if (pairs_[p].rows == 2 || branch.length == 0.0) continue;
        // The slip direction turns with the transverse trial force.
        for (int l = 1; l < pairs_[p].rows; ++l) {
          const double across = branch.bound / branch.length * ((k == l ? 1.0 : 0.0) - branch.direction[k] * branch.direction[l]);
          const int other = place[first + l];
          a(i, other) -= across;
          a.row(i) -= across * factor_[first + l] * jumps.row(other);
          b[i] += across * factor_[first + l] * open_[first + l];
        }
      } else {
        rowScale[i] = scale_[row];
        const double soft = held * local_[row];
        a.row(i) = jumps.row(i);
        a(i, i) -= soft;
        b[i] = -open_[row] - soft * at.force[row];
      }
    }
  }
  a.bottomLeftCorner(motions(), forces) = motions_(unknown, Eigen::all).transpose();
  for (int m = 0; m < motions(); ++m) {
    const int i = forces + m;
    scale[i] = rowScale[i] = amplitude_[m];
    const double against = drag / (amplitude_[m] * amplitude_[m]);
    a(i, i) += against;
    b[i] = work_[m] + against * at.place[m];
  }
  const Matrix scaled = rowScale.asDiagonal() * a * scale.asDiagonal();
  double condition = 0.0;
  const Matrix inverse = generalInverse(scaled, condition);
  if (!(condition < (drag > 0.0 ? 1e3 * singular : singular))) return false;
  const Vector right = rowScale.cwiseProduct(b);
  Vector x = inverse * right;
  for (int refined = 0; refined < 2; ++refined) x += inverse * (right - scaled * x);
  x = x.cwiseProduct(scale).eval();
  if (!x.allFinite()) return false;
  for (int i = 0; i < forces; ++i) next.force[unknown[i]] = x[i];
  next.place = x.tail(motions());
  return true;
}

FrictionConditions::Solved FrictionConditions::solve(const std::vector<Branch>& branches, const Unknowns& at, double drag,
                                                     Unknowns& next) const {
  if (solveOnce(branches, at, 0.0, 0.0, next)) return Solved::Exactly;
  if (solveOnce(branches, at, kHold, 0.0, next)) return Solved::Held;
  if (motions() > 0 && solveOnce(branches, at, kHold, drag, next)) return Solved::Dragged;
  return Solved::Not;
}

}  // namespace suture
