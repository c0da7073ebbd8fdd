#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/partition/Apportion.hpp>
#include <suture/partition/Cut.hpp>
#include <suture/partition/ElementGraph.hpp>
#include <suture/partition/Hinges.hpp>
#include <suture/partition/MetisCut.hpp>

namespace suture {

Schema metisSchema() {
  return Schema("Every body is cut on its own by METIS, in proportion to its elements; all subdomains are connected through element sides.")
      .wordOrNumber("Subdomains", "Automatic", {"Automatic"}, Range::atLeast(1),
                    "How many in all, at least one a body. Automatic: one for about 7200 elements, to a multiple of four, up to six of 800 "
                    "in small scenes, and at least one a rank while each has 50 elements; only then does the cut depend on the number of "
                    "ranks.")
      .integer("Seed", 1, "Of METIS' random numbers: the same seed gives the same subdomains.", Range::atLeast(0));
}

int automaticSubdomains(int elements, int pieces, int ranks) {
  const int enough = (elements + 3600) / 7200, small = std::min((elements + 400) / 800, 6);
  const int large = enough > 6 ? (enough + 2) / 4 * 4 : enough;  // seven and six are no fair shares of two ranks
  return std::max({pieces, large, small, std::min(ranks, elements / 50)});
}

namespace {

// A connected part of a body of this rank's share.
struct Piece {
  int body;
  std::vector<int> elements;  // of the share
};

// The same, as rank 0 knows it.
struct PieceSize {
  int body, rank, elements;
};

// How it is cut.
struct PieceCut {
  int first, parts;  // its subdomains
};

// Body by body, so that the numbers of a body's subdomains follow each other.
std::vector<Piece> piecesOfBodies(const MeshShare& share, Components parts) {
  std::vector<Piece> pieces;
  for (std::vector<int>& elements : parts.elements) {
    const int body = share.bodyOfElement[elements.front()];
    pieces.push_back({body, std::move(elements)});
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.body < b.body; });
  return pieces;
}

// On rank 0, body by body.
std::vector<PieceSize> gatherSizes(const Comm& comm, const std::vector<Piece>& mine) {
  std::vector<PieceSize> sizes;
  for (const Piece& piece : mine) sizes.push_back({piece.body, comm.getRank(), static_cast<int>(piece.elements.size())});
  std::vector<PieceSize> all = joinOnRoot(comm, sizes);
  std::stable_sort(all.begin(), all.end(), [](const PieceSize& a, const PieceSize& b) { return a.body < b.body; });
  return all;
}

bool onePartEach(const std::vector<PieceSize>& pieces, std::size_t bodies) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].body != static_cast<int>(i)) return false;
  return pieces.size() == bodies;
}

std::string describe(const std::vector<std::string>& bodies, const std::vector<PieceSize>& pieces) {
  std::vector<int> count(bodies.size(), 0);
  for (const PieceSize& piece : pieces) ++count[piece.body];
  std::string text = std::to_string(bodies.size()) + (bodies.size() == 1 ? " body" : " bodies");
  for (std::size_t body = 0; body < count.size(); ++body)
    if (count[body] > 1) text += ", '" + bodies[body] + "' of " + std::to_string(count[body]) + " disconnected parts";
  return text;
}

int wantedSubdomains(const Mesh& mesh, const std::vector<PieceSize>& pieces, const Parameters& own, int ranks) {
  const std::string text = own.get<std::string>("Subdomains");
  const int elements = mesh.elements(), least = static_cast<int>(pieces.size());
  if (text == "Automatic") return automaticSubdomains(elements, least, ranks);
  const double number = std::stod(text);  // the reader has checked that it is one
  const std::string path = pathOf(own, "Subdomains");
  if (number != std::floor(number)) throw InputError(path, text + " is not a whole number");
  if (number > elements)
    throw InputError(
        path, text + " subdomains are more than the " + std::to_string(elements) + " elements of the mesh; every subdomain needs one");
  if (number < least)
    throw InputError(path, text + (number == 1 ? " subdomain is" : " subdomains are") + " too few for " + describe(mesh.bodies, pieces) +
                               ": a subdomain lies in one body and is connected, so at least " + std::to_string(least) + " are needed");
  return static_cast<int>(number);
}

std::string repaired(const std::string& body, int repairs) {
  return "METIS left subdomains of body '" + body + "' empty or hanging together by single nodes: " + std::to_string(repairs) +
         (repairs == 1 ? " fragment was" : " fragments were") + " given to a neighbour, so that every subdomain is connected through sides";
}

// Of each rank's pieces, in their order; names and bodies of all subdomains go to `cut`.
std::vector<std::vector<PieceCut>> numberSubdomains(const std::vector<PieceSize>& pieces, const std::vector<std::string>& bodies,
                                                    int wanted, int ranks, Cut& cut) {
  std::vector<int> sizes;
  for (const PieceSize& piece : pieces) sizes.push_back(piece.elements);
  const std::vector<int> parts = apportion(sizes, wanted);
  std::vector<std::vector<PieceCut>> of(ranks);
  std::vector<int> numberInBody(bodies.size(), 0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const int body = pieces[i].body;
    of[pieces[i].rank].push_back({static_cast<int>(cut.names.size()), parts[i]});
    for (int part = 0; part < parts[i]; ++part) {
      cut.bodyOf.push_back(body);
      cut.names.push_back(bodies[body] + " " + std::to_string(++numberInBody[body]));
    }
  }
  return of;
}

}  // namespace

Cut cutByMetis(const Comm& comm, const Mesh& mesh, const Parameters& own, MeshShare& share) {
  const std::string what = "partition";
  ElementGraph graph;
  std::vector<Piece> pieces;
  collectively(comm, what, [&] {
    graph = elementGraph(share.block(mesh));
    Problems problems;
    Components connected = components(graph, share.bodyOfElement);
    findHinges(share.block(mesh), share.bodyOfElement, share.bodies, connected, problems);
    problems.throwIfAny();
    pieces = piecesOfBodies(share, std::move(connected));
  });
  const std::vector<PieceSize> sizes = gatherSizes(comm, pieces);
  Cut cut;
  std::vector<std::vector<PieceCut>> cutsOf;
  collectivelyOnRoot(comm, what, [&] {
    cut.bodiesAreConnected = onePartEach(sizes, share.bodies.size());
    cutsOf = numberSubdomains(sizes, share.bodies, wantedSubdomains(mesh, sizes, own, comm.getSize()), comm.getSize(), cut);
  });
  const std::string bytes = scatterFromRoot(comm, what, [&](int rank) {
    Packer packer;
    packer.put(cutsOf[rank]);
    return std::move(packer).bytes();
  });
  std::map<int, int> repairs;  // by body
  collectively(comm, what, [&] {
    const auto cuts = Unpacker(bytes).get<std::vector<PieceCut>>();
    share.subdomainOfElement.assign(share.bodyOfElement.size(), -1);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::vector<int>& elements = pieces[i].elements;
      int fragments = 0;
      const ElementGraph part = pieces.size() == 1 ? std::move(graph) : subgraph(graph, elements);
      const std::vector<int> partOf = metisCut(part, cuts[i].parts, own.get<int>("Seed"), &fragments);
      if (fragments > 0) repairs[pieces[i].body] += fragments;
      for (std::size_t k = 0; k < elements.size(); ++k) share.subdomainOfElement[elements[k]] = cuts[i].first + partOf[k];
    }
    share.holders = nodeSubdomains(share.block(mesh), share.subdomainOfElement);
  });
  Packer packer;
  packer.put(repairs);
  std::map<int, int> all;
  for (const std::string& of : gatherOnRoot(comm, packer.bytes())) all.merge(Unpacker(of).get<std::map<int, int>>());
  for (const auto& [body, count] : all) cut.notes.push_back(repaired(share.bodies[body], count));
  return cut;
}

}  // namespace suture
