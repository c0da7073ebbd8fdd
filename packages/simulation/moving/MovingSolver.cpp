#include <suture/answer/verdict/Findings.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/partition/NodalValues.hpp>
#include <suture/partition/RenewConstraints.hpp>
#include <suture/simulation/Restart.hpp>
#include <suture/simulation/moving/MovingSolver.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// A step is too long if more than this part of the closed pairs close after this part of the step, and pairs stick. The slip of a late pair
// follows from the mean motion of the bodies, not from the motion at the end: a block tilted by .086 that is put down in one step misses
// its place by half of the sideways motion of its edge, one tilted by .0013 by .02 of its compression.
constexpr double kClosedLate = 0.3;
constexpr double kLate = 0.9;
// Gaps between the last shapes, in changes of shape after which rounds have settled: at most 0.8 in the scenes of test/drivers/moving*.py.
// The gaps of a curved side may change by more than its nodes move.
constexpr double kFound = 20.0;
constexpr int kMostRounds = 40;  // conforming contacts, whose gap is of the order of the displacements, need up to 27

// Advice on `slide`: here sides slide in the deformation beside the frames only.
constexpr const char* kDeforms =
    "Beside their motion the bodies deform by this number of elements: the strains are not small. Check stiffness, loads and prescribed "
    "motions; "
    "a body that friction locks cannot be driven on";

double extentOf(const Mesh& mesh) {
  double most = 0.0;
  for (const double x : mesh.coordinates) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

MovingSolver::MovingSolver(SceneParts& parts, std::shared_ptr<const DrawnScene> drawn)
    : parts_(parts), drawn_(std::move(drawn)), loads_(parts.scene.model) {
  collectivelyOnRoot(comm(), "placing the bodies", [&] {
    constraints_ = std::make_unique<const MovingConstraints>(parts_.scene, drawn_->mesh, drawn_->constraints);
    std::vector<bool> rests;
    for (const std::string& body : drawn_->mesh.bodies) rests.push_back(!movesFar(parts_.scene, body));
    accepted_.bodies = MovingBodies(drawn_->mesh, drawn_->constraints, rests);
    accepted_.states = KeptStates(drawn_->mesh.dimension);
    history_.begin(accepted_.bodies, accepted_.bodies.present());
    partOfSubdomain_.assign(static_cast<std::size_t>(parts_.cut.partition.subdomains()), 0);
    for (int e = 0; e < drawn_->mesh.elements(); ++e)
      partOfSubdomain_[static_cast<std::size_t>(parts_.cut.partition.subdomainOfElement[static_cast<std::size_t>(e)])] =
          accepted_.bodies.partOf(drawn_->mesh.nodesOf(e)[0]);
    extent_ = extentOf(drawn_->mesh);
  });
  broadcast(comm(), partOfSubdomain_);
  broadcastBytes(comm(), &extent_, sizeof extent_);
  takeDrawnPlaces();
}

/// Coordinates of the drawn bodies for meshes that have none yet.
void MovingSolver::takeDrawnPlaces() {
  Vector places;
  if (comm().getRank() == 0)
    places = Eigen::Map<const Vector>(drawn_->mesh.coordinates.data(), Eigen::Index(drawn_->mesh.coordinates.size()));
  const std::vector<Vector> own = scatterNodes(comm(), parts_.cut.meshes, places, drawn_->mesh.dimension);
  for (std::size_t s = 0; s < own.size(); ++s) parts_.cut.meshes[s].drawn.assign(own[s].begin(), own[s].end());
}

/// Moves the subdomains to the present frames.
void MovingSolver::placeMeshes() {
  std::vector<std::array<double, BodyFrame::kNumbers>> frames;
  for (const BodyFrame& frame : now_.bodies.frames()) frames.push_back(frame.numbers());
  broadcast(comm(), frames);
  for (SubdomainMesh& mesh : parts_.cut.meshes) {
    const BodyFrame frame = BodyFrame::ofNumbers(frames[static_cast<std::size_t>(partOfSubdomain_[static_cast<std::size_t>(mesh.id)])]);
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Eigen::Index at = Eigen::Index(node) * mesh.dimension;
      const Point place = frame.at(pointOf(mesh.drawn.data() + at, mesh.dimension));
      for (int k = 0; k < mesh.dimension; ++k) mesh.coordinates[static_cast<std::size_t>(at + k)] = place[static_cast<std::size_t>(k)];
    }
  }
}

/// The loads of a time, at the present places.
void MovingSolver::placeLoads(double time) {
  ElasticModel& model = parts_.scene.model;
  loads_.place(comm(), *drawn_, now_.bodies, parts_.cut.meshes, model);
  std::vector<SubdomainMesh> none;
  Constraints noConstraints;
  parts_.path->setTime(time, model, none, noConstraints);
}

/// The scene at the present frames, with the pairs of the present shapes.
void MovingSolver::place(double time) {
  collectivelyOnRoot(comm(), "placing the bodies", [&] {
    parts_.mesh = now_.bodies.placed();
    parts_.constraints = constraints_->at(time, now_.bodies, now_.bodies.present(), history_, now_.choices);
  });
  renewConstraints(comm(), parts_.mesh, parts_.constraints, parts_.cut.meshes);
  placeMeshes();
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
    if (now_.states.contains(pair))
      states.push_back({pair.id, now_.states.of(pair)});
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

/// True if a solution is less accurate than the scene requests.
bool MovingSolver::isLoose(const Solution& solution) const {
  const Parameters& settings = parts_.scene.settings();
  return method_->takesStart() && !isAutomatic(settings) && solution.residual > requestedAccuracy(settings, solution);
}

/// Shapes and states after a round. Collective. \param settling  takes it into account
MovingSolver::State MovingSolver::stateAfter(const Solution& solution, Settling& settling) const {
  const Vector moved = gatherNodes(comm(), parts_.cut.meshes, solution.displacement, drawn_->mesh.nodes(), parts_.scene.model.dimension);
  State next = now_;
  double seen[3] = {0.0, 0.0, 0.0};  // change, scale, same states
  collectivelyOnRoot(comm(), "moving the bodies", [&] {
    next.bodies.absorb(moved);
    next.change = next.bodies.placement() + next.bodies.beside() - now_.bodies.placement() - now_.bodies.beside();
    seen[0] = next.change.cwiseAbs().maxCoeff();
    seen[1] = next.bodies.beside().cwiseAbs().maxCoeff();
    bool sameStates = true;
    next.states = KeptStates(drawn_->mesh.dimension);
    for (const PairResult& result : solution.pairs) {
      const ContactPair& pair = parts_.constraints.pairs[static_cast<std::size_t>(result.id)];
      next.states.keep(pair, result.state);
      sameStates = sameStates && now_.states.statusOf(pair) == result.state.status;
    }
    seen[2] = sameStates;
  });
  broadcastBytes(comm(), seen, sizeof seen);
  settling.add(seen[0], seen[1], seen[2] != 0.0);
  return next;
}

Solution MovingSolver::solve(const Solution*, bool, const std::vector<Vector>*, double continues) {
  now_ = accepted_;
  now_.choices.clear();
  loads_.goBack();
  collectivelyOnRoot(comm(), "driving the bodies", [&] {
    moveOn(continues);
    constraints_->drive(parts_.path->presentTime(), now_.bodies);
  });
  try {
    return solveRounds();
  } catch (const InputError& error) {  // the scene is sound as drawn, but not at these places: no contact holds a body any more
    throw NumericalError(std::string("the bodies cannot be solved at their new places: ") + error.what());
  }
}

/// Moves all bodies as in the last step. \param part  of its motions. Local.
void MovingSolver::moveOn(double part) {
  if (part == 0.0) return;
  for (std::size_t p = 0; p < lastMotions_.size(); ++p) {
    const MovingBodies::Motion& last = lastMotions_[p];
    now_.bodies.move(static_cast<int>(p), {scaled(part, last.shift), scaled(part, last.rotation), now_.bodies.frames()[p].place()});
  }
}

Solution MovingSolver::solveRounds() {
  const double time = parts_.path->presentTime();
  Settling settling(extent_, contraction_);
  Relaxation relaxation;
  int iterations = 0, pcg = 0;
  const auto solved = [&](const Start* start) {
    Solution solution = method_->solve(parts_.run.monitor(), parts_.run.timers(), start);
    iterations += solution.iterations;
    pcg += solution.pcgTotal + solution.auxiliary.pcg;
    solution.iterations = iterations;
    solution.pcgTotal = pcg;
    solution.auxiliary.pcg = 0;
    return solution;
  };
  bool hasStart = !parts_.path->rows.empty();
  for (int round = 1;; ++round) {
    place(time);
    std::optional<Start> start;
    if (hasStart && method_->takesStart()) {
      start = startOfRound();
      start->tolerance = settling.tolerance();
    }
    Solution solution = solved(start ? &*start : nullptr);
    hasStart = true;
    if (!solution.converged || solution.stopped) return solution;
    Settling after = settling;
    State next = stateAfter(solution, after);
    if (after.isSettled() && isLoose(solution)) {  // the same pairs, to the end
      Start rest = startOf(comm(), solution);
      rest.carried = parts_.path->carried();
      solution = solved(&rest);
      if (!solution.converged || solution.stopped) return solution;
      after = settling;
      next = stateAfter(solution, after);
    }
    settling = after;
    const State before = std::exchange(now_, std::move(next));
    const bool isBalanced = loads_.findMoments(comm(), parts_.cut.meshes, partOfSubdomain_, parts_.scene.model, solution);
    if (settling.isSettled() && isBalanced) {
      findApart();
      if (apart_.part <= kFound * accuracyOf(solution)) {
        contraction_ = settling.contraction();
        return solution;
      }
    }
    if (round < kMostRounds) {
      if (comm().getRank() == 0) now_.bodies.goPartOfTheWay(before.bodies, relaxation.factorAfter(now_.change));
      continue;
    }
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

double MovingSolver::accuracyOf(const Solution& solution) const {
  return std::max(Settling::kSettled, requestedAccuracy(parts_.scene.settings(), solution));
}

/// Searches the contact pairs again between the shapes of the last round. Collective.
void MovingSolver::findApart() {
  double& worst = apart_.part;
  std::string& where = apart_.where;
  worst = 0.0;
  where.clear();
  collectivelyOnRoot(comm(), "searching the contact pairs again", [&] {
    const double scale = Settling(extent_).scale(now_.bodies.beside().cwiseAbs().maxCoeff());
    for (const ContactPair& pair : constraints_->pairsOf(parts_.path->presentTime(), now_.bodies, now_.bodies.present(), now_.choices)) {
      if (!parts_.scene.laws.of(pair.line).separates()) continue;
      const bool isClosed = now_.states.statusOf(pair) != PairStatus::Open;
      const double apart = (isClosed ? std::abs(pair.gap) : std::max(0.0, -pair.gap)) / scale;
      if (apart <= worst) continue;
      worst = apart;
      where = "pair of '" + parts_.scene.contacts[static_cast<std::size_t>(pair.line)] + "' at " +
              placeText(pair.position, drawn_->mesh.dimension);
    }
  });
  broadcastBytes(comm(), &worst, sizeof worst);
  where = broadcast(comm(), where);
}

void MovingSolver::verify(Solution& solution) const {
  solution.verification.checks.push_back({"places", apart_.part, kFound * accuracyOf(solution), apart_.where,
                                          "The shapes of the bodies have not settled: use shorter load steps"});
  for (Check& check : solution.verification.checks)
    if (check.name == nameOf(Quantity::Slide)) check.advice = kDeforms;
  if (!solution.verification.holds()) solution.failure = "the verdict does not hold: " + solution.verification.failure();
}

bool MovingSolver::isTooLong(const Solution& solution) const {
  const bool touched = accepted_.states.anyClosed();
  const bool sticks = std::any_of(solution.pairs.begin(), solution.pairs.end(), [](const PairResult& result) {
    return result.kind.restrictsSliding && result.state.status == PairStatus::Stick;
  });
  int tooLong = 0;
  collectivelyOnRoot(comm(), "checking the length of a step", [&] {
    if (!touched || !sticks) return;
    const Mesh present = now_.bodies.present();
    const Vector& beside = now_.bodies.beside();
    const int d = present.dimension;
    int late = 0, closed = 0;
    for (const PairResult& result : solution.pairs) {
      if (!result.state.closed()) continue;
      ++closed;
      if (!result.kind.restrictsSliding) continue;
      const ContactPair& pair = parts_.constraints.pairs[static_cast<std::size_t>(result.id)];
      double gap = pair.gap;
      for (const PairEnd& end : pair.ends) gap -= end.weight * dot(pair.normal, pointOf(beside.data() + Eigen::Index(end.node) * d, d));
      late += history_.closing(pair, gap, present, now_.bodies) > kLate;
    }
    tooLong = late > kClosedLate * closed;
  });
  broadcastBytes(comm(), &tooLong, sizeof tooLong);
  return tooLong != 0;
}

void MovingSolver::accept(const Solution& solution) {
  collectivelyOnRoot(comm(), "accepting a step", [&] {
    history_.accept(parts_.constraints.pairs, solution.pairs);
    lastMotions_ = now_.bodies.motionsFrom(accepted_.bodies);
    history_.begin(now_.bodies, now_.bodies.present());
    accepted_ = now_;
  });
  loads_.accept();
  parts_.path->moved = moved(solution);
}

/// The bodies after an accepted step. \param solution  of the step. Local; empty on other ranks than 0
std::shared_ptr<const MovedBodies> MovingSolver::moved(const Solution& solution) const {
  auto all = std::make_shared<MovedBodies>();
  if (comm().getRank() != 0) return all;
  for (std::size_t part = 0; part < accepted_.bodies.frames().size(); ++part)
    all->parts.push_back({accepted_.bodies.frames()[part], loads_.moments()[part], lastMotions_[part]});
  const Vector& beside = accepted_.bodies.beside();
  all->beside.assign(beside.data(), beside.data() + beside.size());
  for (const PairResult& pair : solution.pairs) {
    const int node = parts_.constraints.pairs[static_cast<std::size_t>(pair.id)].node();
    const auto past = history_.pasts().find({pair.line, node});
    const bool isKnown = past != history_.pasts().end();
    all->pairs.push_back({pair.line, node, pair.state, isKnown && past->second.slipped, isKnown ? past->second.dissipated : 0.0, pair.force,
                          pair.tangential});
  }
  return all;
}

Solution MovingSolver::goOnFrom(const PathState& state) {
  requireReference(parts_, state);
  const MovedBodies& moved = *state.moved;
  std::map<std::pair<int, int>, const MovedBodies::Pair*> pairOf;
  for (const MovedBodies::Pair& pair : moved.pairs) pairOf[{pair.line, pair.node}] = &pair;
  collectivelyOnRoot(comm(), "placing the bodies", [&] {
    std::vector<BodyFrame> frames;
    for (const MovedBodies::Part& part : moved.parts) {
      frames.push_back(part.frame);
      lastMotions_.push_back(part.lastMotion);
    }
    if (!accepted_.bodies.goOnFrom(frames, moved.beside))
      throw InputError("--restart", "the checkpoint is damaged: it has other bodies than the scene");
    SlipHistory::Pasts pasts;
    SlipHistory::Keys closed;
    for (const auto& [at, pair] : pairOf) {
      pasts[at] = {{0, 0, 0}, pair->slipped, pair->dissipated};
      if (pair->state.closed()) closed.insert(at);
    }
    history_.goOnFrom(std::move(pasts), std::move(closed));
    history_.begin(accepted_.bodies, accepted_.bodies.present());
  });
  std::vector<Point> moments;
  for (const MovedBodies::Part& part : moved.parts) moments.push_back(part.moment);
  loads_.goOnFrom(std::move(moments));
  now_ = accepted_;
  place(parts_.path->time());
  for (const ContactPair& pair : parts_.constraints.pairs)  // on rank 0
    if (const auto found = pairOf.find({pair.line, pair.node()}); found != pairOf.end()) accepted_.states.keep(pair, found->second->state);
  now_.states = accepted_.states;
  Solution solution;
  solution.converged = true;
  solution.energy = parts_.path->rows.back().energy;
  solution.displacement = scatterNodes(comm(), parts_.cut.meshes, now_.bodies.beside(), drawn_->mesh.dimension);
  if (parts_.sinceTime() == parts_.path->time()) parts_.reference = parts_.comparable(solution.displacement);
  std::vector<PairForce> forces;
  for (const ContactPair& pair : parts_.constraints.pairs) {  // on rank 0
    const auto found = pairOf.find({pair.line, pair.node()});
    if (found == pairOf.end())
      forces.push_back({pair.id, {}, 0.0, {0, 0, 0}});
    else
      forces.push_back({pair.id, found->second->state, found->second->force, found->second->tangential});
  }
  std::vector<const SubdomainMesh*> meshes;
  for (const SubdomainMesh& mesh : parts_.cut.meshes) meshes.push_back(&mesh);
  solution.pairs = pairResults(comm(), meshes, solution.displacement, forces);
  return solution;
}

void MovingSolver::restore(Solution& last) {
  now_ = accepted_;
  loads_.goBack();
  place(parts_.path->time());
  last.displacement = scatterNodes(comm(), parts_.cut.meshes, now_.bodies.beside(), drawn_->mesh.dimension);
}

}  // namespace suture
