#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/monolithic/DelassusFriction.hpp>
#include <suture/search/LawProjection.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kAccuracy = 1e-11;   // round-off of forces, and of deformations by them, in the dense solves
constexpr double kDigits = 1e-13;     // round-off of a jump, relative to the sizes of its terms
constexpr double kShared = 1e-10;     // compliance by which rows that nearly repeat each other share their force, relative to their own
constexpr int kRefined = 2;           // steps of refinement, so that this compliance does not affect the result
constexpr double kSingular = 1e15;    // condition number of the scaled equations above which there is no solution
constexpr double kGivesWay = 1e-10;   // compliance of a row without free nodes, relative to the largest
constexpr double kDependent = 1e-9;   // singular value of rows (of order one) below which they leave a motion free
constexpr double kOwnElements = 2.0;  // ratio of a row's compliance to that of its elements (as in ContactCompliance)

}  // namespace

DelassusFriction::DelassusFriction(const CondensedContact& problem, const Delassus& delassus,
                                   std::function<void(const ActiveSetStep&)> step)
    : problem_(problem), delassus_(delassus), step_(std::move(step)) {
  const Matrix& h = delassus.compliance();
  const int rows = static_cast<int>(problem.bounds.size()), pairs = static_cast<int>(problem.pairs.size());
  const double largest = rows > 0 ? h.diagonal().maxCoeff() : 0.0, least = largest > 0.0 ? kGivesWay * largest : 1.0;
  local_ = Vector::Constant(rows, least);
  for (int i = 0; i < rows; ++i) {
    if (problem.nodal.size() > 0) {
      if (problem.nodal(i) > 0.0) local_(i) = kOwnElements * problem.nodal(i);
      continue;
    }
    double own = 0.0;
    for (std::size_t k = 0; k < problem.dofs[i].size(); ++k)
      own += problem.coefficients[i][k] * problem.coefficients[i][k] / problem.stiffness(problem.dofs[i][k], problem.dofs[i][k]);
    if (own > 0.0) local_(i) = std::min(h(i, i), kOwnElements * own);
  }

  std::vector<std::shared_ptr<const ContactLaw>> laws;
  RigidBodyModel::Pairs data;
  // Pairs that never open hold bodies whatever their forces: the motions of the rigid-body model leave them unchanged.
  std::vector<int> bound;
  for (const CondensedContact::Pair& pair : problem.pairs)
    for (int k = 0; k < pair.rows && !pair.law->separates(); ++k) bound.push_back(pair.first + k);
  free_ = Matrix::Identity(delassus.motions().cols(), delassus.motions().cols());
  if (free_.cols() > 0 && !bound.empty()) free_ = nullSpace(delassus.motions()(bound, Eigen::all), kDependent);
  const Matrix motions = delassus.motions() * free_;
  data.work = free_.transpose() * delassus.work();
  data.penetration = Vector::Zero(pairs);
  data.stiffness = Vector::Ones(pairs);
  data.surfaces = problem.surfaces;
  data.bound.assign(pairs, 0);
  int tangents = 0;
  for (const CondensedContact::Pair& pair : problem.pairs) tangents = std::max(tangents, pair.rows - 1);
  std::vector<Matrix> effects(1 + tangents, Matrix::Zero(pairs, motions.cols()));  // by component
  for (int p = 0; p < pairs; ++p) {
    const CondensedContact::Pair& pair = problem.pairs[p];
    const bool free = !problem.dofs[pair.first].empty();
    for (int k = 0; k < pair.rows; ++k) effects[k].row(p) = motions.row(pair.first + k);
    data.penetration(p) = delassus.open()(pair.first);
    data.stiffness(p) = kOwnElements / local_(pair.first);
    data.bodies.push_back(delassus.blocksOf(pair.first));
    data.canChange.push_back(free && pair.law->separates());
    data.bound[p] = !pair.law->separates();
    double compliance = 0.0;
    int moving = 0;
    for (int k = 1; k < pair.rows; ++k) {
      if (problem.dofs[pair.first + k].empty()) continue;
      compliance += local_(pair.first + k);
      ++moving;
    }
    sites_.push_back({pair.place, pair.size, moving > 0 ? kOwnElements * moving / compliance : 0.0, pair.slipped});
    const auto same = std::find_if(laws.begin(), laws.end(), [&](const auto& law) { return law.get() == pair.law; });
    data.line.push_back(static_cast<int>(same - laws.begin()));
    if (same == laws.end()) laws.emplace_back(std::shared_ptr<const ContactLaw>(), pair.law);  // owned by the caller
  }
  data.rows = effects[0].sparseView();
  for (int k = 1; k <= tangents; ++k) data.tangents.emplace_back(effects[k].sparseView());
  laws_ = ContactLaws(std::move(laws));
  rigid_ = std::make_unique<RigidBodyModel>(std::move(data));
}

DelassusFriction::System DelassusFriction::systemOf(const PairStates& states) const {
  const auto rows = static_cast<Eigen::Index>(problem_.bounds.size());
  System system{Matrix::Zero(rows, rows), Matrix::Zero(rows, rows), Vector::Zero(rows), Vector::Zero(rows), {}};
  Eigen::Index count = 0;
  for (std::size_t p = 0; p < states.size(); ++p) {
    const CondensedContact::Pair& pair = problem_.pairs[p];
    const ContactState& state = states[p];
    const bool slips = state.status == PairStatus::Slip && pair.rows > 1;
    if (state.closed() && !problem_.dofs[pair.first].empty()) {
      system.forces(pair.first, count) = system.tests(pair.first, count) = 1.0;
      for (int k = 1; slips && k < pair.rows; ++k) system.forces(pair.first + k, count) = state.friction * state.direction[k];
      system.row.push_back(slips ? -1 : pair.first);
      ++count;
    }
    for (int k = 1; k < pair.rows; ++k) {
      const int row = pair.first + k;
      if (slips) system.given(row) = state.bound * state.direction[k];
      if (state.status != PairStatus::Stick || problem_.dofs[row].empty()) continue;
      system.forces(row, count) = system.tests(row, count) = 1.0;
      system.row.push_back(row);
      ++count;
    }
    if (state.status == PairStatus::Stick || !(state.transverseStiffness > 0.0) || pair.rows < 2) continue;
    const Point along = acrossSlip(state);
    for (int k = 1; k < pair.rows; ++k) system.forces(pair.first + k, count) = system.tests(pair.first + k, count) = along[k];
    system.compliance(count++) = 1.0 / state.transverseStiffness;
    system.row.push_back(-1);
  }
  system.forces.conservativeResize(Eigen::NoChange, count);
  system.tests.conservativeResize(Eigen::NoChange, count);
  system.compliance.conservativeResize(count);
  return system;
}

/// Makes the forces of rows that repeat each other unique, as at a corner where three bodies are glued to one another: combinations of
/// forces that cancel at all nodes move nothing, and get a compliance of one in the scaled equations. The sum of squares of the scaled
/// forces is least then. \param scale  of the unknowns
void DelassusFriction::shareRepeated(const System& system, const Vector& scale, Matrix& scaled) const {
  std::vector<int> left;    // unknowns of which each shares all its dofs with others
  std::map<int, int> uses;  // by dof
  const auto dofsOf = [&](int k) -> const std::vector<int>& { return problem_.dofs[static_cast<std::size_t>(system.row[k])]; };
  for (int k = 0; k < static_cast<int>(system.row.size()); ++k) {
    if (system.row[static_cast<std::size_t>(k)] < 0) continue;
    left.push_back(k);
    for (const int dof : dofsOf(k)) ++uses[dof];
  }
  for (std::size_t before = left.size() + 1; left.size() < before;) {
    before = left.size();
    left.erase(std::remove_if(left.begin(), left.end(),
                              [&](int k) {
                                const bool isAlone =
                                    std::any_of(dofsOf(k).begin(), dofsOf(k).end(), [&](int dof) { return uses[dof] == 1; });
                                for (const int dof : dofsOf(k)) uses[dof] -= isAlone;
                                return isAlone;
                              }),
               left.end());
  }
  if (left.empty()) return;
  std::map<int, int> placeOf;
  for (const int k : left)
    for (const int dof : dofsOf(k)) placeOf.emplace(dof, static_cast<int>(placeOf.size()));
  Matrix forces = Matrix::Zero(static_cast<Eigen::Index>(placeOf.size()), static_cast<Eigen::Index>(left.size()));
  for (std::size_t i = 0; i < left.size(); ++i) {
    const std::vector<double>& coefficients =
        problem_.coefficients[static_cast<std::size_t>(system.row[static_cast<std::size_t>(left[i])])];
    for (std::size_t d = 0; d < coefficients.size(); ++d)
      forces(placeOf.at(dofsOf(left[i])[d]), static_cast<Eigen::Index>(i)) += coefficients[d] * scale(left[i]);
  }
  const Matrix cancelling = nullSpace(forces / forces.colwise().norm().maxCoeff(), kDependent);
  for (std::size_t i = 0; i < left.size(); ++i)
    for (std::size_t j = 0; j < left.size(); ++j)
      scaled(left[i], left[j]) += cancelling.row(static_cast<Eigen::Index>(i)).dot(cancelling.row(static_cast<Eigen::Index>(j)));
}

ContactAnswer DelassusFriction::solve(const PairStates& states, double) {
  const System system = systemOf(states);
  const Matrix &h = delassus_.compliance(), &g = delassus_.motions();
  const Eigen::Index n = system.forces.cols(), m = g.cols();
  // Unknowns and equations are scaled to a unit diagonal; motions by the rows that they move.
  Matrix a = Matrix::Zero(n + m, n + m);
  Vector b(n + m), right = Vector::Ones(n + m), left = right;
  a.topLeftCorner(n, n) = system.tests.transpose() * h * system.forces;
  a.topLeftCorner(n, n).diagonal() += system.compliance;
  a.topRightCorner(n, m) = -system.tests.transpose() * g;
  a.bottomLeftCorner(m, n) = g.transpose() * system.forces;
  b.head(n) = system.tests.transpose() * (delassus_.open() - h * system.given);
  b.tail(m) = delassus_.work() - g.transpose() * system.given;
  Vector shared = Vector::Zero(n + m);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double own = system.tests.col(k).cwiseAbs2().dot(local_);
    left(k) = right(k) = 1.0 / std::sqrt(own);
    shared(k) = kShared * own;
  }
  for (Eigen::Index k = 0; k < m; ++k) {
    const double size = a.topRightCorner(n, m).col(k).cwiseProduct(left.head(n)).norm();
    if (size > 0.0) left(n + k) = right(n + k) = 1.0 / size;
  }
  Matrix scaled = a;
  scaled.diagonal() += shared;
  scaled = (left.asDiagonal() * scaled * right.asDiagonal()).eval();
  shareRepeated(system, right, scaled);
  double condition = 0.0;
  const Matrix inverse = generalInverse(scaled, condition);
  ContactAnswer answer;
  answer.solved = condition < kSingular;
  if (!answer.solved) return answer;
  Vector x = Vector::Zero(n + m);
  for (int pass = 0; pass <= kRefined; ++pass) x += right.cwiseProduct(inverse * left.cwiseProduct(b - a * x));
  if (!x.allFinite()) {
    answer.solved = false;
    return answer;
  }
  force_ = system.forces * x.head(n) + system.given;
  amplitude_ = x.tail(m);
  answer = answerOf(states);
  report(states, answer);
  return answer;
}

ContactAnswer DelassusFriction::answerOf(const PairStates& states) const {
  const auto pairs = static_cast<Eigen::Index>(states.size());
  const Vector deformed = delassus_.compliance() * force_, moved = delassus_.motions() * amplitude_;
  const Vector jump = delassus_.open() - deformed + moved;
  ContactAnswer answer;
  answer.force = answer.jump = Matrix::Zero(pairs, 3);
  Vector deformation(pairs), digits(pairs);
  ClosedSet closed;
  for (Eigen::Index p = 0; p < pairs; ++p) {
    const CondensedContact::Pair& pair = problem_.pairs[static_cast<std::size_t>(p)];
    const ContactState& state = states[static_cast<std::size_t>(p)];
    closed.push_back(state.closed());
    deformation(p) = digits(p) = 0.0;
    for (int k = 0; k < pair.rows; ++k) {
      const int row = pair.first + k;
      answer.force(p, k) = force_(row);
      if (!state.holds(k) || problem_.dofs[row].empty()) answer.jump(p, k) = jump(row);
      deformation(p) = std::max(deformation(p), std::abs(deformed(row)));
      digits(p) =
          std::max(digits(p), delassus_.rounding()(row) + kDigits * std::max(std::abs(delassus_.open()(row)), std::abs(moved(row))));
    }
  }
  answer.forceTolerance =
      (kAccuracy * rigid_->clusterScale(closed, answer.force.rowwise().norm())).cwiseMax(digits.cwiseQuotient(rigid_->compliance()));
  answer.jumpTolerance = kAccuracy * rigid_->clusterScale(closed, deformation) + digits;
  answer.energy = delassus_.energy(force_, amplitude_) - 0.5 * force_.dot(jump);
  return answer;
}

void DelassusFriction::report(const PairStates& states, const ContactAnswer& answer) {
  ActiveSetStep step;
  double size = 0.0;
  for (std::size_t p = 0; p < states.size(); ++p) {
    step.active += states[p].closed();
    step.changed += last_.empty() || last_[p].status != states[p].status;
    size += answer.force.row(static_cast<Eigen::Index>(p)).squaredNorm() / rigid_->data().stiffness(static_cast<Eigen::Index>(p));
  }
  last_ = states;
  const double apart = LawProjection(*rigid_, laws_, sites_).distance(states, answer.force, answer.jump);
  step.residual = std::sqrt(size > 0.0 ? apart / size : apart);
  step.energy = answer.energy;
  step_(step);
}

}  // namespace suture
