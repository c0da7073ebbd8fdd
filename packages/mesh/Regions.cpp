#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Regions.hpp>

#include <Teuchos_ParameterList.hpp>
#include <map>

namespace suture {

std::vector<RegionEntry> regionEntries(const Parameters& bodies) {
  std::vector<RegionEntry> all;
  for (const std::string& body : sublistNames(bodies)) {
    const Parameters& own = bodies.sublist(body);
    if (!own.isSublist("Regions")) continue;
    const Parameters& regions = own.sublist("Regions");
    for (const std::string& name : sublistNames(regions)) all.push_back({body, &regions.sublist(name)});
  }
  return all;
}

void assignRegions(Mesh& mesh, const Parameters& bodies) {
  const std::vector<RegionEntry> entries = regionEntries(bodies);
  if (entries.empty()) return;
  Problems problems;
  const std::string kind = mesh.elementGroupKind();
  mesh.regions.assign(mesh.elements(), -1);
  for (int region = 0; region < static_cast<int>(entries.size()); ++region) {
    const std::string path = pathOf(*entries[region].list, "Group"), name = entries[region].list->get<std::string>("Group");
    const auto group = mesh.elementGroups.find(name);
    if (group == mesh.elementGroups.end()) {
      problems.add(path, "in the mesh " + mesh.source + ": " + unknownName(kind, name, mesh.elementGroupNames()));
      continue;
    }
    if (group->second.empty()) problems.add(path, "the " + kind + " '" + name + "' has no elements");
    std::map<std::string, std::vector<int>> strangers, twice;  // other body, other region -> elements
    for (const int e : group->second) {
      int& here = mesh.regions[e];
      if (mesh.bodies[mesh.bodyOfElement[e]] != entries[region].body) strangers[mesh.bodies[mesh.bodyOfElement[e]]].push_back(e);
      if (here >= 0 && here != region) twice[pathOf(*entries[here].list)].push_back(e);
      here = region;
    }
    const auto elements = [&](const std::vector<int>& which) {
      return countAt(which.size(), "element", placeText(centreOf(mesh, which[0]), mesh.dimension));
    };
    for (const auto& [body, which] : strangers)
      problems.add(path, "the " + kind + " '" + name + "' reaches outside the body '" + entries[region].body + "': " + elements(which) +
                             " in the body '" + body + "'; a region lies in one body");
    for (const auto& [other, which] : twice)
      problems.add(path, elements(which) + " of the " + kind + " '" + name + "' also in " + other + "; an element belongs to one region");
  }
  problems.throwIfAny();
}

}  // namespace suture
