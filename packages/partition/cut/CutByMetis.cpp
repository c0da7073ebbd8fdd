#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <suture/algebra/CostModel.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/partition/cut/Apportion.hpp>
#include <suture/partition/cut/Blocks.hpp>
#include <suture/partition/cut/Cut.hpp>
#include <suture/partition/cut/CutBlocks.hpp>
#include <suture/partition/cut/ElementGraph.hpp>
#include <suture/partition/cut/Hinges.hpp>
#include <suture/partition/cut/Numbering.hpp>

namespace suture {

Schema metisSchema() {
  return Schema("METIS cuts every body separately, in proportion to its elements; all subdomains are connected through element sides.")
      .wordOrNumber(
          "Subdomains", "Automatic", {"Automatic"}, Range::atLeast(1),
          "Total number, at least one per body. Automatic: in 2D one per about 7200 elements, rounded to a multiple of four, up to "
          "six of 800 elements in small scenes; in 3D one per about 700 nodes; and at least one per rank if each has 50 elements; "
          "only this rule makes the cut depend on the number of ranks.")
      .integer("Seed", 1, "Seed of METIS' random numbers: the same seed gives the same subdomains.", Range::atLeast(0));
}

int automaticSubdomainsInSpace(int nodes, int elements, int pieces, int ranks) {
  const int enough = (nodes + CostModel::kNodesInSpace / 2) / CostModel::kNodesInSpace;
  return std::max({pieces, enough > 6 ? (enough + 2) / 4 * 4 : enough, std::min(ranks, elements / 50)});
}

int automaticSubdomains(int elements, int pieces, int ranks) {
  const int enough = (elements + CostModel::kElements / 2) / CostModel::kElements, small = std::min((elements + 400) / 800, 6);
  const int large = enough > 6 ? (enough + 2) / 4 * 4 : enough;  // 13 subdomains on two ranks (seven and six) are not balanced
  return std::max({pieces, large, small, std::min(ranks, elements / 50)});
}

namespace {

// A connected part of a body, in rank 0's list of all parts.
struct PartSize {
  int body, rank, elements;
};

// Sorted by body: the numbers of a body's subdomains are consecutive.
std::vector<std::vector<int>> partsOfBodies(const MeshShare& share, Components connected) {
  std::vector<std::vector<int>> parts = std::move(connected.elements);
  const auto bodyOf = [&](const std::vector<int>& elements) { return share.bodyOfElement[elements.front()]; };
  std::stable_sort(parts.begin(), parts.end(), [&](const auto& a, const auto& b) { return bodyOf(a) < bodyOf(b); });
  return parts;
}

// Sizes of all parts on rank 0, sorted by body.
std::vector<PartSize> gatherSizes(const Comm& comm, const MeshShare& share, const std::vector<std::vector<int>>& mine) {
  std::vector<PartSize> sizes;
  for (const std::vector<int>& elements : mine)
    sizes.push_back({share.bodyOfElement[elements.front()], comm.getRank(), static_cast<int>(elements.size())});
  std::vector<PartSize> all = joinOnRoot(comm, sizes);
  std::stable_sort(all.begin(), all.end(), [](const PartSize& a, const PartSize& b) { return a.body < b.body; });
  return all;
}

bool onePartEach(const std::vector<PartSize>& parts, std::size_t bodies) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].body != static_cast<int>(i)) return false;
  return parts.size() == bodies;
}

std::string describe(const std::vector<std::string>& bodies, const std::vector<PartSize>& parts) {
  std::vector<int> count(bodies.size(), 0);
  for (const PartSize& part : parts) ++count[part.body];
  std::string text = std::to_string(bodies.size()) + (bodies.size() == 1 ? " body" : " bodies");
  for (std::size_t body = 0; body < count.size(); ++body)
    if (count[body] > 1) text += ", '" + bodies[body] + "' of " + std::to_string(count[body]) + " disconnected parts";
  return text;
}

int wantedSubdomains(const Mesh& mesh, const std::vector<PartSize>& parts, const Parameters& own, int ranks) {
  const std::string text = own.get<std::string>("Subdomains");
  const int elements = mesh.elements(), least = static_cast<int>(parts.size());
  if (text == "Automatic")
    return mesh.dimension == 2 ? automaticSubdomains(elements, least, ranks)
                               : automaticSubdomainsInSpace(mesh.nodes(), elements, least, ranks);
  const double number = std::stod(text);  // the reader has checked that it is a number
  const std::string path = pathOf(own, "Subdomains");
  if (number != std::floor(number)) throw InputError(path, text + " is not a whole number");
  if (number > elements)
    throw InputError(path, text + " subdomains are more than the " + std::to_string(elements) +
                               " elements of the mesh; every subdomain needs one element");
  if (number < least)
    throw InputError(path, text + (number == 1 ? " subdomain is" : " subdomains are") + " too few for " + describe(mesh.bodies, parts) +
                               ": a subdomain lies in one body and is connected; at least " + std::to_string(least) + " are needed");
  return static_cast<int>(number);
}

std::string repaired(const std::string& body, int repairs) {
  return "METIS left subdomains of body '" + body + "' empty or connected by single nodes only: " + std::to_string(repairs) +
         (repairs == 1 ? " fragment was" : " fragments were") + " moved to a neighbour; every subdomain is now connected through sides";
}

// Blocks in the order of their numbers; names and bodies of all subdomains are added to `cut`.
std::vector<Block> makeBlocks(const std::vector<PartSize>& parts, const std::vector<std::string>& bodies, int wanted, int ranks, Cut& cut) {
  std::vector<int> sizes;
  for (const PartSize& part : parts) sizes.push_back(part.elements);
  const std::vector<int> subdomains = apportion(sizes, wanted);
  std::vector<int> partsOfRank(ranks, 0);
  std::vector<Block> blocks;
  std::vector<int> elements;  // approximate number of elements of each block
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const int body = parts[i].body, part = partsOfRank[parts[i].rank]++;
    for (const int own : subdomainsOfBlocks(sizes[i], subdomains[i])) {
      blocks.push_back({parts[i].rank, part, static_cast<int>(cut.bodyOf.size()), own, 0});
      elements.push_back(static_cast<int>((long long)sizes[i] * own / subdomains[i]));
      cut.bodyOf.insert(cut.bodyOf.end(), own, body);
    }
  }
  cut.names = numberedNames(bodies, cut.bodyOf);
  placeBlocks(elements, ranks, blocks);
  return blocks;
}

// Blocks owned by a rank.
std::vector<Block> blocksOf(int rank, const std::vector<Block>& all) {
  std::vector<Block> own;
  std::copy_if(all.begin(), all.end(), std::back_inserter(own), [rank](const Block& block) { return block.owner == rank; });
  return own;
}

}  // namespace

Cut cutByMetis(const Comm& comm, const Mesh& mesh, const Parameters& own, MeshShare& share) {
  const std::string what = "partition";
  const int seed = own.get<int>("Seed");
  ElementGraph graph;
  std::vector<std::vector<int>> parts;
  collectively(comm, what, [&] {
    graph = elementGraph(share.block(mesh));
    Problems problems;
    Components connected = components(graph, share.bodyOfElement);
    findHinges(share.block(mesh), share.bodyOfElement, share.bodies, connected, problems);
    problems.throwIfAny();
    parts = partsOfBodies(share, std::move(connected));
  });
  const std::vector<PartSize> sizes = gatherSizes(comm, share, parts);
  Cut cut;
  std::vector<Block> blocks;
  collectivelyOnRoot(comm, what, [&] {
    cut.bodiesAreConnected = onePartEach(sizes, share.bodies.size());
    blocks = makeBlocks(sizes, share.bodies, wantedSubdomains(mesh, sizes, own, comm.getSize()), comm.getSize(), cut);
  });
  broadcast(comm, blocks);
  const std::vector<Block> mine = blocksOf(comm.getRank(), blocks);
  std::vector<int> blockOf;
  std::vector<ElementGraph> graphs;
  collectively(comm, what, [&] {
    std::vector<std::vector<int>> subdomains(parts.size());
    for (const Block& block : mine) subdomains[block.part].push_back(block.subdomains);
    blockOf = cutIntoBlocks(graph, parts, subdomains, seed);
    if (mine.size() == 1)
      graphs.push_back(std::move(graph));
    else
      graphs = subgraphs(graph, blockOf, static_cast<int>(mine.size()));
    graph = ElementGraph();
  });
  const std::vector<BlockCut> cuts = cutBlocks(comm, blocks, std::move(graphs), seed);
  std::map<int, int> repairs;  // by body
  collectively(comm, what, [&] {
    std::vector<std::size_t> next(mine.size(), 0);  // next element of each block
    share.subdomainOfElement.reserve(blockOf.size());
    for (const int block : blockOf) share.subdomainOfElement.push_back(mine[block].first + cuts[block].partOf[next[block]++]);
    for (std::size_t block = 0; block < mine.size(); ++block)
      if (cuts[block].repairs > 0) repairs[share.bodyOfElement[parts[mine[block].part].front()]] += cuts[block].repairs;
    share.holders = nodeSubdomains(share.block(mesh), share.subdomainOfElement);
  });
  Packer packer;
  packer.put(repairs);
  std::map<int, int> all;
  for (const std::string& of : gatherOnRoot(comm, packer.bytes())) all.merge(Unpacker(of).get<std::map<int, int>>());
  numberSubdomainsAlongCurve(comm, mesh, share, cut);
  if (comm.getRank() == 0) cut.names = numberedNames(share.bodies, cut.bodyOf);
  for (const auto& [body, count] : all) cut.notes.push_back(repaired(share.bodies[body], count));
  return cut;
}

}  // namespace suture
