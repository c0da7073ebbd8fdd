#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <suture/answer/LargestStrain.hpp>
#include <suture/answer/error/PressureOscillation.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/motion/RigidMotionLifting.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Format.hpp>

namespace suture {

void FrictionFigures::add(const PairResult& pair) {
  if (!pair.kind.restrictsSliding) return;
  pairs += 1;
  sticking += pair.state.status == PairStatus::Stick;
  slipping += pair.state.status == PairStatus::Slip;
  dissipated += pair.dissipated;
  onB = plus(onB, pair.tangential);
  if (!(pair.bound > 0.0)) return;
  const double size = norm(pair.tangential);
  maxMobilisation = std::max(maxMobilisation, size / pair.bound);
  tangential += size;
  bound += pair.bound;
}

bool hasFriction(const std::vector<PairResult>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [](const PairResult& pair) { return pair.kind.restrictsSliding; });
}

ContactFigures contactFigures(const std::vector<PairResult>& pairs, int pieces) {
  ContactFigures all;
  all.pairs = int(pairs.size());
  all.forceOnB.assign(std::size_t(pieces), Point{0, 0, 0});
  all.pressureOf.assign(std::size_t(pieces), 0.0);
  all.gapOf.assign(std::size_t(pieces), 0.0);
  all.pairsOf.assign(std::size_t(pieces), 0);
  all.activeOf.assign(std::size_t(pieces), 0);
  all.frictionOf.assign(std::size_t(pieces), {});
  for (const PairResult& pair : pairs) {
    const bool closed = pair.state.closed();
    all.active += closed;
    all.touching += pair.touching;
    all.maxPressure = std::max(all.maxPressure, pair.pressure);
    all.maxGap = std::max(all.maxGap, pair.gap);
    all.maxPenetration = std::max(all.maxPenetration, -pair.gap);
    all.friction.add(pair);
    if (pair.piece < 0 || pair.piece >= pieces) continue;
    const auto piece = std::size_t(pair.piece);
    all.forceOnB[piece] = plus(all.forceOnB[piece], pair.onB());
    all.frictionOf[piece].add(pair);
    all.pressureOf[piece] = std::max(all.pressureOf[piece], pair.pressure);
    all.gapOf[piece] = std::max(all.gapOf[piece], pair.gap);
    all.pairsOf[piece] += 1;
    all.activeOf[piece] += closed;
  }
  return all;
}

ContactFigures contactFigures(const Solution& solution, int pieces) {
  ContactFigures all = contactFigures(solution.pairs, pieces);
  for (const PairResult& point : solution.onAxis) {
    all.maxPressure = std::max(all.maxPressure, point.pressure);
    if (point.piece < 0 || point.piece >= pieces) continue;
    double& own = all.pressureOf[std::size_t(point.piece)];
    own = std::max(own, point.pressure);
  }
  return all;
}

double pressureError(const ContactPiece& piece, double largest) { return largest > 0 ? piece.pressureDoubt / largest : 0.0; }

std::vector<std::string> meshNotes(const Solution& solution) {
  constexpr double kCoarse = 0.25;
  if (!solution.converged) return {};
  const double error = solution.discretisation ? solution.discretisation->relative() : solution.meshError.value_or(0.0);
  if (error <= kCoarse) return {};
  return {
      format("warning: the mesh is coarse: its estimated error is %.0f %% in the energy norm. Displacements, and contact forces that "
             "depend on bending, may have errors of this size or larger. Refine the mesh, or use second-order elements, or "
             "quadrilaterals and hexahedra instead of 3-node triangles and 4-node tetrahedra",
             100 * error)};
}

/// Fraction of the largest pressure above which an oscillation is reported; sufficiently fine triangles stay below.
constexpr double kSeenOscillation = 0.03;

std::vector<std::string> pressureNotes(const Comm& comm, const std::vector<ContactPiece>& pieces, const Solution& solution) {
  std::string said;
  collectivelyOnRoot(comm, "estimating contact pressures", [&] {
    const ContactFigures figures = contactFigures(solution, int(pieces.size()));
    const std::vector<double> oscillation = pressureOscillations(solution.pairs, pieces);
    std::vector<double> magnitude(pieces.size(), 0.0);  // the largest value of a glued contact may be a tension
    for (const PairResult& pair : solution.pairs)
      if (pair.piece >= 0 && pair.piece < int(pieces.size()))
        magnitude[pair.piece] = std::max(magnitude[pair.piece], std::abs(pair.pressure));
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (magnitude[p] > 0.0 && oscillation[p] > kSeenOscillation * magnitude[p]) {
        const double share = oscillation[p] / magnitude[p];
        said += format(
            "%scontact '%s': pressures alternate from node to node by %.0f %% of the largest: the mesh does not resolve them. "
            "Refine the mesh, or use quadrilaterals or second-order elements\n",
            share > 0.1 ? "warning: " : "", pieces[p].name.c_str(), 100 * share);
      }
      const double error = pressureError(pieces[p], figures.pressureOf[p]);
      if (error < 0.01) continue;
      const bool large = error > 0.1;
      said +=
          format("%scontact '%s': estimated error of nodal pressures %.0f %% of the largest, due to straight elements on curved sides%s\n",
                 large ? "warning: " : "", pieces[p].name.c_str(), 100 * error,
                 large ? ". Refine them, or use second-order elements, or Geometry = Automatic with accurate coordinates" : "");
    }
  });
  std::istringstream lines(broadcast(comm, said));
  std::vector<std::string> notes;
  for (std::string line; std::getline(lines, line);) notes.push_back(line);
  return notes;
}

namespace {

constexpr double kLarge = 0.1;  // strain or rotation
// Strain by linear theory of an element that turns against the frame of its body, half of the square of the angle, over the largest strain.
constexpr double kSpurious = 0.05;
constexpr int kLong = 10;          // pairs of a piece that are enough to resolve a pressure
constexpr int kFew = 4;            // adjacent closed pairs that resolve it roughly
constexpr double kCarries = 1e-3;  // fraction of the largest pressure that is above round-off

double largestDisplacement(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement) {
  double squared = 0.0, all = 0.0;
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const int d = meshes[s].dimension;
    for (int n = 0, nodes = meshes[s].bodyNodes(); n < nodes; ++n) {
      double sum = 0.0;
      for (int k = 0; k < d; ++k) {
        const double u = meshes[s].fromDrawn(displacement[s], Eigen::Index(n) * d + k);
        sum += u * u;
      }
      squared = std::max(squared, sum);
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, squared, Teuchos::outArg(all));
  return std::sqrt(all);
}

/// A note for each long piece whose largest pressure is on a patch of few closed pairs.
std::string patchNotes(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs) {
  std::map<int, const PairResult*> closed;
  int ids = 0;
  for (const PairResult& pair : pairs) {
    ids = std::max(ids, pair.id + 1);
    if (pair.state.closed()) closed[pair.id] = &pair;
  }
  std::vector<std::vector<int>> cells;
  for (const ContactPiece& piece : pieces) cells.insert(cells.end(), piece.cells.begin(), piece.cells.end());
  const std::vector<std::vector<int>> beside = neighbourPairs(cells, ids);
  std::string said;
  for (const ContactPiece& piece : pieces) {
    if (int(piece.pairs.size()) < kLong) continue;
    const PairResult* most = nullptr;
    int active = 0;
    for (const int id : piece.pairs) {
      const auto at = closed.find(id);
      if (at == closed.end()) continue;
      ++active;
      if (!most || at->second->pressure > most->pressure) most = at->second;
    }
    if (!most) continue;
    std::set<int> patch{most->id};
    for (std::vector<int> next{most->id}; !next.empty();) {
      const int from = next.back();
      next.pop_back();
      for (const int id : beside[from])
        if (closed.count(id) && patch.insert(id).second) next.push_back(id);
    }
    const int size = int(patch.size()), all = int(piece.pairs.size());
    if (size >= kFew) continue;
    if (size == active)
      said +=
          format("contact '%s': %d of %d pairs closed: the mesh does not resolve the pressure; forces are reliable, pressures are not\n",
                 piece.name.c_str(), size, all);
    else
      said += format(
          "contact '%s': its largest pressure is on %d of %d pairs, at %s: the mesh does not resolve it; forces are reliable, pressures "
          "are "
          "not\n",
          piece.name.c_str(), size, all, placeText(most->position).c_str());
  }
  return said;
}

/// A warning for each piece that carries a force up to an end beyond which the bodies may touch.
std::string openEndNotes(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs) {
  std::map<int, const PairResult*> byId;
  for (const PairResult& pair : pairs) byId[pair.id] = &pair;
  std::string said;
  for (const ContactPiece& piece : pieces) {
    double largest = 0.0;
    for (const int id : piece.pairs) largest = std::max(largest, byId.count(id) ? byId[id]->pressure : 0.0);
    for (const int id : piece.openEnds)
      if (const auto at = byId.find(id);
          at != byId.end() && at->second->kind.separates && at->second->state.closed() && at->second->pressure > kCarries * largest) {
        said += format(
            "warning: contact '%s' is closed up to its end at %s, but the boundary continues smoothly: the bodies may "
            "touch beyond it, where the scene has no contact. Extend its sides\n",
            piece.name.c_str(), placeText(at->second->position).c_str());
        break;
      }
  }
  return said;
}

/// A warning for each piece between deformable bodies whose pairs have all slid farther than the piece is long.
std::string slidOffNotes(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs) {
  struct Slide {
    BoundingBox box;
    double least = std::numeric_limits<double>::infinity();
    bool isRigid = false;
  };
  std::vector<Slide> slides(pieces.size());
  for (const PairResult& pair : pairs) {
    if (pair.piece < 0 || pair.piece >= int(pieces.size())) continue;
    Slide& slide = slides[pair.piece];
    slide.box.include(pair.position);
    slide.least = std::min(slide.least, norm(pair.slip));
    slide.isRigid = slide.isRigid || pair.bodies[0] < 0 || pair.bodies[1] < 0;
  }
  std::string said;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const double length = norm(minus(slides[p].box.high, slides[p].box.low));
    if (slides[p].isRigid || !std::isfinite(slides[p].least) || !(length > 0.0) || slides[p].least < length) continue;
    said += format(
        "warning: contact '%s': its sides have slid off each other: all pairs slid %.3g or more, but the contact is only %.3g long. "
        "Pairs keep their partners from the undeformed mesh\n",
        pieces[p].name.c_str(), slides[p].least, length);
  }
  return said;
}

}  // namespace

std::vector<std::string> plausibilityNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                           const std::vector<ContactPiece>& pieces, const Solution& solution) {
  std::vector<std::string> notes;
  const LargestStrain most = largestStrain(comm, meshes, solution.displacement);
  const auto at = [&](const Extreme& found) {
    return " at " + placeText(found.place, model.dimension) + " of '" + model.bodies[std::size_t(found.body)] + "'";
  };
  int moves = 0;
  const int mine = std::any_of(meshes.begin(), meshes.end(), [](const SubdomainMesh& mesh) { return !mesh.drawn.empty(); });
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(moves));
  std::string large;
  if (most.strain.value > kLarge) large = format("strains reach %.2g", most.strain.value) + at(most.strain);
  if (moves == 0 && most.rotation.value > kLarge)
    large += (large.empty() ? "" : ", ") + format("rotations reach %.2g rad", most.rotation.value) + at(most.rotation);
  if (!large.empty())
    notes.push_back(large + (moves ? ": Suture assumes small strains"
                                   : ": Suture assumes small strains and rotations, and contact pairs are those of the undeformed bodies"));
  for (std::size_t body = 0; moves != 0 && body < model.bodies.size(); ++body) {
    const LargestStrain own = largestStrain(comm, meshes, solution.displacement, 0.0, static_cast<int>(body));
    const double spurious = 0.5 * own.rotation.value * own.rotation.value;
    if (spurious > kSpurious * own.strain.value)
      notes.push_back("body '" + model.bodies[body] + "' bends too much for one frame: elements turn by up to " +
                      format("%.2g rad", own.rotation.value) + " against it," + at(own.rotation) +
                      format(", by linear theory a strain of %.2g", spurious) +
                      format(", and the largest strain is %.2g", own.strain.value));
  }
  std::string said;
  collectivelyOnRoot(comm, "examining the contacts", [&] {
    said = patchNotes(pieces, solution.pairs) + openEndNotes(pieces, solution.pairs) + slidOffNotes(pieces, solution.pairs);
  });
  std::istringstream lines(broadcast(comm, said));
  for (std::string line; std::getline(lines, line);) notes.push_back(line);
  return notes;
}

double maxDisplacement(const Run& run) { return largestDisplacement(run.comm, run.subdomains, run.solution.displacement); }

Memory peakMemory(const Comm& comm) { return memoryFigures(comm, peakMemoryMb()); }

RunFigures runFigures(const Run& run) {
  return {maxDisplacement(run), run.timers.statistics(run.comm), peakMemory(run.comm), dimensionOf(run)};
}

Memory memoryFigures(const Comm& comm, double mine) {
  Memory memory{};
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(memory.min));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(memory.max));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(memory.sum));
  memory.avg = memory.sum / comm.getSize();
  return memory;
}

ElementsByRank elementsByRank(const Run& run) {
  GlobalId mine = 0;
  for (const SubdomainMesh& mesh : run.subdomains) mine += mesh.elements();
  ElementsByRank elements{0, 0, 0, run.comm.getSize()};
  Teuchos::reduceAll(run.comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(elements.least));
  Teuchos::reduceAll(run.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(elements.most));
  Teuchos::reduceAll(run.comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(elements.sum));
  return elements;
}

}  // namespace suture
