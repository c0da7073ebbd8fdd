#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Timers.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/Steps.hpp>
#include <suture/simulation/Stages.hpp>
#include <suture/simulation/accuracy/LevelError.hpp>
#include <suture/simulation/accuracy/MeshSequence.hpp>
#include <suture/simulation/accuracy/QuantityError.hpp>
#include <suture/solver/nested/NestedStart.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kAim = 0.7;       // error of the last mesh over the requested one: predictions are not exact
constexpr double kStep = 3.0;      // largest decrease of the error from one mesh to the next
constexpr double kNear = 0.75;     // a goal that is not much smaller than the largest decrease is the aim itself
constexpr double kCheap = 4.0;     // unknowns of the last mesh over those of a uniform one that only measures the rate
constexpr double kRefined = 1.5;   // Gmsh makes up to this many times the elements of half the size
constexpr double kWorth = 1.25;    // a capped mesh needs this many times the unknowns of the present one
constexpr double kUseless = 0.95;  // error over that of the previous mesh from which the refinement is of no use

}  // namespace

/// Solves a scene on a sequence of meshes.
class AdaptiveLevels {
 public:
  explicit AdaptiveLevels(JudgedScene judged) : judged_(std::move(judged)), request_(*judged_.parts_->given->accuracy) {
    const Mesh& mesh = *parts().whole;
    if (comm().getRank() == 0) dimension_ = mesh.dimension, order_ = cellInfo(mesh.cells.front()).order;
    broadcastBytes(comm(), &dimension_, sizeof dimension_);
    broadcastBytes(comm(), &order_, sizeof order_);
    reached_.requested = request_.error;
    reached_.quantity = request_.isEnergy() ? request_.quantity : request_.name();
    checkQuantity(comm(), request_, judged_.meshes());
    end(judged_.run().timers().total(), "start");
  }

  JudgedScene run() {
    while (judged_.solution_.isValid() && !isReached()) {
      if (!quantity_.why.empty()) {
        reached_.limit = "quantity";
        reached_.why = quantity_.why;
        break;
      }
      const double begin = Timers::now();
      const Next next = nextMesh();
      if (!reached_.limit.empty()) break;
      if (!solve(next)) break;
      end(Timers::now() - begin, next.refinement);
    }
    finish();
    return std::move(judged_);
  }

 private:
  struct Next {
    Scene scene;
    std::string refinement;
  };
  struct Plan {
    double unknowns = 0.0;
    int isCapped = 0, isLate = 0;
  };

  const SceneParts& parts() const { return *judged_.parts_; }
  const Comm& comm() const { return judged_.run().comm(); }

  bool isReached() const { return reached_.total() <= request_.error && quantity_.isComplete && quantity_.why.empty(); }

  /// Records the present mesh.
  void end(double seconds, const std::string& refinement) {
    const Solution& solution = judged_.solution();
    const ProblemSize& size = judged_.size();
    error_ = levelError(solution);
    findPolygonError();
    AccuracyLevel level{
        size.dofs,           size.elements,   error_.relative(), error_.strict, seconds, solution.pcgTotal + solution.auxiliary.pcg,
        solution.iterations, solution.energy, refinement,        geometry_};
    if (solution.discretisation) level.estimate = solution.discretisation->relative();
    if (!request_.isEnergy()) judgeQuantity(level);
    broadcastBytes(comm(), &level.seconds, sizeof level.seconds);
    judged_.run().monitor().endLevel(static_cast<int>(reached_.levels.size()), level);
    reached_.levels.push_back(level);
    reached_.reached = level.error;
    reached_.strict = level.strict;
    if (request_.isEnergy()) reached_.geometry = level.geometry;
  }

  /// Effect of straight sides of the present mesh.
  void findPolygonError() {
    std::optional<std::vector<ChordSide>> sides;
    collectivelyOnRoot(comm(), "finding straight sides", [&] { sides = judged_.scene().meshes->chords(*parts().whole); });
    int isKnown = sides.has_value() ? 1 : 0;
    broadcastBytes(comm(), &isKnown, sizeof isKnown);
    geometry_.reset();
    if (isKnown == 0) return;
    polygon_ = polygonError(comm(), judged_.meshes(), judged_.scene().model, judged_.solution().displacement,
                            std::move(sides).value_or(std::vector<ChordSide>()), static_cast<int>(judged_.size().elements));
    double norm = std::sqrt(polygon_.square());
    broadcastBytes(comm(), &norm, sizeof norm);
    geometry_ = error_.norm > 0.0 ? norm / error_.norm : 0.0;
  }

  /// Replaces the error by that of the requested quantity.
  void judgeQuantity(AccuracyLevel& level) {
    const std::optional<double> before = reached_.levels.empty() ? std::nullopt : reached_.levels.back().value;
    if (judged_.solution().isValid()) quantity_ = quantityError(parts(), judged_.solution(), request_, before);
    // Straight sides change a force as they change the energy.
    const double geometry = geometry_.value_or(0.0);
    quantity_.error += geometry * geometry * quantity_.value;
    level.value = quantity_.value;
    level.energyError = level.error;
    level.error = quantity_.relative();
    level.strict = false;
  }

  /// The scene on the next mesh; without one, sets the limit.
  Next nextMesh() {
    Next next{*parts().given, ""};
    const std::shared_ptr<MeshSequence> meshes = next.scene.meshes;
    if (static_cast<int>(reached_.levels.size()) >= request_.mostLevels) {
      reached_.limit = "levels";
      return next;
    }
    if (stagnates()) {
      reached_.limit = "mesh";
      return next;
    }
    const AccuracyLevel& last = reached_.levels.back();
    const double perElement = static_cast<double>(last.unknowns) / static_cast<double>(last.elements);
    const double wanted = wantedError();
    const bool isUniform = measuresRate();
    MeshErrors errors{*parts().whole,
                      squares(static_cast<int>(last.elements)),
                      facingNodes(comm(), judged_.meshes(), *parts().whole, judged_.solution().pairs),
                      polygon_,
                      {wanted * wanted, static_cast<double>(request_.mostUnknowns) / perElement},
                      isUniform};
    Plan plan;
    collectivelyOnRoot(comm(), "planning the next mesh", [&] {
      const MeshPlan found = meshes->plan(errors);
      plan.unknowns = found.elements * perElement;
      plan.isCapped = found.isCapped;
      const double seconds = last.seconds * plan.unknowns / static_cast<double>(last.unknowns);
      plan.isLate = request_.mostSeconds > 0.0 && judged_.run().timers().total() + seconds > request_.mostSeconds;
    });
    broadcastBytes(comm(), &plan, sizeof plan);
    if (plan.isCapped != 0 && plan.unknowns < kWorth * static_cast<double>(last.unknowns))
      reached_.limit = "unknowns";
    else if (plan.isLate != 0)
      reached_.limit = "time";
    next.refinement = isUniform ? "uniform" : meshes->name();
    next.scene.mesh = [meshes](const Comm& ranks) { return meshes->next(ranks); };
    return next;
  }

  /// Squared errors of all elements, on rank 0.
  std::vector<double> squares(int elements) const {
    std::vector<Vector> mine;
    for (const Vector& errors : error_.ofElements) mine.emplace_back(errors.cwiseAbs2());
    return valuesOnRoot(comm(), judged_.meshes(), mine, elements);
  }

  /// Error in the energy norm, with the effect of straight sides, relative.
  static double energyErrorOf(const AccuracyLevel& level) {
    return std::hypot(level.energyError.value_or(level.error), level.geometry.value_or(0.0));
  }

  /// True if the last refinement was of no use: the smallest elements that the mesher can make are too large.
  bool stagnates() const {
    const std::vector<AccuracyLevel>& levels = reached_.levels;
    return levels.size() > 2 && levels[levels.size() - 2].refinement == levels.back().refinement &&
           energyErrorOf(levels.back()) > kUseless * energyErrorOf(levels[levels.size() - 2]);
  }

  /// Factor by which the error in the energy norm is too large for the aim; the error of another quantity is proportional to a power of it.
  double excess() const {
    if (request_.isEnergy()) return reached_.total() / (kAim * request_.error);
    const double ratio = reached_.levels.back().error / (kAim * request_.error);
    return quantity_.isComplete ? std::pow(ratio, 1.0 / quantity_.order) : std::max(ratio, kStep);
  }

  /// Energy norm of the error that the next mesh is to have, with the effect of straight sides.
  double wantedError() const {
    const double present = std::hypot(error_.error, geometry_.value_or(0.0) * error_.norm);
    const double goal = present / excess(), step = present / kStep;
    return goal > kNear * step ? goal : step;
  }

  /// Energy norm of the error on the next mesh: it falls as in the last refinement of this kind, but not below what is wanted.
  double predictedError(const std::string& refinement) const {
    const std::vector<AccuracyLevel>& levels = reached_.levels;
    if (refinement == "uniform") return std::pow(0.5, order_) * error_.error;
    double ratio = wantedError() / error_.error;
    const auto errorOf = [](const AccuracyLevel& level) { return level.energyError.value_or(level.error); };
    if (levels.size() > 1 && levels.back().refinement == refinement && errorOf(levels[levels.size() - 2]) > 0.0)
      ratio = std::max(ratio, errorOf(levels.back()) / errorOf(levels[levels.size() - 2]));
    return std::min(ratio, 1.0) * error_.error;
  }

  /// True if the second mesh is a uniform refinement of the first one, whose cost is small beside that of the last mesh: the two give the
  /// rate of uniform refinement.
  bool measuresRate() const {
    if (reached_.levels.size() != 1) return false;
    const double growth = std::pow(excess(), static_cast<double>(dimension_) / order_);
    const double parts = std::pow(2.0, dimension_);
    const double unknowns = kRefined * parts * static_cast<double>(reached_.levels.front().unknowns);
    return growth > kCheap * parts && unknowns <= static_cast<double>(request_.mostUnknowns);
  }

  /// The scene on another mesh, checked; nothing, and the limit, if the mesh cannot be made or exceeds the memory.
  std::optional<CheckedScene> checked(const Scene& scene) {
    RunMonitor& monitor = judged_.run().monitor();
    try {
      std::optional<PartitionedScene> partitioned;
      try {
        partitioned.emplace(cut(read(judged_.run(), scene)));
      } catch (const InputError& error) {
        reached_.limit = "mesh";
        monitor.dropLevel();
        monitor.note(std::string("warning: the next mesh cannot be made: ") + error.what());
        return std::nullopt;
      }
      return check(*std::move(partitioned));
    } catch (const EnvironmentError& error) {
      reached_.limit = "memory";
      monitor.dropLevel();
      monitor.note(std::string("the next mesh is not solved: ") + error.what());
      return std::nullopt;
    }
  }

  /// Solves the scene on another mesh, from the present solution. False: a limit is reached, and the present solution is unchanged.
  bool solve(const Next& wanted) {
    const RunContext run = judged_.run();
    std::optional<CheckedScene> next = checked(wanted.scene);
    if (!next) return false;
    try {
      PreparedScene prepared = prepare(*std::move(next));
      prepared.remark();
      // A load path begins without loads: the present solution, at its end, is no start for it.
      if (wanted.scene.steps.empty()) {
        Start start = nestedStart(run.comm(), CoarseAnswer{judged_.meshes(), judged_.solution()}, prepared.meshes());
        start.predictedError = predictedError(wanted.refinement);
        prepared.startFrom(std::move(start));
      }
      JudgedScene judged = judge(suture::solve(std::move(prepared)));
      const Solution& solution = judged.solution();
      if (solution.isValid() || solution.stopped) {
        judged_ = std::move(judged);
        return true;
      }
      endWithout(solution.undetermined.empty() ? solution.failure : solution.undetermined);
    } catch (const NumericalError& error) {
      endWithout(error.what());
    }
    if (!wanted.scene.steps.empty()) restoreFiles();
    return false;
  }

  /// Replaces the files of a load path without an end by those of the last step of the present solution.
  void restoreFiles() const {
    if (!judged_.run().writes()) return;
    collectivelyOnRoot(comm(), "removing fields of the next mesh", [&] { removeStepFields(judged_.run().folder(), 0); });
    if (wantsFields(judged_.scene().settings())) writeStepFields(runOf(parts(), judged_.solution()), parts().path->rows);
    writeState(parts(), judged_.solution());
    judged_.run().monitor().note("only the last load step has fields: those of the steps before were overwritten by the next mesh");
  }

  /// Ends the search: the scene has no valid solution on the next mesh.
  void endWithout(const std::string& why) {
    reached_.limit = "solution";
    judged_.run().monitor().dropLevel();
    judged_.run().monitor().note("warning: the result is that of the last mesh but one, because the next one has no valid solution: " +
                                 why);
  }

  /// Cost of uniform refinement from the first mesh to the present error e: N = N_0 (e_0 / e)^(1 / r), with the rate r of the first two
  /// meshes, if the second one is a uniform refinement; it is at most the best possible one, (order / dimension) times that of the
  /// quantity. Without such a mesh nothing is predicted: at singular places the rate is far below the best one. The time is that of the
  /// last mesh times the ratio of the unknowns.
  void predictUniform() {
    if (reached_.levels.size() < 2 || reached_.levels[1].refinement != "uniform") return;
    const AccuracyLevel &first = reached_.levels.front(), &second = reached_.levels[1], &last = reached_.levels.back();
    if (!(first.error > 0.0 && last.error > 0.0)) return;
    const double best = static_cast<double>(order_) / dimension_ * (request_.isEnergy() ? 1.0 : quantity_.order);
    const double rate = std::min(
        best, std::log(first.error / second.error) / std::log(static_cast<double>(second.unknowns) / static_cast<double>(first.unknowns)));
    if (!(rate > 0.0)) return;
    const double unknowns = static_cast<double>(first.unknowns) * std::pow(std::max(first.error / last.error, 1.0), 1.0 / rate);
    reached_.uniform = AccuracyReached::Uniform{order_, unknowns, last.seconds * unknowns / static_cast<double>(last.unknowns)};
  }

  void finish() {
    predictUniform();
    if (judged_.solution_.isValid() || !reached_.limit.empty()) {
      if (const std::string failure = reached_.failure(); !failure.empty() && judged_.solution_.failure.empty())
        judged_.solution_.failure = failure;
    }
    judged_.accuracy_ = std::move(reached_);
    judged_.run().monitor().endLevels();
  }

  JudgedScene judged_;
  const AccuracyRequest request_;
  int dimension_ = 2, order_ = 2;
  LevelError error_;
  QuantityError quantity_;
  PolygonError polygon_;            // on rank 0
  std::optional<double> geometry_;  // relative effect of straight sides; nothing: not known
  AccuracyReached reached_;
};

JudgedScene refine(JudgedScene judged) {
  if (!judged.scene().accuracy) return judged;
  return AdaptiveLevels(std::move(judged)).run();
}

}  // namespace suture
