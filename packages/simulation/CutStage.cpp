#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Timers.hpp>
#include <suture/interface/Formulation.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/simulation/CutStage.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

bool mayBeMortar(const Parameters& contact) {
  const std::vector<std::string> lines = sublistNames(contact);
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    const Parameters& own = contact.sublist(line);
    return own.isParameter("Side B") && own.get<std::string>("Coupling") != "Matching Nodes";
  });
}

MadeFor madeFor(const Parameters& scene) {
  MadeFor lists;
  for (const char* name : {"Bodies", "Boundary Conditions", "Constants", "Contact", "Functions"}) lists[name] = toXml(scene.sublist(name));
  if (scene.sublist("Load Steps").sublist("Factors").numParams() > 0) lists["Load Steps"] = toXml(scene.sublist("Load Steps"));
  lists["Model"] = scene.get<std::string>("Model");
  // The gap between curved sides depends on which body is more compliant.
  if (mayBeMortar(scene.sublist("Contact"))) lists["Materials"] = toXml(scene.sublist("Materials"));
  return lists;
}

}  // namespace

bool isCut(const Scene& scene) { return scene.settings().sublist("Partition").get<std::string>("Type") == kPartitionedMesh; }

Whole wholeOf(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  return {problemSize(comm, mesh, constraints, partition),
          constraints.pieces,
          onRoot(comm, "hashing the mesh", [&] { return mesh.hash(); }),
          constraints.conditions,
          onRoot(comm, "finding what load steps change", [&] { return prescribedParts(mesh, constraints); }),
          constraints.parts};
}

namespace {

std::string bytesOf(const Whole& whole) {
  Packer packer;
  packer.put(whole.size);
  packer.put(whole.hash);
  packer.put(whole.pieces);
  packer.put(whole.conditions);
  packer.put(whole.prescribed);
  return std::move(packer).bytes();
}

Whole wholeFrom(const std::string& bytes) {
  Unpacker unpacker(bytes);
  Whole whole;
  unpacker.get(whole.size);
  unpacker.get(whole.hash);
  unpacker.get(whole.pieces);
  unpacker.get(whole.conditions);
  unpacker.get(whole.prescribed);
  return whole;
}

}  // namespace

CutMesh cutMesh(const Comm& comm, const Scene& scene, const Mesh& mesh, const Constraints& constraints) {
  const Parameters& settings = scene.settings();
  const bool keepsGroupsWhole = formulationOf(settings)->keepsGroupsWhole();
  CutMesh cut;
  if (!isCut(scene)) {
    cut.partition = makePartition(comm, mesh, constraints, settings.sublist("Partition"), keepsGroupsWhole);
    cut.meshes = distribute(comm, mesh, constraints, cut.partition);
    cut.partition.share.reset();  // not needed any more
    cut.whole = wholeOf(comm, mesh, constraints, cut.partition);
    return cut;
  }
  const std::string path = meshFile(settings.sublist("Mesh"), scene.file.folder);
  if (path.empty())
    throw InputError(pathOf(settings.sublist("Partition"), "Type"),
                     std::string(kPartitionedMesh) + " needs a Mesh/File written by suture_partition; this scene generates its mesh");
  PartitionedMesh read = readPartitionedMesh(comm, path, madeFor(settings), keepsGroupsWhole);
  cut.partition = std::move(read.partition);
  cut.meshes = std::move(read.mine);
  cut.whole = wholeFrom(read.remarks);
  return cut;
}

void addCut(Hdf5Writer& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const Whole& whole,
            const Scene& scene) {
  addPartition(file, mesh, constraints, partition, madeFor(scene.settings()), bytesOf(whole));
}

void forget(Mesh& mesh, Constraints& constraints, Partition& partition) {
  mesh = Mesh();
  constraints = Constraints();
  partition.subdomainOfElement = std::vector<int>();
  giveBackFreedMemory();
}

}  // namespace suture
