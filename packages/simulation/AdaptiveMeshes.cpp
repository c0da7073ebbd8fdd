#include <suture/base/Collective.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/reader/gmsh/StraightSides.hpp>
#include <suture/simulation/AdaptiveMeshes.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/ReadStage.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Sizes of the elements of the first mesh over those of the scene's own, in the order in which they are tried.
constexpr double kCoarser[] = {4.0, 2.0, 1.0};

/// The geometry of a scene as input of Gmsh.
struct Geometry {
  Teuchos::RCP<const Parameters> settings;
  std::string folder;
  int order = 2;
  std::vector<std::string> contactSides;  ///< groups whose sides stay curved: their gaps follow the geometry

  Mesh mesh(const Comm& comm, MeshChanges changes) const {
    changes.order = order;
    Mesh made = readMesh(comm, settings->sublist("Mesh"), folder, changes);
    int isSound = changes.simplices || isSimplicial(made);  // decided on rank 0
    broadcastBytes(comm, &isSound, sizeof isSound);
    if (isSound == 0) {
      changes.simplices = true;
      made = readMesh(comm, settings->sublist("Mesh"), folder, changes);
    }
    collectivelyOnRoot(comm, "straightening sides", [&] { straightenSides(made, contactSides); });
    return made;
  }

  /// The coarsest mesh that fits the scene: on a coarse one bodies may overlap, or contact sides have no pairs.
  Mesh start(const Comm& comm, Scene scene) const {
    MeshChanges changes;
    for (const double factor : kCoarser) {
      changes.factor = factor;
      Mesh made = mesh(comm, changes);
      if (factor == kCoarser[2] || fits(comm, made, scene)) return made;
    }
    return {};
  }

  static bool fits(const Comm& comm, const Mesh& mesh, Scene& scene) {
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
};

std::vector<std::string> contactSides(const Parameters& contacts) {
  std::vector<std::string> all;
  for (const std::string& name : sublistNames(contacts))
    for (const char* side : {"Side A", "Side B"})
      for (const std::string& group : groupNames(contacts.sublist(name), side)) all.push_back(group);
  return all;
}

int orderOf(const Scene& scene) {
  if (scene.accuracy->order > 0) return scene.accuracy->order;
  const Parameters& mesh = scene.settings().sublist("Mesh");
  return mesh.isParameter("Order") ? mesh.get<int>("Order") : 2;
}

void refuseOthers(const Scene& scene) {
  Problems problems;
  const auto refuse = [&](bool found, const std::string& why) {
    if (found) problems.add("Accuracy/Error", why);
  };
  refuse(!scene.steps.empty(),
         "needs a scene without Load Steps: the state of a path does not go to another mesh. Remove Error, and refine the mesh by hand");
  refuse(isCut(scene), "needs the whole mesh, found Partition/Type = Partitioned Mesh; use the mesh without a partition, and METIS");
  refuse(std::any_of(scene.kinds.begin(), scene.kinds.end(), [](const SubdomainKind& kind) { return kind.name != "Elastic"; }),
         "needs elastic bodies: the error of a body with its own physics (Bodies/<body>/Subdomain) is not known");
  refuse(!scene.levels.empty(), "replaces Outer Solver/Start = Nested: each mesh starts from the previous one; remove Start");
  problems.throwIfAny();
}

}  // namespace

void prepareAccuracy(Scene& scene) {
  scene.accuracy = AccuracyRequest::of(scene.settings());
  if (!scene.accuracy) return;
  refuseOthers(scene);
  const Parameters& mesh = scene.settings().sublist("Mesh");
  if (!isGeometry(mesh, scene.file.folder))
    throw InputError("Accuracy/Error", "needs a geometry in Mesh/File (.geo, .step, .brep, ...), whose meshes Gmsh makes");
  const Geometry geometry{scene.file.parameters, scene.file.folder, orderOf(scene), contactSides(scene.settings().sublist("Contact"))};
  scene.mesh = [geometry, plain = scene](const Comm& comm) { return geometry.start(comm, plain); };
  scene.remesh = [geometry](const Comm& comm, std::shared_ptr<const SizeField> sizes) {
    MeshChanges changes;
    changes.sizes = std::move(sizes);
    changes.simplices = true;
    return geometry.mesh(comm, changes);
  };
}

}  // namespace suture
