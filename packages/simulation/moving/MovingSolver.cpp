#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementForces.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/partition/NodalValues.hpp>
#include <suture/simulation/moving/MovingSolver.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// The change of shape of a round is of second order in the motion of the round before. Below this fraction of the largest displacement
// beside the frames it changes forces by less than the default tolerances of the verdict.
constexpr double kSettled = 1e-6;
constexpr double kRoundOff = 1e-13;  // change relative to the extent of the scene, for bodies without strain
// Part of the closed pairs that may close in a step if pairs stick: the slip of a pair counts from the beginning of the step, not from the
// moment at which it closes. The path of a roller is 2.5e-3, 6e-4 and 3e-5 too long if it moves by .43, .22 and .11 of the width of its
// contact.
constexpr double kNewlyClosed = 0.3;
constexpr int kMostRounds = 40;  // conforming contacts, whose gap is of the order of the displacements, need up to 27

double extentOf(const Mesh& mesh) {
  double most = 0.0;
  for (const double x : mesh.coordinates) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

MovingSolver::MovingSolver(SceneParts& parts, std::shared_ptr<const DrawnScene> drawn)
    : parts_(parts), drawn_(std::move(drawn)), resolved_(parts.scene.model) {
  collectivelyOnRoot(comm(), "placing the bodies", [&] {
    constraints_ = std::make_unique<const MovingConstraints>(parts_.scene, drawn_->mesh, drawn_->constraints);
    accepted_.bodies = MovingBodies(drawn_->mesh, drawn_->constraints);
    history_.begin(accepted_.bodies, accepted_.bodies.present());
    partOfSubdomain_.assign(static_cast<std::size_t>(parts_.cut.partition.subdomains()), 0);
    for (int e = 0; e < drawn_->mesh.elements(); ++e)
      partOfSubdomain_[static_cast<std::size_t>(parts_.cut.partition.subdomainOfElement[static_cast<std::size_t>(e)])] =
          accepted_.bodies.partOf(drawn_->mesh.nodesOf(e)[0]);
    moments_.assign(accepted_.bodies.frames().size(), {0, 0, 0});
  });
  broadcast(comm(), partOfSubdomain_);
  broadcast(comm(), moments_);
  acceptedMoments_ = moments_;
}

/// Loads at the present places: moments and forces of groups follow from the placed mesh, points of rigid groups move, and forces at points
/// stay at their nodes.
void MovingSolver::placeLoads(double time) {
  ElasticModel& model = parts_.scene.model;
  model.loads = drawn_->model.loads;
  std::vector<Point> places;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    places.push_back(model.loads[i].place);
    if (model.loads[i].kind == Load::Kind::PointForce) model.loads[i] = resolved_.loads[i];
    if (comm().getRank() != 0 || model.loads[i].kind != Load::Kind::ReferenceForce) continue;
    const std::vector<Side> sides = sidesOf(drawn_->mesh.sideGroups, model.loads[i].groups);
    if (!sides.empty()) places[i] = now_.bodies.frameOf(drawn_->mesh.nodesOf(sides.front()).front()).at(places[i]);
  }
  broadcast(comm(), places);
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    if (model.loads[i].kind == Load::Kind::ReferenceForce) model.loads[i].place = places[i];
  resolveLoads(comm(), parts_.cut.meshes, model);
  addCouples(model);
  std::vector<SubdomainMesh> none;
  Constraints noConstraints;
  parts_.path->setTime(time, model, none, noConstraints);
}

/// Linear elements balance moments about the places of their nodes without strain. Couples make the balance exact at the present places.
void MovingSolver::addCouples(ElasticModel& model) const {
  struct Force {
    int node;
    Point force;
  };
  std::vector<Force> all;
  if (comm().getRank() == 0 && !moments_.empty())
    for (std::size_t part = 0; part < now_.bodies.frames().size(); ++part)
      for (const auto& [node, force] : now_.bodies.couple(static_cast<int>(part), moments_[part])) all.push_back({node, force});
  broadcast(comm(), all);
  if (all.empty()) return;
  Load load;
  load.kind = Load::Kind::NodalForces;
  load.name = "couples of displaced forces";
  for (const Force& one : all) load.forces[one.node] = one.force;
  model.loads.push_back(std::move(load));
}

/// Moments of the forces on each part about the displacements of their nodes: sum u x F.
void MovingSolver::findMoments(const Solution& solution) {
  const ElasticModel& model = parts_.scene.model;
  std::vector<double> mine(3 * moments_.size(), 0.0), all(mine.size());
  collectively(comm(), "finding moments", [&] {
    for (std::size_t s = 0; s < parts_.cut.meshes.size(); ++s) {
      const SubdomainMesh& mesh = parts_.cut.meshes[s];
      const auto materialOf = [&](int element) -> const Material& { return model.materialOf(mesh, element, mesh.body); };
      const Vector forces = elementForces(mesh, materialOf, model.plane, solution.displacement[s]).internal;
      double* sum = mine.data() + 3 * static_cast<std::size_t>(partOfSubdomain_[static_cast<std::size_t>(mesh.id)]);
      for (int node = 0; node < mesh.nodes(); ++node) {
        const Eigen::Index at = Eigen::Index(node) * mesh.dimension;
        const Point moment =
            cross(pointOf(solution.displacement[s].data() + at, mesh.dimension), pointOf(forces.data() + at, mesh.dimension));
        for (std::size_t k = 0; k < 3; ++k) sum[k] += moment[k];
      }
    }
  });
  Teuchos::reduceAll(comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  for (std::size_t part = 0; part < moments_.size(); ++part) moments_[part] = {all[3 * part], all[3 * part + 1], all[3 * part + 2]};
}

/// The scene at the present frames, with the pairs of the present shapes.
void MovingSolver::place(double time) {
  Vector drawnPlaces;
  collectivelyOnRoot(comm(), "placing the bodies", [&] {
    parts_.mesh = now_.bodies.placed();
    parts_.constraints = constraints_->at(time, now_.bodies, now_.bodies.present(), history_);
    drawnPlaces = Eigen::Map<const Vector>(drawn_->mesh.coordinates.data(), Eigen::Index(drawn_->mesh.coordinates.size()));
  });
  std::vector<SubdomainMesh> meshes = distribute(comm(), parts_.mesh, parts_.constraints, parts_.cut.partition);
  // Subdomains refer to their meshes, which stay at one place in memory.
  for (std::size_t s = 0; s < meshes.size(); ++s) parts_.cut.meshes[s] = std::move(meshes[s]);
  const std::vector<Vector> own = scatterNodes(comm(), parts_.cut.meshes, drawnPlaces, drawn_->mesh.dimension);
  for (std::size_t s = 0; s < own.size(); ++s) parts_.cut.meshes[s].drawn.assign(own[s].begin(), own[s].end());
  parts_.cut.whole.pieces = parts_.constraints.pieces;
  parts_.cut.whole.parts = parts_.constraints.parts;
  parts_.size = problemSize(comm(), parts_.mesh, parts_.constraints, parts_.cut.partition);
  placeLoads(time);
  if (!method_ || !method_->rearrange(parts_.run.timers())) {
    method_.reset();
    method_ = preparedMethod(parts_, nullptr, true);
  }
  parts_.size.interfaceDofs = method_->interfaceUnknowns();
}

Start MovingSolver::startOfRound() const {
  struct StateOf {
    int id;
    ContactState state;
  };
  std::vector<StateOf> states;
  for (const ContactPair& pair : parts_.constraints.pairs) {  // on rank 0
    const auto found = now_.states.find({pair.line, pair.node()});
    if (found != now_.states.end())
      states.push_back({pair.id, found->second});
    else
      states.push_back({pair.id, pair.gap > 0.0 ? ContactState() : ContactState(parts_.scene.laws.of(pair.line).pressed())});
  }
  broadcast(comm(), states);
  Start start;
  start.displacement = scatterNodes(comm(), parts_.cut.meshes, now_.bodies.beside(), drawn_->mesh.dimension);
  for (const StateOf& one : states) start.status[one.id] = one.state;
  start.carried = parts_.path->carried();
  return start;
}

/// Takes over the shapes and states of a round; true if they are those of the round before. Collective.
bool MovingSolver::settles(const Solution& solution) {
  const Vector moved = gatherNodes(comm(), parts_.cut.meshes, solution.displacement, drawn_->mesh.nodes(), parts_.scene.model.dimension);
  int same = 0;
  collectivelyOnRoot(comm(), "moving the bodies", [&] {
    const Vector before = now_.bodies.placement() + now_.bodies.beside();
    now_.bodies.absorb(moved);
    const double change = (now_.bodies.placement() + now_.bodies.beside() - before).cwiseAbs().maxCoeff();
    const double scale = now_.bodies.beside().cwiseAbs().maxCoeff();
    std::map<std::pair<int, int>, ContactState> states;
    bool sameStates = true;
    for (const PairResult& pair : solution.pairs) {
      const std::pair<int, int> key{pair.line, parts_.constraints.pairs[static_cast<std::size_t>(pair.id)].node()};
      states[key] = pair.state;
      const auto found = now_.states.find(key);
      sameStates = sameStates && (found == now_.states.end() ? !pair.state.closed() : found->second.status == pair.state.status);
    }
    now_.states = std::move(states);
    // Rounds contract at least linearly: what the next one would change follows from the last two.
    const double next = lastChange_ > 0.0 ? change * std::min(1.0, change / lastChange_) : change;
    lastChange_ = change;
    same = sameStates && next <= kSettled * scale + kRoundOff * extentOf(drawn_->mesh);
  });
  broadcastBytes(comm(), &same, sizeof same);
  return same != 0;
}

Solution MovingSolver::solve(const Solution*, bool, const std::vector<Vector>*) {
  try {
    return solveRounds();
  } catch (const InputError& error) {  // the scene is sound as drawn, but not at these places: no contact holds a body any more
    throw NumericalError(std::string("the bodies cannot be solved at their new places: ") + error.what());
  }
}

Solution MovingSolver::solveRounds() {
  now_ = accepted_;
  moments_ = acceptedMoments_;
  collectivelyOnRoot(comm(), "driving the bodies", [&] { constraints_->drive(parts_.path->presentTime(), now_.bodies); });
  const double time = parts_.path->presentTime();
  lastChange_ = 0.0;
  int iterations = 0, pcg = 0;
  bool hasStart = !parts_.path->rows.empty();
  for (int round = 1;; ++round) {
    place(time);
    std::optional<Start> start;
    if (hasStart && method_->takesStart()) start = startOfRound();
    Solution solution = method_->solve(parts_.run.monitor(), parts_.run.timers(), start ? &*start : nullptr);
    hasStart = true;
    iterations += solution.iterations;
    pcg += solution.pcgTotal + solution.auxiliary.pcg;
    solution.iterations = iterations;
    solution.pcgTotal = pcg;
    solution.auxiliary.pcg = 0;
    if (!solution.converged || solution.stopped) return solution;
    findMoments(solution);
    if (settles(solution)) return solution;
    if (round < kMostRounds) continue;
    solution.converged = false;
    solution.failure = "the places of the bodies do not settle within " + std::to_string(kMostRounds) + " rounds";
    return solution;
  }
}

std::vector<StepRow::Frame> MovingSolver::frames() const {
  std::vector<StepRow::Frame> all;
  for (std::size_t part = 0; part < now_.bodies.frames().size(); ++part) {
    const BodyFrame& frame = now_.bodies.frames()[part];
    all.push_back({now_.bodies.bodies()[part], minus(frame.place(), frame.centre()), frame.rotation()});
  }
  return all;
}

bool MovingSolver::isTooLong(const Solution& solution) const {
  int fresh = 0, closed = 0, sticks = 0;
  for (const PairResult& pair : solution.pairs) {
    if (!pair.state.closed()) continue;
    ++closed;
    sticks += pair.kind.restrictsSliding && pair.state.status == PairStatus::Stick;
    const auto before = accepted_.states.find({pair.line, parts_.constraints.pairs[static_cast<std::size_t>(pair.id)].node()});
    fresh += before == accepted_.states.end() || !before->second.closed();
  }
  const bool touched = std::any_of(accepted_.states.begin(), accepted_.states.end(), [](const auto& one) { return one.second.closed(); });
  int tooLong = touched && sticks > 0 && fresh > kNewlyClosed * closed;
  broadcastBytes(comm(), &tooLong, sizeof tooLong);
  return tooLong != 0;
}

void MovingSolver::accept(const Solution& solution) {
  collectivelyOnRoot(comm(), "accepting a step", [&] {
    history_.accept(parts_.constraints.pairs, solution.pairs);
    history_.begin(now_.bodies, now_.bodies.present());
    accepted_ = now_;
  });
  acceptedMoments_ = moments_;
}

void MovingSolver::restore(Solution& last) {
  now_ = accepted_;
  moments_ = acceptedMoments_;
  place(parts_.path->time());
  last.displacement = scatterNodes(comm(), parts_.cut.meshes, now_.bodies.beside(), drawn_->mesh.dimension);
}

}  // namespace suture
