#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/partition/Apportion.hpp>
#include <suture/partition/Cut.hpp>
#include <suture/partition/ElementGraph.hpp>
#include <suture/partition/Hinges.hpp>
#include <suture/partition/MetisCut.hpp>
#include <suture/partition/Placement.hpp>

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

// A connected part of a body.
struct Piece {
  int body;
  std::vector<int> elements;
};

// Body by body, so that the numbers of a body's subdomains follow each other.
std::vector<Piece> piecesOfBodies(const Mesh& mesh, Components parts) {
  std::vector<Piece> pieces;
  for (std::vector<int>& elements : parts.elements) {
    const int body = mesh.bodyOfElement[elements.front()];
    pieces.push_back({body, std::move(elements)});
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.body < b.body; });
  return pieces;
}

std::string describe(const Mesh& mesh, const std::vector<Piece>& pieces) {
  std::vector<int> count(mesh.bodies.size(), 0);
  for (const Piece& piece : pieces) ++count[piece.body];
  std::string text = std::to_string(mesh.bodies.size()) + (mesh.bodies.size() == 1 ? " body" : " bodies");
  for (std::size_t body = 0; body < count.size(); ++body)
    if (count[body] > 1) text += ", '" + mesh.bodies[body] + "' of " + std::to_string(count[body]) + " disconnected parts";
  return text;
}

int wantedSubdomains(const Mesh& mesh, const std::vector<Piece>& pieces, const Parameters& own, int ranks) {
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
    throw InputError(path, text + (number == 1 ? " subdomain is" : " subdomains are") + " too few for " + describe(mesh, pieces) +
                               ": a subdomain lies in one body and is connected, so at least " + std::to_string(least) + " are needed");
  return static_cast<int>(number);
}

std::string repaired(const std::string& body, int repairs) {
  return "METIS left subdomains of body '" + body + "' empty or hanging together by single nodes: " + std::to_string(repairs) +
         (repairs == 1 ? " fragment was" : " fragments were") + " given to a neighbour, so that every subdomain is connected through sides";
}

/// One piece's share of the work, as it travels to the rank that does it.
std::string packed(std::size_t piece, int parts, const ElementGraph& graph) {
  Packer packer;
  packer.put(piece);
  packer.put(parts);
  packer.put(graph.offsets);
  packer.put(graph.neighbours);
  return std::move(packer).bytes();
}

/// Cuts the pieces that came, and packs for each its number, the part of each of its elements, and the repairs.
std::string cutPieces(const std::string& work, int seed) {
  Packer done;
  for (Unpacker unpacker(work); !unpacker.done();) {
    const auto piece = unpacker.get<std::size_t>();
    const int parts = unpacker.get<int>();
    ElementGraph graph;
    unpacker.get(graph.offsets);
    unpacker.get(graph.neighbours);
    int repairs = 0;
    done.put(piece);
    done.put(metisCut(graph, parts, seed, &repairs));
    done.put(repairs);
  }
  return std::move(done).bytes();
}

}  // namespace

Cut cutByMetis(const Comm& comm, const Mesh& mesh, const Parameters& own) {
  const std::string what = "partition";
  ElementGraph graph;
  std::vector<Piece> pieces;
  std::vector<int> parts, rankOf;
  collectivelyOnRoot(comm, what, [&] {
    graph = elementGraph(mesh);
    Problems problems;
    Components connected = components(graph, mesh.bodyOfElement);
    findHinges(mesh, connected, problems);
    problems.throwIfAny();
    pieces = piecesOfBodies(mesh, std::move(connected));
    std::vector<int> sizes;
    for (const Piece& piece : pieces) sizes.push_back(static_cast<int>(piece.elements.size()));
    parts = apportion(sizes, wantedSubdomains(mesh, pieces, own, comm.getSize()));
    rankOf = placeOnRanks(std::vector<long long>(sizes.begin(), sizes.end()), comm.getSize());
  });
  const std::string work = scatterFromRoot(comm, what, [&](int rank) {
    std::string all;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (rankOf[i] == rank) all += packed(i, parts[i], subgraph(graph, pieces[i].elements));
    return all;
  });
  std::string mine;
  collectively(comm, what, [&] { mine = cutPieces(work, own.get<int>("Seed")); });
  const std::vector<std::string> results = gatherOnRoot(comm, mine);

  Cut cut;
  collectivelyOnRoot(comm, what, [&] {
    std::vector<std::vector<int>> partOf(pieces.size());
    std::vector<int> repairs(pieces.size());
    for (const std::string& bytes : results)
      for (Unpacker unpacker(bytes); !unpacker.done();) {
        const auto piece = unpacker.get<std::size_t>();
        unpacker.get(partOf[piece]);
        unpacker.get(repairs[piece]);
      }
    cut.subdomainOfElement.assign(mesh.elements(), -1);
    std::vector<int> numberInBody(mesh.bodies.size(), 0);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const int first = static_cast<int>(cut.names.size());
      if (repairs[i] > 0) cut.notes.push_back(repaired(mesh.bodies[pieces[i].body], repairs[i]));
      for (std::size_t k = 0; k < partOf[i].size(); ++k) cut.subdomainOfElement[pieces[i].elements[k]] = first + partOf[i][k];
      for (int part = 0; part < parts[i]; ++part) {
        cut.bodyOf.push_back(pieces[i].body);
        cut.names.push_back(mesh.bodies[pieces[i].body] + " " + std::to_string(++numberInBody[pieces[i].body]));
      }
    }
  });
  return cut;
}

}  // namespace suture
