#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <set>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/cut/Cut.hpp>
#include <suture/partition/cut/ElementGraph.hpp>
#include <suture/partition/cut/Glob.hpp>
#include <suture/partition/cut/Hinges.hpp>

namespace suture {

Schema namedGroupsSchema() {
  return Schema("Every surface group of the mesh (in 3D volume group) whose name matches the pattern is a subdomain.")
      .text("Pattern", "subdomain_*", "Name pattern in which * matches any characters and ? exactly one.");
}

namespace {

std::string elementsAt(const Mesh& mesh, std::size_t count, int first) {
  return std::to_string(count) + (count == 1 ? " element (at " : " elements (the first at ") +
         placeText(centreOf(mesh, first), mesh.dimension) + ")";
}

// Called only if the groups have no other errors, which would show up again as missing connections.
void checkConnected(const Mesh& mesh, const Cut& cut, const std::string& path, Problems& problems) {
  const ElementGraph graph = elementGraph(mesh);
  findHinges(mesh, mesh.bodyOfElement, mesh.bodies, components(graph, mesh.bodyOfElement), problems);
  const Components pieces = components(graph, cut.subdomainOfElement);
  std::vector<std::vector<int>> of(cut.names.size());
  for (int c = 0; c < pieces.count(); ++c) of[cut.subdomainOfElement[pieces.elements[c].front()]].push_back(c);
  for (std::size_t s = 0; s < of.size(); ++s) {
    if (of[s].size() < 2) continue;
    std::string places;
    for (std::size_t i = 0; i < std::min<std::size_t>(of[s].size(), 3); ++i)
      places += (i ? ", " : "") + placeText(centreOf(mesh, pieces.elements[of[s][i]].front()), mesh.dimension);
    problems.add(path, "the " + mesh.elementGroupKind() + " '" + cut.names[s] + "' consists of " + std::to_string(of[s].size()) +
                           " parts without a common side (at " + places + "); a subdomain must be connected");
  }
}

}  // namespace

Cut cutByNamedGroups(const Mesh& mesh, const Parameters& own) {
  const std::string pattern = own.get<std::string>("Pattern"), path = pathOf(own, "Pattern");
  Problems problems;
  Cut cut;
  cut.subdomainOfElement.assign(mesh.elements(), -1);
  std::map<std::pair<int, int>, std::vector<int>> twice;  // two subdomains -> elements in both
  for (const auto& [name, elements] : mesh.elementGroups) {
    if (!matchesPattern(name, pattern)) continue;
    if (elements.empty()) {
      problems.add(path, "the " + mesh.elementGroupKind() + " '" + name + "' has no elements");
      continue;
    }
    const int subdomain = static_cast<int>(cut.names.size());
    std::set<int> bodies;
    for (int e : elements) {
      int& owner = cut.subdomainOfElement[e];
      if (owner >= 0 && owner != subdomain) twice[{owner, subdomain}].push_back(e);
      owner = subdomain;
      bodies.insert(mesh.bodyOfElement[e]);
    }
    cut.names.push_back(name);
    cut.bodyOf.push_back(*bodies.begin());
    if (bodies.size() > 1) {
      std::vector<std::string> names;
      for (int body : bodies) names.push_back(mesh.bodies[body]);
      problems.add(path, "the " + mesh.elementGroupKind() + " '" + name + "' lies in " + std::to_string(bodies.size()) + " bodies (" +
                             joinNames(names) + "); a subdomain lies in one");
    }
  }
  if (cut.names.empty()) {
    problems.add(path, "no " + mesh.elementGroupKind() + " of the mesh " + mesh.source + " matches '" + pattern + "'." +
                           suggestion(pattern, mesh.elementGroupNames()));
    problems.throwIfAny();
  }
  for (const auto& [pair, elements] : twice)
    problems.add(path, elementsAt(mesh, elements.size(), elements.front()) + " in both '" + cut.names[pair.first] + "' and '" +
                           cut.names[pair.second] + "'; an element belongs to one subdomain");
  std::vector<int> homeless;
  for (int e = 0; e < mesh.elements(); ++e)
    if (cut.subdomainOfElement[e] < 0) homeless.push_back(e);
  if (!homeless.empty())
    problems.add(path, elementsAt(mesh, homeless.size(), homeless.front()) + " in no " + mesh.elementGroupKind() + " that matches '" +
                           pattern + "'; every element belongs to a subdomain. They match: " + joinNames(cut.names));
  if (problems.empty()) checkConnected(mesh, cut, path, problems);
  problems.throwIfAny();
  return cut;
}

}  // namespace suture
