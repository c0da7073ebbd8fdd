#include <suture/adapt/Bisection.hpp>
#include <suture/adapt/MarkElements.hpp>
#include <suture/adapt/SimplicialMesh.hpp>
#include <suture/base/Collective.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/simulation/BisectedMeshes.hpp>
#include <suture/simulation/ReadStage.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

namespace suture {

namespace {

constexpr double kShares[] = {0.6, 0.3, 0.15};  // shares of the squared error in marked elements; the smaller ones near the cap

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
  BisectedMeshes(Scene scene, std::vector<Contact> contacts, int order)
      : scene_(std::move(scene)), contacts_(std::move(contacts)), order_(order) {
    scene_.coat = nullptr;  // coatings follow when the mesh is read
  }

  Mesh start(const Comm& comm) override {
    const Mesh given = readBodies(comm, coarsest());
    collectivelyOnRoot(comm, "cutting the mesh into simplices", [&] {
      Mesh simplices = simplicialMesh(given, order_, contactTwins(given, contacts_)).mesh;
      std::vector<NodePairs> twins = contactTwins(simplices, contacts_);
      present_ = refinable(std::move(simplices), std::move(twins));
    });
    return present_.mesh;
  }

  MeshPlan plan(const MeshErrors& errors) override {
    for (const double share : kShares) {
      const std::vector<char> marked = errors.isUniform ? std::vector<char>(errors.squares.size(), 1) : markElements(errors.squares, share);
      Refinement refined = bisect(present_, marked);
      const double elements = refined.fine.mesh.elements();
      if (elements > errors.wanted.mostElements) continue;
      planned_ = std::move(refined.fine);
      return {elements, false};
    }
    return {static_cast<double>(present_.mesh.elements()), true};
  }

  Mesh next(const Comm&) override {
    present_ = std::move(planned_);
    return present_.mesh;
  }

  std::string name() const override { return "bisection"; }

 private:
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
  RefinableMesh present_, planned_;  // on rank 0
};

}  // namespace

std::shared_ptr<MeshSequence> bisectedMeshes(const Scene& scene, std::vector<Contact> contacts, int order) {
  return std::make_shared<BisectedMeshes>(scene, std::move(contacts), order);
}

}  // namespace suture
