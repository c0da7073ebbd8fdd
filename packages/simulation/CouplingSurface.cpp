#include <suture/base/Gather.hpp>
#include <suture/elasticity/SideMap.hpp>
#include <suture/simulation/CouplingSurface.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace suture {

namespace {

struct NodeValue {
  GlobalId node;
  Point value;
};

std::map<GlobalId, Point> summedByNode(const Comm& comm, const std::map<GlobalId, Point>& mine) {
  std::vector<NodeValue> list;
  for (const auto& [node, value] : mine) list.push_back({node, value});
  std::map<GlobalId, Point> all;
  for (const NodeValue& one : joinEverywhere(comm, list)) {
    Point& sum = all.try_emplace(one.node, Point{0, 0, 0}).first->second;
    sum = plus(sum, one.value);
  }
  return all;
}

/// Integrals of the shape functions times a vector over a group, by node. On every rank.
/// \param vectorAt  the vector times the weight of a quadrature point. \param nodes  of the side
std::map<GlobalId, Point> integralsOver(
    const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group,
    const std::function<Point(const SideMap& map, const double* shapes, const std::vector<GlobalId>& nodes)>& vectorAt) {
  std::map<GlobalId, Point> mine;
  collectively(comm, "integrating over the group '" + group + "'", [&] {
    for (const SubdomainMesh& mesh : meshes)
      for (const Side& side : sidesOf(mesh.sideGroups, {group})) {
        std::vector<Point> points;
        std::vector<GlobalId> nodes;
        for (const int node : mesh.nodesOf(side)) {
          points.push_back(mesh.point(node));
          nodes.push_back(mesh.globalNodes[node]);
        }
        SideMap map(points, mesh.dimension, Rule::Load, mesh.axisymmetric);
        for (int q = 0; q < map.reference().points; ++q) {
          map.at(q);
          const double* shapes = map.reference().valuesAt(q);
          const Point vector = vectorAt(map, shapes, nodes);
          for (std::size_t a = 0; a < nodes.size(); ++a) {
            Point& sum = mine.try_emplace(nodes[a], Point{0, 0, 0}).first->second;
            sum = plus(sum, scaled(shapes[a], vector));
          }
        }
      }
  });
  return summedByNode(comm, mine);
}

std::vector<std::string> sideGroupNames(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  std::set<std::string> names;
  for (const SubdomainMesh& mesh : meshes)
    for (const auto& [name, sides] : mesh.sideGroups)
      if (!sides.empty()) names.insert(name);
  Packer packer;
  packer.put(std::vector<std::string>(names.begin(), names.end()));
  for (const std::string& name : joined<std::string>(allGather(comm, packer.bytes()))) names.insert(name);
  return {names.begin(), names.end()};
}

}  // namespace

CouplingSurface couplingSurface(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group) {
  const std::vector<std::string> known = sideGroupNames(comm, meshes);
  if (std::find(known.begin(), known.end(), group) == known.end()) throw InputError("coupling", unknownName("side group", group, known));
  const auto areas = integralsOver(comm, meshes, group, [](const SideMap& map, const double*, const std::vector<GlobalId>&) {
    return Point{map.measure(), 0, 0};
  });
  const auto normals =
      integralsOver(comm, meshes, group, [](const SideMap& map, const double*, const std::vector<GlobalId>&) { return map.normal(); });
  std::map<GlobalId, CouplingSurface::Place> mine;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int node = 0; node < meshes[i].nodes(); ++node) {
      const Span<const int> others = meshes[i].others(node);
      const bool isLowest = std::none_of(others.begin(), others.end(), [&](int other) { return other < meshes[i].id; });
      if (isLowest && areas.count(meshes[i].globalNodes[node])) mine[meshes[i].globalNodes[node]] = {static_cast<int>(i), node};
    }
  CouplingSurface surface;
  surface.group = group;
  for (const SubdomainMesh& mesh : meshes) surface.dimension = mesh.dimension;
  for (const auto& [node, place] : mine) {
    const Point here = meshes[place.mesh].point(place.node);
    surface.nodes.push_back(node);
    surface.places.push_back(place);
    surface.areas.push_back(areas.at(node)[0]);
    surface.coordinates.insert(surface.coordinates.end(), here.begin(), here.begin() + surface.dimension);
    surface.normals.insert(surface.normals.end(), normals.at(node).begin(), normals.at(node).begin() + surface.dimension);
  }
  return surface;
}

std::map<GlobalId, Point> valuesByNode(const Comm& comm, const CouplingSurface& surface, const std::vector<double>& values,
                                       const std::string& what) {
  const std::string path = "coupling '" + surface.group + "'";
  const std::size_t d = static_cast<std::size_t>(surface.dimension), wanted = d * surface.nodes.size();
  std::map<GlobalId, Point> mine;
  collectively(comm, "taking " + what, [&] {
    if (values.size() != wanted)
      throw InputError(path, std::to_string(values.size()) + " values for " + what + "; expected " + std::to_string(d) +
                                 " components for each of the " + std::to_string(surface.nodes.size()) + " nodes of a rank, " +
                                 std::to_string(wanted));
    for (std::size_t i = 0; i < surface.nodes.size(); ++i) {
      Point& value = mine[surface.nodes[i]] = {0, 0, 0};
      for (std::size_t k = 0; k < d; ++k)
        if (!std::isfinite(value[k] = values[d * i + k]))
          throw InputError(path, what + " at the node " + std::to_string(surface.nodes[i]) + ": " + std::to_string(value[k]) +
                                     "; expected finite numbers");
    }
  });
  return summedByNode(comm, mine);
}

std::map<GlobalId, Point> consistentForces(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group,
                                           const std::map<GlobalId, Point>& tractions) {
  return integralsOver(comm, meshes, group, [&](const SideMap& map, const double* shapes, const std::vector<GlobalId>& nodes) {
    Point here{0, 0, 0};
    for (std::size_t a = 0; a < nodes.size(); ++a) here = plus(here, scaled(shapes[a], tractions.at(nodes[a])));
    return scaled(map.measure(), here);
  });
}

}  // namespace suture
