#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <suture/base/Collective.hpp>
#include <suture/partition/RigidLift.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Format.hpp>

namespace suture {

ContactFigures contactFigures(const std::vector<PairResult>& pairs, int pieces) {
  ContactFigures all;
  all.pairs = int(pairs.size());
  all.forceOnB.assign(std::size_t(pieces), Point{0, 0, 0});
  all.pressureOf.assign(std::size_t(pieces), 0.0);
  all.gapOf.assign(std::size_t(pieces), 0.0);
  all.pairsOf.assign(std::size_t(pieces), 0);
  all.activeOf.assign(std::size_t(pieces), 0);
  for (const PairResult& pair : pairs) {
    const bool closed = pair.status != PairStatus::Open;
    all.active += closed;
    all.maxPressure = std::max(all.maxPressure, pair.pressure);
    all.maxGap = std::max(all.maxGap, pair.gap);
    all.maxPenetration = std::max(all.maxPenetration, -pair.gap);
    if (pair.piece < 0 || pair.piece >= pieces) continue;
    const auto piece = std::size_t(pair.piece);
    // The normal points from A to B, hence a compressive force pushes B along it.
    for (int k = 0; k < 3; ++k) all.forceOnB[piece][std::size_t(k)] += pair.force * pair.normal[std::size_t(k)];
    all.pressureOf[piece] = std::max(all.pressureOf[piece], pair.pressure);
    all.gapOf[piece] = std::max(all.gapOf[piece], pair.gap);
    all.pairsOf[piece] += 1;
    all.activeOf[piece] += closed;
  }
  return all;
}

double pressureError(const ContactPiece& piece, double largest) { return largest > 0 ? piece.pressureDoubt / largest : 0.0; }

std::vector<std::string> pressureNotes(const Comm& comm, const std::vector<ContactPiece>& pieces, const Solution& solution) {
  std::string said;
  collectivelyOnRoot(comm, "estimating contact pressures", [&] {
    const ContactFigures figures = contactFigures(solution.pairs, int(pieces.size()));
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const double error = pressureError(pieces[p], figures.pressureOf[p]);
      if (error < 0.01) continue;
      const bool large = error > 0.1;
      said += format("%scontact '%s': estimated error of nodal pressures %.0f %% of the largest, by straight elements on curved sides%s\n",
                     large ? "warning: " : "", pieces[p].name.c_str(), 100 * error,
                     large ? ". Finer elements there, second order, or Geometry = Automatic with accurate coordinates reduce it" : "");
    }
  });
  std::istringstream lines(broadcast(comm, said));
  std::vector<std::string> notes;
  for (std::string line; std::getline(lines, line);) notes.push_back(line);
  return notes;
}

double maxDisplacement(const Run& run) {
  double squared = 0.0;
  for (std::size_t s = 0; s < run.subdomains.size(); ++s) {
    const int d = run.subdomains[s].dimension;
    const Vector u = withLift(run.subdomains[s], run.solution.displacement[s]);
    for (int n = 0; n < run.subdomains[s].nodes(); ++n) squared = std::max(squared, u.segment(n * d, d).squaredNorm());
  }
  double all = 0.0;
  Teuchos::reduceAll(run.comm, Teuchos::REDUCE_MAX, squared, Teuchos::outArg(all));
  return std::sqrt(all);
}

Memory peakMemory(const Comm& comm) { return memoryFigures(comm, peakMemoryMb()); }

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
