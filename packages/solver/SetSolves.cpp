#include <suture/base/DisjointSets.hpp>
#include <suture/solver/SetSolves.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace suture {

namespace {
constexpr int kRestarts = 4;        // of conjugate gradients whose recursion has lost the residual
constexpr double kStalled = 0.5;    // of the residual: a restart that leaves more has met the floor of rounding
constexpr double kFloor = 1e-6;     // residual above which a floor is no answer, whatever the verdict may say
constexpr double kOwn = 5.0;        // by which the residual of a body, relative to its own energy, may be larger than that of its cluster
constexpr double kPassive = 1e-12;  // of the cluster's energy: a body that holds less is measured by that
}  // namespace

SetSolves::SetSolves(OuterSolver::Run& run, double inner)
    : run_(run), sets_(*run.problem.sets()), inner_(std::max(inner, run.settings.tolerance)), step_(run.problem.space()->vector()) {
  if (!run.fromAuxiliary) return;
  // The auxiliary solve may be gone on with, if it was scaled as its cluster is.
  preconditioned_ = run.preconditioned;
  hasPreconditioner_ = true;
  matrix_ = run.bilateral;
  deformed_ = true;
  reference_ = run.reference;
  const ClosedSet closed = sets_.closedSet(preconditioned_);
  if (oneCluster(closed)) closed_ = closed;
}

DisjointSets SetSolves::clusters(const ClosedSet& closed) const {
  const RigidContact& rigid = sets_.bodies().rigid();
  DisjointSets joined(static_cast<int>(sets_.bodies().parts().size()));
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (closed[i])
      for (const int part : rigid.data().bodies[i]) joined.join(part, rigid.data().bodies[i].front());
  return joined;
}

bool SetSolves::oneCluster(const ClosedSet& closed) const {
  DisjointSets joined = clusters(closed);
  bool one = true;
  for (std::size_t p = 0; p < sets_.bodies().parts().size(); ++p) one = one && joined.lowest(static_cast<int>(p)) == joined.lowest(0);
  return one;
}

void SetSolves::precondition(const InterfaceState& state, const Teuchos::RCP<InterfaceOperator>& matrix) {
  const bool first = !hasPreconditioner_;
  if (!first && run_.problem.differing(preconditioned_, state.status).empty()) return;
  run_.preconditioner->initialize(matrix->space());
  run_.preconditioner->compute(matrix);
  preconditioned_ = state.status;
  hasPreconditioner_ = true;
  if (first) run_.describe(*matrix);
}

/// Scales of the clusters: from the energies of the state, or before there are any from the residual.
void SetSolves::scaleBy(const InterfaceState& state, const ClosedSet& closed, const MultiVector& load) {
  const auto parts = sets_.bodies().parts().size();
  DisjointSets clusters = this->clusters(closed);
  const auto byCluster = [&](const Vector& ofParts) {
    Vector sums = Vector::Zero(ofParts.size());
    for (std::size_t p = 0; p < parts; ++p) sums(clusters.lowest(static_cast<int>(p))) += ofParts(static_cast<Eigen::Index>(p));
    return sums;
  };
  Vector energy = byCluster(sets_.energies(state));
  if (!deformed_) energy.setZero();
  const std::vector<int>& partOf = sets_.partOfOwned();
  scale_.clear();
  scaled_ = false;
  largestScale_ = 1.0;
  // One cluster needs no scaling; an automatic tolerance asks for the error of the whole.
  if (oneCluster(closed) || run_.automatic.on()) {
    reference_ = std::sqrt(energy.cwiseMax(0.0).sum());
    if (run_.automatic.on() && reference_ == 0.0) {  // it needs to know the size of the solution
      reference_ = preconditionedNorm(*run_.preconditioner, load);
      run_.automatic.startsFrom(reference_);
    }
    return;
  }
  const Vector fresh = byCluster(productsByPart(load, *run_.problem.space()->vector()));
  Vector size(energy.size());
  for (Eigen::Index c = 0; c < size.size(); ++c) size(c) = std::sqrt(std::max(energy(c) > 0.0 ? energy(c) : fresh(c), 0.0));
  largestScale_ = size.maxCoeff() > 0.0 ? size.maxCoeff() : 1.0;
  scaled_ = true;
  clusterScale_ = Vector::Constant(energy.size(), largestScale_);
  for (Eigen::Index p = 0; p < size.size(); ++p)
    if (const double own = size(clusters.lowest(static_cast<int>(p))); own > 0.0) clusterScale_(p) = own;
  for (const int part : partOf) scale_.push_back(clusterScale_(part));
  reference_ = 1.0;
}

void SetSolves::scale(MultiVector& x, bool inverse) const {
  if (!scaled_) return;
  auto values = localView(x);
  for (std::size_t k = 0; k < scale_.size(); ++k) values(static_cast<Eigen::Index>(k), 0) *= inverse ? 1.0 / scale_[k] : scale_[k];
}

Vector SetSolves::productsByPart(const MultiVector& r, MultiVector& z) const {
  run_.preconditioner->apply(r, z);
  const std::vector<int>& partOf = sets_.partOfOwned();
  Vector mine = Vector::Zero(static_cast<Eigen::Index>(sets_.bodies().parts().size())), all = mine;
  const auto a = localView(r), b = localView(static_cast<const MultiVector&>(z));
  for (std::size_t k = 0; k < partOf.size(); ++k)
    mine(partOf[k]) += a(static_cast<Eigen::Index>(k), 0) * b(static_cast<Eigen::Index>(k), 0);
  Teuchos::reduceAll(*run_.problem.space()->comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

double SetSolves::norm(const MultiVector& residual) const {
  MultiVector scaled(residual, Teuchos::Copy);
  scale(scaled, true);
  const Vector squares = productsByPart(scaled, *run_.problem.space()->vector());
  const double absolute = std::sqrt(std::max(squares.sum(), 0.0));
  if (absolute == 0.0) return 0.0;
  double relative = reference_ > 0.0 ? absolute / reference_ : 1.0;
  if (energies_.size() == 0) return relative;
  DisjointSets clusters = this->clusters(closed_);
  Vector ofCluster = Vector::Zero(energies_.size());
  for (Eigen::Index p = 0; p < energies_.size(); ++p) ofCluster(clusters.lowest(static_cast<int>(p))) += std::max(energies_(p), 0.0);
  for (Eigen::Index p = 0; p < energies_.size(); ++p) {
    const double all = ofCluster(clusters.lowest(static_cast<int>(p))), own = std::max(energies_(p), kPassive * all);
    const double scaleOfPart = scaled_ ? clusterScale_(p) : 1.0;
    if (own > 0.0) relative = std::max(relative, scaleOfPart * std::sqrt(std::abs(squares(p)) / own) / kOwn);
  }
  return relative;
}

void SetSolves::evaluateStart() {
  InterfaceState state = run_.result.state;
  state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
  int applications = run_.problem.conform(state);
  ClosedSet closed = sets_.closedSet(state.status);
  const RigidContact& rigid = sets_.bodies().rigid();
  if (rigid.loosens(closed)) return;
  const ClosedSet carrying = closed;
  for (const int i : rigid.holders(carrying, rigid.loose(carrying))) closed[i] = 1;
  if (closed != carrying) return;
  const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
  precondition(state, linear.matrix);
  deformed_ = true;
  scaleBy(state, closed, *linear.load);
  run_.automatic.startsFrom(reference_);
  run_.evaluation = sets_.evaluateSet(state, run_.settings.tolerance);
  run_.result.pcgTotal += applications + run_.evaluation.applications;
  run_.result.residual = norm(*run_.evaluation.residual);
  run_.result.state = state;
  run_.confirm();
}

bool SetSolves::oneSolve(InterfaceState& state, bool goOn, int level, double tightening, InnerResult& cost, int& applications) {
  const double final = run_.settings.tolerance;
  const double tolerance = tightening * (level == 0 ? inner_ : level == 1 ? std::sqrt(inner_ * final) : final);
  const EnergyCriterion criterion = run_.automatic.criterion(state, run_.lowest, false, level > 0);
  if (goOn) {
    matrix_->record();
    cost = run_.inner.goOn(*step_, tolerance, reference_, run_.monitor, criterion);
  } else {
    applications += run_.problem.conform(state);
    const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
    matrix_ = linear.matrix;
    precondition(state, matrix_);
    scaleBy(state, closed_, *linear.load);
    scale(*linear.load, true);
    matrix_->record();
    cost = run_.inner.solve(matrix_, run_.preconditioner, *linear.load, *step_, tolerance, reference_, run_.monitor, criterion);
  }
  run_.learn(cost);
  const Matrix image = matrix_->recorded(cost.steps);
  if (!cost.converged) {
    run_.result.pcgTotal += cost.pcg + applications;
    run_.result.failure = "a linear solve did not reach its tolerance within " + std::to_string(run_.settings.maximumInnerIterations) +
                          " iterations; a Preconditioner/BDDC/Edge Constraints of Adaptive may help";
    return false;
  }
  if (!goOn && reference_ == 0.0) reference_ = cost.history.front() > 0.0 ? cost.reference : 0.0;
  scale(*step_, false);
  run_.problem.update(state, *step_, 1.0, scaled_ ? nullptr : &image);
  deformed_ = true;
  return true;
}

ContactAnswer SetSolves::solve(const ClosedSet& closed, int level) {
  const double final = run_.settings.tolerance;
  const double tolerance = level == 0 ? inner_ : level == 1 ? std::sqrt(inner_ * final) : final;
  ContactAnswer answer;
  bool goOn = closed == closed_ && run_.inner.canGoOn();
  closed_ = closed;
  double before = 0.0, tightening = 1.0;
  try {
    for (int pass = 0;; ++pass) {
      InterfaceState state = run_.result.state;
      state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
      state.status = sets_.statusOf(closed);
      InnerResult cost;
      int applications = 0;
      if (!oneSolve(state, goOn, level, tightening, cost, applications)) {
        answer.solved = false;
        closed_.clear();
        return answer;
      }
      // Statuses are believed as far as the solve has come.
      InterfaceProblem::Evaluation at = sets_.evaluateSet(state, std::max(final, std::min(tolerance, cost.residual)));
      double residual = cost.residual;
      bool drifted = false;
      if (level == levels() - 1 ||
          (at.settled && residual <= final)) {  // what the recursion of conjugate gradients says, confirmed by the operator itself
        // Before the state forgets its image: the energies cost no application then.
        energies_ = run_.automatic.on() ? Vector() : sets_.energies(state);
        state.memory.reset();
        at = sets_.evaluateSet(state, final);
        if (const double energy = energies_.cwiseMax(0.0).sum(); !scaled_ && energy > 0.0) reference_ = std::sqrt(energy);
        residual = norm(*at.residual);
        drifted = residual > final;
      }
      if (!std::isfinite(residual)) throw NumericalError("a residual is not a number");
      cost.pcg += applications + at.applications;
      answer.force = at.force;
      answer.penetration = at.penetration;
      answer.forceTolerance = at.forceTolerance;
      answer.penetrationTolerance = at.penetrationTolerance;
      answer.energy = at.energy;
      run_.accept(std::move(state), std::move(at), residual, cost, 1.0,
                  cost.energyErrors.empty() ? -1.0 : largestScale_ * cost.energyErrors.back());
      run_.result.state.status = sets_.statusOf(closed);
      if (!drifted) return answer;
      closed_.clear();
      if (pass > 0 && (residual > kStalled * before || pass >= kRestarts)) {
        run_.atFloor = residual <= kFloor;
        return answer;
      }
      before = residual;
      // Where the norm of conjugate gradients would let the residual of a body pass.
      tightening = std::min(1.0, std::max(kOwn * kOwn * kPassive, 0.3 * final / residual));
      goOn = false;
      closed_ = closed;
    }
  } catch (const NumericalError& error) {
    run_.result.failure = error.what();
    answer.solved = false;
    closed_.clear();
    return answer;
  }
}

ContactOracle::Change SetSolves::redistribute(const ClosedSet& closed, const Vector& given) {
  Change change;
  InterfaceState state = run_.result.state;
  state.trace = Teuchos::rcp(new MultiVector(*run_.result.state.trace, Teuchos::Copy));
  state.status = sets_.statusOf(closed);
  closed_.clear();
  try {
    int applications = run_.problem.conform(state) + 2;
    const InterfaceProblem::Linearisation linear = run_.problem.linearise(state);
    precondition(state, linear.matrix);
    const MultiVectorPtr load = sets_.loadOf(given, state.status);
    const InnerResult cost =
        run_.inner.solve(linear.matrix, run_.preconditioner, *load, *step_, run_.settings.tolerance, 0.0, run_.monitor);
    run_.result.pcgTotal += cost.pcg + applications;
    if (!cost.converged) return change;
    sets_.pairChanges(*step_, state.status, given, change.force, change.penetration);
  } catch (const NumericalError& error) {
    run_.result.failure = error.what();
    return Change();
  }
  return change;
}

void SetSolves::move(const Vector& motion) { sets_.move(run_.result.state, motion); }

}  // namespace suture
