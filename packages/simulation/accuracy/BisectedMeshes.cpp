#include <suture/adapt/Bisection.hpp>
#include <suture/adapt/MarkElements.hpp>
#include <suture/adapt/SimplicialMesh.hpp>
#include <suture/adapt/SingularVertices.hpp>
#include <suture/base/Collective.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/simulation/ReadStage.hpp>
#include <suture/simulation/accuracy/BisectedMeshes.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace suture {

namespace {

constexpr double kShares[] = {0.6, 0.3, 0.15};  // shares of the squared error in marked elements; the smaller ones near the cap

constexpr double kMostGrowth = 2.0;  // elements of a mesh over those of the one before, up to which predicted errors are trusted

constexpr int kHalvings = 2;

/// The list Mesh with half as many cells in each direction of all boxes, so that matching faces stay matching; null if a number is odd or
/// too small, or other parameters refer to cells.
Teuchos::RCP<Parameters> halvedCells(const Parameters& mesh) {
  if (mesh.get<std::string>("Generator") != "Boxes") return Teuchos::null;
  auto coarse = Teuchos::rcp(new Parameters(mesh));
  Parameters& boxes = coarse->sublist("Boxes");
  for (const std::string& name : sublistNames(boxes)) {
    Parameters& box = boxes.sublist(name);
    if (!box.isParameter("Cells") || box.isParameter("Blocks") || box.isParameter("Bricks")) return Teuchos::null;
    auto cells = box.get<Teuchos::Array<int>>("Cells");
    for (int& count : cells) {
      if (count % 2 != 0 || count < 4) return Teuchos::null;
      count /= 2;
    }
    box.set("Cells", cells);
  }
  return coarse;
}

class BisectedMeshes : public MeshSequence {
 public:
  BisectedMeshes(Scene scene, std::vector<Contact> contacts, int order, PolygonSides sides)
      : scene_(std::move(scene)), contacts_(std::move(contacts)), order_(order), sides_(std::move(sides)) {
    scene_.coat = nullptr;  // coatings follow when the mesh is read
  }

  Mesh start(const Comm& comm) override {
    const Mesh given = readBodies(comm, coarsest());
    collectivelyOnRoot(comm, "cutting the mesh into simplices", [&] {
      Mesh simplices = simplicialMesh(given, order_, contactTwins(given, contacts_)).mesh;
      std::vector<NodePairs> twins = contactTwins(simplices, contacts_);
      present_ = refinable(std::move(simplices), std::move(twins));
    });
    return polygon(comm);
  }

  MeshPlan plan(const MeshErrors& errors) override {
    std::vector<double> squares = errors.squares;
    for (std::size_t s = 0; s < errors.polygon.sides.size(); ++s)
      squares[static_cast<std::size_t>(errors.polygon.sides[s].element)] += errors.polygon.squares[s];
    if (errors.isUniform) {
      planned_ = bisect(present_, std::vector<char>(squares.size(), 1)).fine;
      return {static_cast<double>(planned_.mesh.elements()), false};
    }
    planned_ = present_;
    bool isRefined = false;
    const double most = kMostGrowth * present_.mesh.elements();
    while (!isRefined || (planned_.mesh.elements() < most && sum(squares) > errors.wanted.square)) {
      std::optional<Refinement> refined = marked(squares, errors.wanted.mostElements);
      if (!refined) break;
      squares = predicted(planned_.mesh, squares, *refined);
      planned_ = std::move(refined->fine);
      isRefined = true;
    }
    return {static_cast<double>(planned_.mesh.elements()), !isRefined};
  }

  Mesh next(const Comm& comm) override {
    present_ = std::move(planned_);
    return polygon(comm);
  }

  std::optional<std::vector<ChordSide>> chords(const Mesh& whole) const override { return sides_.of(whole); }

  std::string name() const override { return "bisection"; }

 private:
  static double sum(const std::vector<double>& squares) { return std::accumulate(squares.begin(), squares.end(), 0.0); }

  /// The planned mesh with its marked elements bisected; nothing if it has too many elements.
  std::optional<Refinement> marked(const std::vector<double>& squares, double mostElements) const {
    for (const double share : kShares) {
      Refinement refined = bisect(planned_, markElements(squares, share));
      if (refined.fine.mesh.elements() <= mostElements) return refined;
    }
    return std::nullopt;
  }

  /// Squared errors expected after a refinement: parts of n-th volume have errors of n^(-k / d); those at singular vertices fall less.
  std::vector<double> predicted(const Mesh& coarse, const std::vector<double>& squares, const Refinement& refined) const {
    const Mesh& fine = refined.fine.mesh;
    const std::vector<int> singular = singularVertices(coarse, squares);
    std::vector<int> parts(squares.size(), 0), atVertex(squares.size(), 0);
    const auto isAtVertex = [&](int e) {
      const Span<const int> nodes = fine.nodesOf(e);
      const int vertex = singular[static_cast<std::size_t>(refined.parent[static_cast<std::size_t>(e)])];
      return vertex >= 0 && std::find(nodes.begin(), nodes.begin() + fine.dimension + 1, vertex) != nodes.begin() + fine.dimension + 1;
    };
    for (int e = 0; e < fine.elements(); ++e) {
      const auto parent = static_cast<std::size_t>(refined.parent[static_cast<std::size_t>(e)]);
      ++parts[parent];
      if (isAtVertex(e)) ++atVertex[parent];
    }
    std::vector<double> all;
    for (int e = 0; e < fine.elements(); ++e) {
      const auto parent = static_cast<std::size_t>(refined.parent[static_cast<std::size_t>(e)]);
      const bool isSingular = isAtVertex(e);
      const double order = isSingular ? kSingularOrder : order_;
      const double count = isSingular ? atVertex[parent] : parts[parent];
      all.push_back(squares[parent] / count * std::pow(parts[parent], -2 * order / fine.dimension));
    }
    return all;
  }

  /// The present mesh with straight sides.
  Mesh polygon(const Comm& comm) {
    Mesh mesh = present_.mesh;
    sides_.straighten(comm, mesh);
    return mesh;
  }

  /// The scene with larger cells, where its mesh is made of boxes.
  Scene coarsest() const {
    Scene scene = scene_;
    Teuchos::RCP<const Parameters> mesh = Teuchos::rcpFromRef(scene_.settings().sublist("Mesh"));
    for (int k = 0; k < kHalvings; ++k) {
      const Teuchos::RCP<const Parameters> coarse = halvedCells(*mesh);
      if (coarse.is_null()) break;
      mesh = coarse;
      scene.mesh = [coarse](const Comm& comm) { return readMesh(comm, *coarse, ""); };
    }
    return scene;
  }

  Scene scene_;
  std::vector<Contact> contacts_;
  int order_;
  PolygonSides sides_;
  RefinableMesh present_, planned_;  // on rank 0
};

}  // namespace

std::shared_ptr<MeshSequence> bisectedMeshes(const Scene& scene, std::vector<Contact> contacts, int order, PolygonSides sides) {
  return std::make_shared<BisectedMeshes>(scene, std::move(contacts), order, std::move(sides));
}

}  // namespace suture
