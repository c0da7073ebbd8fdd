#include <suture/answer/values/ControlledLoads.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Monitor.hpp>
#include <suture/elasticity/loads/Load.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/Stages.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace suture {

namespace {

constexpr int kMostSteps = 30;
constexpr double kReached = 1e-8;     // smallest relative misfit required: misfit / sizeOf()
constexpr double kAccuracy = 10.0;    // misfit over the accuracy of the solutions
constexpr double kMissed = 100.0;     // misfit of a refused solution over that at which the search ends
constexpr double kFirstPull = 1e-2;   // first step over that of a block of the stiffest material
constexpr double kNoResponse = 1e-9;  // slope over the expected one, below which there is no response

using Control = Load::Control;

std::vector<std::size_t> controlled(const ElasticModel& model) {
  std::vector<std::size_t> all;
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    if (model.loads[l].control != Control::None) all.push_back(l);
  return all;
}

std::string nameOf(const Load& load) { return load.path.empty() ? "load '" + load.name + "'" : load.path; }

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string quantityOf(const Load& load) { return load.control == Control::SectionForce ? "the section force" : "the mean displacement"; }

double largestDisplacement(const Comm& comm, const Solution& solution) {
  double mine = 0.0, all = 0.0;
  for (const Vector& u : solution.displacement)
    if (u.size() > 0) mine = std::max(mine, u.lpNorm<Eigen::Infinity>());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

/// Scale of a misfit. The accuracy of a displacement is relative to the largest displacement of the solution, which limits how accurately
/// a target close to zero can be met. [length or force]
double sizeOf(const Load& load, double value, double displacement) {
  if (load.control != Control::SectionForce) return std::max(std::abs(load.target), displacement);
  return load.target != 0.0 ? std::abs(load.target) : std::abs(value);
}

/// The search for the amounts of a scene.
class Search {
 public:
  Search(const CommPtr& comm, Scene& scene, const std::vector<SubdomainMesh>& meshes)
      : comm_(comm), scene_(scene), trial_(scene), loads_(controlled(scene.model)), size_(Eigen::Index(loads_.size())) {
    trial_.levels.clear();
    trial_.isOneStep = true;
    for (Load& load : trial_.model.loads) load.control = Control::None;
    amounts_ = largest_ = Vector::Zero(size_);
    slopes_ = Matrix::Zero(size_, size_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      const double slope = controlledSlope(*comm, meshes, scene.model, load(i));
      const bool isForce = load(i).control == Control::SectionForce;
      if (isForce && slope == 0.0)
        throw InputError(load(i).path, "its Point and Length contain no part of body '" + load(i).body + "': nothing is shortened");
      slopes_(i, i) = isForce ? slope : slope / kFirstPull;
      amounts_[i] = isForce ? load(i).target / slope : 0.0;
    }
    expected_ = slopes_.diagonal();
  }

  /// Returns the number of solutions.
  int run() {
    Vector misfit = misfitAt(amounts_);
    softenBolts(misfit);
    while (!isReached(misfit)) {
      if (steps_ >= kMostSteps) fail(misfit);
      const Eigen::FullPivLU<Matrix> factor(slopes_);
      Vector step = -factor.solve(misfit);
      if (!step.allFinite()) fail(misfit);
      const Vector next = misfitAt(amounts_ + step);
      // Broyden's update in units of the expected changes.
      const Vector scaled = step.cwiseProduct(expected_.cwiseProduct(expected_));
      slopes_ += (next - misfit - slopes_ * step) * scaled.transpose() / step.dot(scaled);
      amounts_ += step;
      misfit = next;
      if (slopes_.diagonal().cwiseAbs().cwiseQuotient(expected_).minCoeff() <= kNoResponse) fail(misfit);
    }
    for (Eigen::Index i = 0; i < size_; ++i) load(i).setAmount(amounts_[i]);
    return steps_;
  }

  std::string found() const {
    std::string text;
    for (Eigen::Index i = 0; i < size_; ++i)
      text += (i > 0 ? "; " : "") + nameOf(load(i)) + ": " + quantityOf(load(i)) + " " + number(load(i).target) + " by " +
              (load(i).control == Control::SectionForce ? "a shortening of " : "a force of ") + number(amounts_[i]);
    return text;
  }

 private:
  Load& load(Eigen::Index i) { return scene_.model.loads[loads_[i]]; }
  const Load& load(Eigen::Index i) const { return scene_.model.loads[loads_[i]]; }

  Vector misfitAt(const Vector& amounts) {
    for (Eigen::Index i = 0; i < size_; ++i) {
      load(i).setAmount(amounts[i]);
      trial_.model.loads[loads_[i]].setAmount(amounts[i]);
    }
    const SolvedScene solved = solve(prepare(check(cut(read(RunContext(comm_), trial_)))));
    ++steps_;
    const Solution& solution = solved.solution();
    if (!solution.converged)
      throw NumericalError("step " + std::to_string(steps_) + " towards the target of " + nameOf(load(0)) + ": " + solution.failure);
    reached_ = std::max(kReached, kAccuracy * requestedAccuracy(scene_.settings(), solution));
    displacement_ = largestDisplacement(*comm_, solution);
    Vector misfit(size_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      const double value = controlledValue(*comm_, solved.meshes(), scene_.model, solution.displacement, load(i));
      largest_[i] = std::max(largest_[i], std::abs(value));
      misfit[i] = value - load(i).target;
    }
    return misfit;
  }

  /// Estimates from the first solution how much the clamped parts soften a bolt.
  void softenBolts(const Vector& misfit) {
    for (Eigen::Index i = 0; i < size_; ++i)
      if (const double value = misfit[i] + load(i).target; load(i).control == Control::SectionForce && value / load(i).target > 0.0)
        slopes_(i, i) = std::min(slopes_(i, i), value / amounts_[i]);
  }

  bool isReached(const Vector& misfit) const {
    for (Eigen::Index i = 0; i < size_; ++i)
      if (!(std::abs(misfit[i]) <= reached_ * sizeOf(load(i), largest_[i], displacement_))) return false;
    return true;
  }

  [[noreturn]] void fail(const Vector& misfit) const {
    Eigen::Index worst = 0;
    misfit.cwiseAbs().cwiseProduct(expected_.cwiseInverse()).maxCoeff(&worst);
    throw NumericalError(nameOf(load(worst)) + ": " + quantityOf(load(worst)) + " is " + number(misfit[worst] + load(worst).target) +
                         " after " + std::to_string(steps_) + " solutions and does not come near " + number(load(worst).target) +
                         ". Check whether another condition fixes it, or whether two controlled loads act on the same quantity");
  }

  CommPtr comm_;
  Scene& scene_;
  Scene trial_;
  std::vector<std::size_t> loads_;
  Eigen::Index size_;
  Vector amounts_, largest_, expected_;
  Matrix slopes_;  // derivatives of the values with respect to the amounts
  double reached_ = kReached, displacement_ = 0.0;
  int steps_ = 0;
};

}  // namespace

bool hasControlledLoads(const Scene& scene) { return !controlled(scene.model).empty(); }

void controlLoads(const CommPtr& comm, Scene& scene, const std::vector<SubdomainMesh>& meshes, Monitor& monitor) {
  Search search(comm, scene, meshes);
  const int steps = search.run();
  monitor.note(search.found() + " (" + std::to_string(steps) + " solutions)");
}

Check targetCheck(const Comm& comm, const Scene& scene, const std::vector<SubdomainMesh>& meshes, const Solution& solution) {
  const double most = largestDisplacement(comm, solution);
  Check check{"controlled_loads", 0.0, kMissed * std::max(kReached, kAccuracy * requestedAccuracy(scene.settings(), solution)), "",
              "a smaller Outer Solver/Tolerance"};
  for (const std::size_t l : controlled(scene.model)) {
    const Load& load = scene.model.loads[l];
    const double value = controlledValue(comm, meshes, scene.model, solution.displacement, load);
    const double size = sizeOf(load, value, most);
    const double missed = size > 0.0 ? std::abs(value - load.target) / size : 0.0;
    if (missed <= check.value) continue;
    check.value = missed;
    check.where = nameOf(load) + ", where " + quantityOf(load) + " is " + number(value) + " instead of " + number(load.target);
  }
  return check;
}

}  // namespace suture
