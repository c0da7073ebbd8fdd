#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/search/DelassusProblem.hpp>

#include <cmath>

namespace suture {

namespace {

constexpr double kRounding = 1e-11;  // round-off of forces, and of deformations by them, in the dense solves
constexpr double kRepeated = 1e-13;  // shift of the scaled diagonal, by which linearly dependent rows share their force

std::vector<int> closedOnes(const PairStates& states) {
  std::vector<int> closed;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].closed()) closed.push_back(static_cast<int>(i));
  return closed;
}

Matrix factorOf(Matrix matrix) {
  Matrix lower;
  for (double shift = kRepeated; shift < 1e-5; shift *= 100.0) {
    Matrix shifted = matrix;
    shifted.diagonal() *= 1.0 + shift;
    if (choleskyFactor(shifted, lower)) return lower;
  }
  throw NumericalError("the compliance of the contact pairs is not positive definite");
}

}  // namespace

DelassusProblem::DelassusProblem(const RigidBodyModel& rigid, const Matrix& compliance, const Vector& open, const Vector& rounding)
    : rigid_(rigid), compliance_(compliance), open_(open), rounding_(rounding.size() > 0 ? rounding : Vector::Zero(open.size())) {
  state_.force = Vector::Zero(open.size());
  state_.amplitude = Vector::Zero(rigid.motions());
}

void DelassusProblem::solveSaddle(const std::vector<int>& closed) {
  state_.force = Vector::Zero(rigid_.pairs());
  state_.amplitude = Vector::Zero(rigid_.motions());
  if (closed.empty()) return;
  // Scale pairs to a unit diagonal, and the motions that they stop to unit columns.
  const Vector scale = Vector(compliance_.diagonal()(closed)).cwiseSqrt().cwiseInverse();
  Matrix w = compliance_(closed, closed);
  w = (scale.asDiagonal() * w * scale.asDiagonal()).eval();
  const Matrix lower = factorOf(w);
  const Matrix rows = rowsAt(rigid_.data().rows, closed);
  const Matrix stopped = rows.cols() > 0 ? orthonormalBasis(Matrix(rows.transpose()), 1e-9) : Matrix(0, 0);
  Matrix g = scale.asDiagonal() * (rows * stopped);
  const Vector columns = g.colwise().norm().cwiseInverse();
  g = (g * columns.asDiagonal()).eval();
  const Matrix inverse = choleskySolve(lower, g);
  const Matrix middle = g.cols() > 0 ? factorOf(g.transpose() * inverse) : Matrix(0, 0);
  const Vector b = scale.cwiseProduct(open_(closed)), e = columns.cwiseProduct(stopped.transpose() * rigid_.data().work);
  Vector f = Vector::Zero(b.size()), a = Vector::Zero(e.size());
  for (int pass = 0; pass < 3; ++pass) {  // refinement, so that the shift of the factor does not affect the result
    const Vector restB = b - w * f + g * a, restE = e - g.transpose() * f;
    const Vector y = choleskySolve(lower, restB);
    const Vector da = e.size() > 0 ? Vector(choleskySolve(middle, restE - g.transpose() * y)) : e;
    a += da;
    f += y + inverse * da;
  }
  const Vector scaled = scale.cwiseProduct(f);
  for (std::size_t i = 0; i < closed.size(); ++i) state_.force(closed[i]) = scaled(static_cast<Eigen::Index>(i));
  if (e.size() > 0) state_.amplitude = stopped * columns.cwiseProduct(a);
}

ContactAnswer DelassusProblem::solve(const PairStates& states, double) {
  const std::vector<int> closed = closedOnes(states);
  ClosedSet set(states.size(), 0);
  for (const int i : closed) set[static_cast<std::size_t>(i)] = 1;
  solveSaddle(closed);
  const Vector deformed = compliance_ * state_.force;
  Vector penetration = open_ - deformed + rigid_.data().rows * state_.amplitude;
  for (const int i : closed) penetration(i) = 0.0;
  ContactAnswer answer;
  answer.force = answer.jump = Matrix::Zero(rigid_.pairs(), 3);
  answer.force.col(0) = state_.force;
  answer.jump.col(0) = penetration;
  answer.forceTolerance = kRounding * rigid_.clusterScale(set, state_.force);
  answer.jumpTolerance = kRounding * rigid_.clusterScale(set, deformed) + 1e-13 * open_.cwiseAbs() + rounding_ +
                         1e-13 * (rigid_.data().rows.cwiseAbs() * state_.amplitude.cwiseAbs());
  answer.energy = open_.dot(state_.force) - 0.5 * state_.force.dot(deformed);
  answer.solved = state_.force.allFinite() && state_.amplitude.allFinite();
  return answer;
}

}  // namespace suture
