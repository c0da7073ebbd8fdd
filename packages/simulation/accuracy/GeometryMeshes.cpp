#include <suture/adapt/Chords.hpp>
#include <suture/base/Collective.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/simulation/ReadStage.hpp>
#include <suture/simulation/accuracy/GeometryMeshes.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// Sizes of the elements of the first mesh over those of the scene's own, in the order in which they are tried.
constexpr double kCoarser[] = {4.0, 2.0, 1.0};
/// Squared effects of straight sides over the wanted squared error of a mesh, of which the cheapest is chosen.
constexpr double kShareOfCurves[] = {0.1, 0.2};

// Elements over their largest number up to which a mesh is accepted, and times that it is made again with larger elements otherwise: the
// mesher makes about 1.5 times as many elements as a graded size field predicts.
constexpr double kOverCap = 1.1;
constexpr int kMadeAgain = 3;

class GeometryMeshes : public MeshSequence {
 public:
  GeometryMeshes(Scene scene, int order, PolygonSides sides) : scene_(std::move(scene)), order_(order), sides_(std::move(sides)) {}

  /// The coarsest mesh that fits the scene: on a coarse one bodies may overlap, or contact sides have no pairs.
  Mesh start(const Comm& comm) override {
    MeshChanges changes;
    for (const double factor : kCoarser) {
      changes.factor = factor;
      Mesh made = mesh(comm, changes);
      if (factor == kCoarser[2] || fits(comm, made)) return made;
    }
    return {};
  }

  MeshPlan plan(const MeshErrors& errors) override {
    SizePlan found = errors.isUniform ? uniformSizes(errors.whole, 0.5) : cheapest(errors);
    sizes_ = std::make_shared<const SizeField>(std::move(found.field));
    mostElements_ = errors.wanted.mostElements;
    return {found.elements, found.isCapped};
  }

  Mesh next(const Comm& comm) override {
    MeshChanges changes;
    changes.simplices = true;
    for (int again = 0;; ++again) {
      changes.sizes = sizes_;
      Mesh made = mesh(comm, changes);
      double over = made.elements() / mostElements_;  // meaningful on rank 0
      broadcastBytes(comm, &over, sizeof over);
      if (over <= kOverCap || again == kMadeAgain) return made;
      if (comm.getRank() == 0) enlarge(std::pow(over, 1.0 / made.dimension));
    }
  }

  std::optional<std::vector<ChordSide>> chords(const Mesh& whole) const override { return sides_.of(whole); }

  std::string name() const override { return "size field"; }

 private:
  void enlarge(double factor) {
    SizeField larger = *sizes_;
    for (double& size : larger.sizes) size *= factor;
    sizes_ = std::make_shared<const SizeField>(std::move(larger));
  }

  static SizePlan cheapest(const MeshErrors& errors) {
    if (errors.polygon.sides.empty()) return planSizes(errors.whole, errors.squares, errors.facing, errors.wanted);
    std::optional<SizePlan> best;
    for (const double share : kShareOfCurves) {
      const WantedError rest{(1 - share) * errors.wanted.square, errors.wanted.mostElements};
      SizePlan plan = planSizes(errors.whole, errors.squares, errors.facing, rest,
                                sizesAlongCurves(errors.whole, errors.polygon.sides, errors.polygon.squares, share * errors.wanted.square));
      if (!best || plan.elements < best->elements) best = std::move(plan);
    }
    return *std::move(best);
  }

  Mesh mesh(const Comm& comm, MeshChanges changes) {
    changes.order = order_;
    changes.mayTangle = sides_.isUsed();
    const Parameters& list = scene_.settings().sublist("Mesh");
    Mesh made = readMesh(comm, list, scene_.file.folder, changes);
    int isSound = changes.simplices || isSimplicial(made);  // decided on rank 0
    broadcastBytes(comm, &isSound, sizeof isSound);
    if (isSound == 0) {
      changes.simplices = true;
      made = readMesh(comm, list, scene_.file.folder, changes);
    }
    sides_.straighten(comm, made);
    return made;
  }

  bool fits(const Comm& comm, const Mesh& mesh) const {
    Scene scene = scene_;
    scene.mesh = [&mesh](const Comm&) { return mesh; };
    try {
      const Mesh bodies = readBodies(comm, scene);
      readConstraints(comm, bodies, scene);
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  static bool isSimplicial(const Mesh& mesh) {
    return std::all_of(mesh.cells.begin(), mesh.cells.end(), [](Cell cell) { return cellInfo(cell).vertices == dimensionOf(cell) + 1; });
  }

  const Scene scene_;
  const int order_;
  PolygonSides sides_;
  std::shared_ptr<const SizeField> sizes_;
  double mostElements_ = 0.0;
};

}  // namespace

std::shared_ptr<MeshSequence> geometryMeshes(const Scene& scene, int order, PolygonSides sides) {
  return std::make_shared<GeometryMeshes>(scene, order, std::move(sides));
}

}  // namespace suture
