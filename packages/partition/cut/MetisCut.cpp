// The only source that includes METIS.
#include <metis.h>

#include <algorithm>
#include <numeric>
#include <suture/base/Errors.hpp>
#include <suture/partition/cut/BisectionInSpace.hpp>
#include <suture/partition/cut/ConnectedParts.hpp>
#include <suture/partition/cut/MetisCut.hpp>

namespace suture {
namespace {

// Recursive bisection gives the better cut for few parts, according to METIS' manual.
bool isBisected(int parts) { return parts <= 8; }

// Load that the k-way method allows above the mean, in thousandths. METIS' default is 30: with 23 elements per part, no element could move
// without breaking it, and parts interlock like combs. 160 x 160 squares in 1100 parts, with 30 and with 2.5 elements: 27,600 and 11,000
// sides cut, at most 31 and 9 between two parts; BDDC has condition numbers of 68 and 3.
int tolerance(double elementsPerPart) {
  constexpr double least = 30.0, elements = 2.5;
  return static_cast<int>(std::max(least, 1000.0 * elements / elementsPerPart));
}

// Problem for METIS; null: every vertex and side has weight one, all parts are equal.
struct Question {
  const ElementGraph& graph;
  int parts;
  const std::vector<int>*elements = nullptr, *sides = nullptr, *shares = nullptr;
};

std::vector<idx_t> indices(const std::vector<int>* values) {
  return values ? std::vector<idx_t>(values->begin(), values->end()) : std::vector<idx_t>();
}

std::vector<int> metis(const Question& asked, int seed, bool bisected, bool connected) {
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = seed;
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_CONTIG] = connected;  // for the k-way method; allowed because the graph is connected
  const ElementGraph& graph = asked.graph;
  idx_t vertices = graph.elements(), constraints = 1, wanted = asked.parts, cut = 0;
  if (!bisected) options[METIS_OPTION_UFACTOR] = tolerance(static_cast<double>(vertices) / wanted);
  std::vector<idx_t> offsets = indices(&graph.offsets), neighbours = indices(&graph.neighbours);
  std::vector<idx_t> elements = indices(asked.elements), sides = indices(asked.sides);
  std::vector<real_t> shares;
  if (asked.shares) {
    const auto sum = static_cast<real_t>(std::accumulate(asked.shares->begin(), asked.shares->end(), 0));
    for (const int share : *asked.shares) shares.push_back(static_cast<real_t>(share) / sum);
  }
  std::vector<idx_t> partOf(graph.elements(), 0);
  const auto dataOf = [](auto& values) { return values.empty() ? nullptr : values.data(); };
  const auto method = bisected ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = method(&vertices, &constraints, offsets.data(), neighbours.data(), dataOf(elements), nullptr, dataOf(sides), &wanted,
                            dataOf(shares), nullptr, options, &cut, partOf.data());
  if (status == METIS_ERROR_MEMORY) throw EnvironmentError("METIS ran out of memory cutting " + std::to_string(vertices) + " elements");
  if (status != METIS_OK)
    throw InternalError("METIS failed with status " + std::to_string(status) + " cutting " + std::to_string(vertices) + " elements into " +
                        std::to_string(wanted) + " parts");
  return {partOf.begin(), partOf.end()};
}

std::vector<int> cutInSpace(const ElementGraph& graph, int parts, int seed) {
  const auto bisection = [seed](const ElementGraph& part, double share) {
    constexpr int wholes = 1 << 20;
    const std::vector<int> shares{static_cast<int>(share * wholes), wholes - static_cast<int>(share * wholes)};
    const std::vector<int> half = metis({part, 2, nullptr, nullptr, &shares}, seed, true, false);
    return std::vector<char>(half.begin(), half.end());
  };
  return bisectInSpace(graph, parts, bisection);
}

}  // namespace

std::vector<int> metisCut(const ElementGraph& graph, int parts, int seed, int* repairs) {
  std::vector<int> partOf(graph.elements(), 0);
  // METIS divides by zero for one part. With few elements per part it leaves parts empty and prints its own messages: then the bisection in
  // makeConnected() does all the cutting.
  constexpr int leastElementsAPart = 8;
  const bool byMetis = parts > 1 && graph.elements() >= leastElementsAPart * parts;
  const bool inSpace = !graph.centres.empty();
  if (byMetis) partOf = inSpace ? cutInSpace(graph, parts, seed) : metis({graph, parts}, seed, isBisected(parts), false);
  int changes = makeConnected(graph, parts, partOf);
  // METIS' own search for fragments takes a third of its time (466,000 elements in 66 parts: 0.35 instead of 0.23 s, the same cut), and
  // large parts rarely have any. If there are fragments, METIS balances better than giving them away.
  if (byMetis && changes > 0 && !isBisected(parts) && !inSpace) {
    partOf = metis({graph, parts}, seed, false, true);
    changes = makeConnected(graph, parts, partOf);
  }
  if (repairs) *repairs = byMetis ? changes : 0;
  return partOf;
}

std::vector<int> metisShares(const GroupGraph& groups, const std::vector<int>& shares, int seed) {
  return metis({groups.graph, static_cast<int>(shares.size()), &groups.elements, &groups.sides, &shares}, seed, true, false);
}

}  // namespace suture
