#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/HilbertOrder.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/gmsh/GeoStatements.hpp>
#include <suture/mesh/gmsh/GeoText.hpp>
#include <suture/mesh/gmsh/GmshMesh.hpp>
#include <suture/mesh/gmsh/GmshReader.hpp>
#include <suture/mesh/gmsh/MesherProcess.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace suture {

namespace {

// The same cell seen from behind: the first node stays.
std::vector<std::size_t> turnedRound(Cell cell, const std::vector<std::size_t>& nodes) {
  static const int order[][9] = {{0, 2, 1}, {0, 2, 1, 5, 4, 3}, {0, 3, 2, 1}, {0, 3, 2, 1, 7, 6, 5, 4}, {0, 3, 2, 1, 7, 6, 5, 4, 8}};
  std::vector<std::size_t> turned;
  for (std::size_t i = 0; i < nodes.size(); ++i) turned.push_back(nodes[order[static_cast<int>(cell)][i]]);
  return turned;
}

/// The mesh in Gmsh's own numbers, element by element.
struct Raw {
  struct Element {
    Cell cell;
    std::vector<std::size_t> nodes;
  };
  explicit Raw(GmshMesh&& from) : gmsh(std::move(from)) {
    for (GmshMesh::Surface& surface : gmsh.surfaces) {
      const auto each = static_cast<std::ptrdiff_t>(cellInfo(surface.cell).nodes);
      std::vector<Element>& all = surfaces[surface.tag];
      for (auto first = surface.nodes.begin(); first != surface.nodes.end(); first += each)
        all.push_back({surface.cell, {first, first + each}});
      surface.nodes = {};
    }
  }
  Point point(std::size_t tag) const {
    const std::size_t at = std::lower_bound(gmsh.tags.begin(), gmsh.tags.end(), tag) - gmsh.tags.begin();
    return {gmsh.coordinates[3 * at], gmsh.coordinates[3 * at + 1], gmsh.coordinates[3 * at + 2]};
  }

  GmshMesh gmsh;
  std::map<int, std::vector<Element>> surfaces;  ///< by Gmsh's surface
};

// A surface meshed clockwise as a whole (its normal points down) is sound; single clockwise elements are not, and stay as they are.
void orient(Raw& raw) {
  const auto area = [&](const Raw::Element& element) {
    const Point o = raw.point(element.nodes[0]);
    double twice = 0;
    for (int i = 1; i + 1 < cellInfo(element.cell).vertices; ++i) {
      const Point a = raw.point(element.nodes[i]), b = raw.point(element.nodes[i + 1]);
      twice += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
    }
    return twice / 2;
  };
  for (auto& [tag, elements] : raw.surfaces)
    if (std::all_of(elements.begin(), elements.end(), [&](const Raw::Element& e) { return area(e) < 0; }))
      for (Raw::Element& element : elements) element.nodes = turnedRound(element.cell, element.nodes);
}

// Version 2 of .msh repeats an element for each of its physical groups: the same nodes are the same element.
class Numbering {
 public:
  Numbering(const Raw& raw, Mesh& mesh) : mesh_(mesh) {
    for (const auto& [tag, elements] : raw.surfaces)
      for (const Raw::Element& element : elements) used_.insert(used_.end(), element.nodes.begin(), element.nodes.end());
    std::sort(used_.begin(), used_.end());
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    for (const std::size_t tag : used_) {
      const Point p = raw.point(tag);
      mesh.coordinates.insert(mesh.coordinates.end(), {p[0], p[1]});
    }
    for (const auto& [tag, elements] : raw.surfaces)
      for (const Raw::Element& element : elements) elementsOf_[tag].push_back(add(element));
  }
  /// New number of a node, or -1 if no element has it.
  int node(std::size_t tag) const {
    const auto at = std::lower_bound(used_.begin(), used_.end(), tag);
    return at != used_.end() && *at == tag ? static_cast<int>(at - used_.begin()) : -1;
  }
  const std::vector<int>& elementsOf(int surface) const {
    static const std::vector<int> none;
    const auto found = elementsOf_.find(surface);
    return found == elementsOf_.end() ? none : found->second;
  }

 private:
  int add(const Raw::Element& element) {
    std::vector<int> nodes;
    for (const std::size_t tag : element.nodes) nodes.push_back(node(tag));
    std::vector<int> key = nodes;
    std::sort(key.begin(), key.end());
    const auto [at, isNew] = byNodes_.emplace(std::move(key), mesh_.elements());
    if (!isNew) return at->second;
    mesh_.cells.push_back(element.cell);
    mesh_.connectivity.insert(mesh_.connectivity.end(), nodes.begin(), nodes.end());
    mesh_.offsets.push_back(static_cast<int>(mesh_.connectivity.size()));
    return at->second;
  }

  Mesh& mesh_;
  std::vector<std::size_t> used_;
  std::map<std::vector<int>, int> byNodes_;
  std::map<int, std::vector<int>> elementsOf_;
};

template <typename T, typename Less, typename Equal>
void makeSet(std::vector<T>& values, Less less, Equal equal) {
  std::sort(values.begin(), values.end(), less);
  values.erase(std::unique(values.begin(), values.end(), equal), values.end());
}

void addSideGroups(const Raw& raw, const Numbering& numbering, Mesh& mesh, Problems& problems) {
  const SideTable table(mesh);
  for (const auto& [name, curves] : raw.gmsh.curveGroups) {
    std::vector<Side>& sides = mesh.sideGroups[name];
    std::vector<Point> outside, inside;  // middles of curve elements that are no side of the boundary
    for (const int curve : curves) {
      const auto found = raw.gmsh.curves.find(curve);
      if (found == raw.gmsh.curves.end()) continue;
      for (std::size_t i = 0; i < found->second.size(); i += 2) {
        const std::size_t a = found->second[i], b = found->second[i + 1];
        const int nodes[] = {numbering.node(a), numbering.node(b)};
        const bool known = nodes[0] >= 0 && nodes[1] >= 0;  // else no surface element has one of them
        const std::vector<Side> here = known ? table.between(nodes[0], nodes[1]) : std::vector<Side>();
        if (here.size() == 1) {
          sides.push_back(here[0]);
          continue;
        }
        const Point p = raw.point(a), q = raw.point(b);
        (here.empty() ? outside : inside).push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 0});
      }
    }
    makeSet(
        sides, [](const Side& x, const Side& y) { return std::make_pair(x.element, x.side) < std::make_pair(y.element, y.side); },
        [](const Side& x, const Side& y) { return x.element == y.element && x.side == y.side; });
    const auto report = [&, &group = name](const std::vector<Point>& middles, const std::string& what) {
      if (!middles.empty())
        problems.add(kMeshFile, mesh.source + ": curve group '" + group + "': " + std::to_string(middles.size()) + " of its elements " +
                                    what + " (the first at " + placeText(middles[0]) + ")");
    };
    report(outside, "are no side of any surface element");
    report(inside,
           "lie inside the material, between two elements; if two bodies meet there, each must be a shape of its own, never "
           "fragmented with the other");
  }
}

Mesh assemble(Raw& raw, const std::string& file, Problems& problems) {
  Mesh mesh;
  mesh.source = file;
  mesh.dimension = 2;
  orient(raw);
  const Numbering numbering(raw, mesh);

  double size = 0, away = 0;
  for (const auto& [tag, elements] : raw.surfaces)
    for (const Raw::Element& element : elements)
      for (const std::size_t node : element.nodes) {
        const Point p = raw.point(node);
        size = std::max({size, std::abs(p[0]), std::abs(p[1])});
        away = std::max(away, std::abs(p[2]));
      }
  if (away > 1e-9 * size)
    problems.add(kMeshFile, file + ": nodes up to " + std::to_string(away) + " away from the plane z = 0; expected a plane mesh");

  for (const auto& [name, surfaces] : raw.gmsh.surfaceGroups) {
    std::vector<int>& elements = mesh.elementGroups[name];
    for (const int surface : surfaces) {
      const std::vector<int>& more = numbering.elementsOf(surface);
      elements.insert(elements.end(), more.begin(), more.end());
    }
    makeSet(elements, std::less<int>(), std::equal_to<int>());
  }
  addSideGroups(raw, numbering, mesh, problems);
  return mesh;
}

void checkConstants(const GmshInput& input, Problems& problems) {
  if (input.constants.empty()) return;
  const std::vector<std::string> known = geoConstants(input.path);
  for (const auto& entry : input.constants)
    if (!std::binary_search(known.begin(), known.end(), entry.first))
      problems.add("Mesh/Constants/" + entry.first, "in " + input.path + ": " + unknownName("DefineConstant", entry.first, known));
}

Raw readRaw(const GmshInput& input, bool isGeometry, Problems& problems) {
  MesherOrder order{input.path, input.path, isGeometry, input.meshSizeFactor, input.seconds, input.allowPrograms};
  std::optional<GeoWrapper> wrapper;
  if (isGeometry) {
    wrapper.emplace(input.path, input.constants);
    order.opened = wrapper->path();
  }
  Raw raw(runMesher(order));
  for (const std::string& problem : raw.gmsh.problems) problems.add(kMeshFile, input.path + ": " + problem);
  return raw;
}

}  // namespace

Mesh readGmsh(const GmshInput& input) {
  const bool isGeometry = std::filesystem::path(input.path).extension() == ".geo";
  Problems problems;
  if (isGeometry && !input.allowPrograms) checkGeoStatements(input.path, problems);
  if (!isGeometry && !beginsAsMsh(input.path))
    problems.add(kMeshFile, input.path + ": is no mesh of Gmsh; expected $MeshFormat in its first line");
  problems.throwIfAny();  // the names of constants are looked up in a sound file only
  if (isGeometry) checkConstants(input, problems);
  problems.throwIfAny();
  Raw raw = readRaw(input, isGeometry, problems);
  problems.throwIfAny();
  Mesh mesh = assemble(raw, input.path, problems);
  problems.throwIfAny();
  // Numbers of a .msh file are the user's; those of a mesh that is made here may still change.
  if (isGeometry) numberAlongHilbertCurve(mesh);
  return mesh;
}

}  // namespace suture
