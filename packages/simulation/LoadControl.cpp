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
#include <memory>
#include <optional>
#include <sstream>

namespace suture {

namespace {

constexpr int kMostSteps = 30;
constexpr double kReached = 1e-8;     // smallest relative misfit required: misfit / sizeOf()
constexpr double kAccuracy = 10.0;    // misfit over the accuracy of the solutions
constexpr double kMissed = 100.0;     // misfit of a refused solution over that at which the search ends
constexpr double kFirstPull = 1e-2;   // first step over that of a block of the stiffest material
constexpr double kRounded = 1e-12;    // force of a displacement, relative to that on a cube of the stiffest material, that is round-off
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

/// The search for the amounts of a scene. Unknowns: the amounts, and the displacements of auxiliary supports. Misfits: the distances from
/// the targets, and the forces of auxiliary supports times the compliance of a cube. [length or force]
class Search {
 public:
  Search(const CommPtr& comm, Scene& scene, const MeanSupports& supports, const std::vector<SubdomainMesh>& meshes)
      : comm_(comm),
        scene_(scene),
        supports_(supports),
        trial_(scene),
        loads_(controlled(scene.model)),
        size_(Eigen::Index(loads_.size())),
        held_(Eigen::Index(supports.all().size())) {
    trial_.levels.clear();
    trial_.mesh = [make = scene.mesh, kept = std::make_shared<std::optional<Mesh>>()](const Comm& ranks) {
      if (!*kept) *kept = make(ranks);  // once for all trials
      return **kept;
    };
    trial_.isOneStep = true;
    for (Load& load : trial_.model.loads) load.control = Control::None;
    unknowns_ = Vector::Zero(size_ + held_);
    largest_ = Vector::Zero(size_);
    slopes_ = Matrix::Zero(size_ + held_, size_ + held_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      const double slope = controlledSlope(*comm, meshes, scene.model, load(i));
      const bool isForce = load(i).control == Control::SectionForce;
      if (isForce && slope == 0.0)
        throw InputError(load(i).path, "its Point and Length contain no part of body '" + load(i).body + "': nothing is shortened");
      slopes_(i, i) = isForce ? slope : slope / kFirstPull;
      unknowns_[i] = isForce ? load(i).target / slope : 0.0;
      if (!isForce) compliance_ = slope;
    }
    expected_ = slopes_.diagonal();
    startSupports();
  }

  /// Returns the number of solutions.
  int run() {
    Vector misfit = misfitAt(unknowns_);
    softenBolts(misfit);
    const int most = std::max<int>(kMostSteps, 5 * static_cast<int>(unknowns_.size()));
    while (!isReached(misfit)) {
      if (steps_ >= most) fail(misfit);
      const Eigen::FullPivLU<Matrix> factor(slopes_);
      Vector step = -factor.solve(misfit);
      if (!step.allFinite()) fail(misfit);
      const Vector next = misfitAt(unknowns_ + step);
      // Broyden's update in units of the expected changes.
      const Vector scaled = step.cwiseProduct(expected_.cwiseProduct(expected_));
      slopes_ += (next - misfit - slopes_ * step) * scaled.transpose() / step.dot(scaled);
      unknowns_ += step;
      misfit = next;
      if (hasNoResponse()) fail(misfit);
    }
    for (Eigen::Index i = 0; i < size_; ++i) load(i).setAmount(unknowns_[i]);
    return steps_;
  }

  Vector heldDisplacements() const { return unknowns_.tail(held_); }

  std::string found() const {
    std::string text;
    for (Eigen::Index i = 0; i < size_; ++i)
      text += (i > 0 ? "; " : "") + nameOf(load(i)) + ": " + quantityOf(load(i)) + " " + number(load(i).target) + " by " +
              (load(i).control == Control::SectionForce ? "a shortening of " : "a force of ") + number(unknowns_[i]);
    return text;
  }

 private:
  Load& load(Eigen::Index i) { return scene_.model.loads[loads_[std::size_t(i)]]; }
  const Load& load(Eigen::Index i) const { return scene_.model.loads[loads_[std::size_t(i)]]; }
  const MeanSupports::Held& held(Eigen::Index i) const { return supports_.all()[std::size_t(i)]; }
  /// Place of the mean that belongs to an auxiliary support, among the controlled loads.
  Eigen::Index meanOf(Eigen::Index i) const { return std::find(loads_.begin(), loads_.end(), std::size_t(held(i).load)) - loads_.begin(); }

  /// Expects rigid bodies: the means move with the auxiliary supports, and their forces are those of the supports.
  void startSupports() {
    expected_.tail(held_).setOnes();
    for (Eigen::Index i = 0; i < held_; ++i) {
      unknowns_[size_ + i] = load(meanOf(i)).target;
      for (Eigen::Index j = 0; j < held_; ++j) {
        slopes_(meanOf(i), size_ + j) = supports_.transfer()(i, j);
        slopes_(size_ + j, meanOf(i)) = -compliance_ * supports_.transfer()(i, j);
      }
    }
  }

  /// Solves the scene with given unknowns and without controls. Collective.
  SolvedScene solvedWith(const Vector& unknowns) {
    for (Eigen::Index i = 0; i < size_; ++i) {
      load(i).setAmount(unknowns[i]);
      trial_.model.loads[loads_[std::size_t(i)]].setAmount(unknowns[i]);
    }
    if (held_ > 0)
      trial_.constraints = [&all = scene_.constraints, &supports = supports_, values = Vector(unknowns.tail(held_))](
                               const Mesh& mesh, const ConditionChange& change, KeptChoices* choices) {
        Constraints constraints = all(mesh, change, choices);
        supports.addTo(constraints, values);
        return constraints;
      };
    SolvedScene solved = solve(prepare(check(cut(read(RunContext(comm_), trial_)))));
    ++steps_;
    if (!solved.solution().converged)
      throw NumericalError("step " + std::to_string(steps_) + " towards the target of " + nameOf(load(0)) + ": " +
                           solved.solution().failure);
    return solved;
  }

  Vector misfitAt(const Vector& unknowns) {
    SolvedScene solved = solvedWith(unknowns);
    if (held_ == 0) return misfitOf(solved.meshes(), solved.solution());
    const JudgedScene judged = judge(std::move(solved));  // for the forces of the auxiliary supports
    return misfitOf(judged.meshes(), judged.solution());
  }

  Vector misfitOf(const std::vector<SubdomainMesh>& meshes, const Solution& solution) {
    reached_ = std::max(kReached, kAccuracy * requestedAccuracy(scene_.settings(), solution));
    displacement_ = largestDisplacement(*comm_, solution);
    Vector misfit(size_ + held_);
    for (Eigen::Index i = 0; i < size_; ++i) {
      const double value = controlledValue(*comm_, meshes, scene_.model, solution.displacement, load(i));
      largest_[i] = std::max(largest_[i], std::abs(value));
      misfit[i] = value - load(i).target;
    }
    forces_ = solution.verification.forces;
    for (Eigen::Index i = 0; i < held_; ++i)
      misfit[size_ + i] =
          compliance_ *
          solution.verification.reactions.supports.at(std::size_t(supports_.firstCondition() + i)).force[std::size_t(held(i).component)];
    return misfit;
  }

  /// Estimates from the first solution how much the clamped parts soften a bolt.
  void softenBolts(const Vector& misfit) {
    for (Eigen::Index i = 0; i < size_; ++i)
      if (const double value = misfit[i] + load(i).target; load(i).control == Control::SectionForce && value / load(i).target > 0.0)
        slopes_(i, i) = std::min(slopes_(i, i), value / unknowns_[i]);
  }

  /// Force by which that of an auxiliary support is measured; round-off of its displacements if nothing else acts. [force]
  double forceOf(Eigen::Index i) const {
    const double round = kRounded * displacement_ / compliance_;
    return std::max({forces_.at(std::size_t(held(i).body)).force, std::abs(unknowns_[meanOf(i)]), round / reached_});
  }

  bool isReached(const Vector& misfit) const {
    for (Eigen::Index i = 0; i < size_; ++i)
      if (!(std::abs(misfit[i]) <= reached_ * sizeOf(load(i), largest_[i], displacement_))) return false;
    for (Eigen::Index i = 0; i < held_; ++i)
      if (!(std::abs(misfit[size_ + i]) <= reached_ * compliance_ * forceOf(i))) return false;
    return true;
  }

  /// True if a load has no effect on its quantity. The mean of a load with an auxiliary support follows the support.
  bool hasNoResponse() const {
    std::vector<char> follows(std::size_t(size_), 0);
    for (Eigen::Index i = 0; i < held_; ++i) follows[std::size_t(meanOf(i))] = 1;
    for (Eigen::Index i = 0; i < size_; ++i)
      if (!follows[std::size_t(i)] && std::abs(slopes_(i, i)) <= kNoResponse * std::abs(expected_[i])) return true;
    return false;
  }

  [[noreturn]] void fail(const Vector& misfit) const {
    Eigen::Index worst = 0;
    misfit.head(size_).cwiseAbs().cwiseProduct(expected_.head(size_).cwiseInverse()).maxCoeff(&worst);
    const std::string unbalanced =
        held_ > 0 ? ", with " + number(misfit.tail(held_).cwiseAbs().maxCoeff() / compliance_) + " of force not balanced," : "";
    throw NumericalError(nameOf(load(worst)) + ": " + quantityOf(load(worst)) + " is " + number(misfit[worst] + load(worst).target) +
                         unbalanced + " after " + std::to_string(steps_) + " solutions and does not come near " +
                         number(load(worst).target) +
                         ". Check whether another condition fixes it, or whether two controlled loads act on the same quantity");
  }

  CommPtr comm_;
  Scene& scene_;
  const MeanSupports& supports_;
  Scene trial_;
  std::vector<std::size_t> loads_;
  Eigen::Index size_, held_;  // numbers of amounts and of auxiliary supports
  Vector unknowns_, largest_, expected_;
  Matrix slopes_;  // derivatives of the misfits with respect to the unknowns
  std::vector<BodyForces> forces_;
  double reached_ = kReached, displacement_ = 0.0, compliance_ = 0.0;
  int steps_ = 0;
};

}  // namespace

bool hasControlledLoads(const Scene& scene) { return !controlled(scene.model).empty(); }

Vector controlLoads(const CommPtr& comm, Scene& scene, const MeanSupports& supports, const std::vector<SubdomainMesh>& meshes,
                    Monitor& monitor) {
  Search search(comm, scene, supports, meshes);
  const int steps = search.run();
  monitor.note(search.found() + " (" + std::to_string(steps) + " solutions)");
  return search.heldDisplacements();
}

void requireOneStep(const Scene& scene, const MeanSupports& supports) {
  if (supports.empty() || scene.steps.empty()) return;
  const MeanSupports::Held& first = supports.all().front();
  throw InputError(scene.model.loads[std::size_t(first.load)].path,
                   "without it, body '" + scene.model.bodies[std::size_t(first.body)] +
                       "' is not held: such a Mean Displacement cannot be combined with Load Steps, because its force is found once and "
                       "then kept. Prescribe displacements on this body, or omit the load steps");
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
