#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Version.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Provenance.hpp>

namespace suture {
namespace {

GlobalId seedOf(const Parameters& scene) {
  if (!scene.isSublist("Partition") || !scene.sublist("Partition").isSublist("METIS")) return 0;
  const Parameters& metis = scene.sublist("Partition").sublist("METIS");
  return metis.isType<int>("Seed") ? metis.get<int>("Seed") : 0;
}

// A name as one component of an HDF5 path.
std::string step(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

std::vector<double> endPoints(const std::vector<SubdomainMesh>& subdomains, const std::string& group) {
  std::vector<double> rows;
  for (const SubdomainMesh& mesh : subdomains) {
    const auto found = mesh.sideGroups.find(group);
    if (found == mesh.sideGroups.end()) continue;
    for (const Side& side : found->second) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      for (int end = 0; end < 2; ++end) {
        const Point x = mesh.drawnPoint(nodes[std::size_t(end)]);
        rows.insert(rows.end(), x.begin(), x.end());
      }
    }
  }
  return rows;
}

}  // namespace

void writeProvenance(const Run& run, Hdf5Writer& file) {
  const nlohmann::json libraries = libraryVersions();
  file.group("/Record");
  file.attribute("/Record", "ranks", std::vector<GlobalId>{run.comm.getSize()});
  file.attribute("/Record", "seed", std::vector<GlobalId>{seedOf(*run.scene.parameters)});
  file.write("/Record/Input", run.scene.text);
  file.write("/Record/InputPath", run.scene.path);
  file.write("/Record/Resolved", toXml(*run.scene.parameters));
  file.write("/Record/MeshHash", broadcast(run.comm, run.meshHash));
  file.write("/Record/Version", version());
  file.write("/Record/Commit", commit());
  file.write("/Record/Libraries", libraries.dump());
  file.write("/Record/CommandLine", shellCommand(run.invocation.commandLine));
}

std::vector<std::string> materialNames(const ElasticModel& model) {
  std::vector<std::string> names;
  for (const auto* materials : {&model.materialOfBody, &model.materialOfRegion})
    for (const Material& material : *materials)
      if (std::find(names.begin(), names.end(), material.name) == names.end()) names.push_back(material.name);
  return names;
}

void writeNames(const Run& run, VtkHdf& vtk) {
  Hdf5Writer& file = vtk.file();
  // Each rank only knows its own subdomains, and therefore only some of the side groups.
  Packer mine;
  std::map<int, std::string> ownNames;
  std::vector<std::string> ownGroups;
  for (const SubdomainMesh& mesh : run.subdomains) {
    ownNames[mesh.id] = mesh.name;
    for (const auto& group : mesh.sideGroups) ownGroups.push_back(group.first);
  }
  mine.put(ownNames);
  mine.put(ownGroups);
  std::map<int, std::string> names;
  std::set<std::string> groups;
  for (const std::string& bytes : allGather(run.comm, mine.bytes())) {
    Unpacker theirs(bytes);
    std::map<int, std::string> theirNames;
    std::vector<std::string> theirGroups;
    theirs.get(theirNames);
    theirs.get(theirGroups);
    names.insert(theirNames.begin(), theirNames.end());
    groups.insert(theirGroups.begin(), theirGroups.end());
  }

  nlohmann::json subdomains = nlohmann::json::array();
  for (const auto& [id, name] : names) subdomains.push_back(name);
  file.write("/Record/Subdomains", subdomains.dump());
  file.write("/Record/Bodies", nlohmann::json(run.model.bodies).dump());
  file.group("/Record/SideGroups");
  vtk.names("BodyNames", run.model.bodies);
  vtk.names("MaterialNames", materialNames(run.model));
  vtk.names("SubdomainNames", subdomains.get<std::vector<std::string>>());
  vtk.names("GroupNames", {groups.begin(), groups.end()});
  for (const std::string& group : groups) file.write("/Record/SideGroups/" + step(group), endPoints(run.subdomains, group), 6);
}

}  // namespace suture
