// The only source that includes METIS.
#include <metis.h>

#include <suture/base/Errors.hpp>
#include <suture/partition/ConnectedParts.hpp>
#include <suture/partition/MetisCut.hpp>

namespace suture {
namespace {

// Recursive bisection gives the better cut for few parts, as METIS' own manual says.
bool isBisected(int parts) { return parts <= 8; }

std::vector<int> metis(const ElementGraph& graph, int parts, int seed, bool connected) {
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = seed;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_CONTIG] = connected;  // for the k-way method; allowed because the graph is connected
  idx_t vertices = graph.elements(), constraints = 1, wanted = parts, cut = 0;
  std::vector<idx_t> offsets(graph.offsets.begin(), graph.offsets.end()), neighbours(graph.neighbours.begin(), graph.neighbours.end());
  std::vector<idx_t> partOf(graph.elements(), 0);
  const auto method = isBisected(parts) ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = method(&vertices, &constraints, offsets.data(), neighbours.data(), nullptr, nullptr, nullptr, &wanted, nullptr,
                            nullptr, options, &cut, partOf.data());
  if (status == METIS_ERROR_MEMORY) throw EnvironmentError("METIS ran out of memory cutting " + std::to_string(vertices) + " elements");
  if (status != METIS_OK)
    throw InternalError("METIS failed with status " + std::to_string(status) + " cutting " + std::to_string(vertices) + " elements into " +
                        std::to_string(parts) + " parts");
  return {partOf.begin(), partOf.end()};
}

}  // namespace

std::vector<int> metisCut(const ElementGraph& graph, int parts, int seed, int* repairs) {
  std::vector<int> partOf(graph.elements(), 0);
  // One part is a division by zero in METIS. With a handful of elements a part it leaves parts empty and prints messages of its own:
  // there the bisection in makeConnected() does all the cutting.
  constexpr int leastElementsAPart = 8;
  const bool byMetis = parts > 1 && graph.elements() >= leastElementsAPart * parts;
  if (byMetis) partOf = metis(graph, parts, seed, false);
  int changes = makeConnected(graph, parts, partOf);
  // METIS' own search for fragments takes a third of its time (466,000 elements in 66 parts: 0.35 instead of 0.23 s, the same cut), and
  // large parts rarely have any. Where there are some, it balances better than giving them away.
  if (byMetis && changes > 0 && !isBisected(parts)) {
    partOf = metis(graph, parts, seed, true);
    changes = makeConnected(graph, parts, partOf);
  }
  if (repairs) *repairs = byMetis ? changes : 0;
  return partOf;
}

}  // namespace suture
