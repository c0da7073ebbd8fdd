#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/GeoText.hpp>
#include <suture/mesh/GmshReader.hpp>
#include <suture/mesh/HilbertOrder.hpp>
#include <suture/mesh/SideTable.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

namespace suture {

namespace {

const char* const path = "Mesh/File";

/// Gmsh's global state, silent, without the user's own configuration files.
class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);  // the same mesh every time
    // By default an error leaves Gmsh's parser in the middle of the file, and the next file is read from there. Let it go to the end.
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::logger::start();
  }
  ~Session() {
    gmsh::logger::stop();
    gmsh::finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The first error that Gmsh has logged, or "".
  static std::string error() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    const std::string mark = "Error: ";
    for (const std::string& line : log)
      if (line.compare(0, mark.size(), mark) == 0) return line.substr(mark.size());
    return "";
  }
};

std::optional<Cell> cellOfGmshType(int type) {
  switch (type) {
    case 2:
      return Cell::Triangle3;
    case 9:
      return Cell::Triangle6;
    case 3:
      return Cell::Quadrilateral4;
    case 16:
      return Cell::Quadrilateral8;
    case 10:
      return Cell::Quadrilateral9;
    default:
      return std::nullopt;
  }
}

std::string gmshTypeName(int type) {
  std::string name;
  int dimension, order, nodes, primary;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, coordinates, primary);
  return name;
}

// The same cell seen from behind: the first node stays.
std::vector<std::size_t> turnedRound(Cell cell, const std::vector<std::size_t>& nodes) {
  static const int order[][9] = {{0, 2, 1}, {0, 2, 1, 5, 4, 3}, {0, 3, 2, 1}, {0, 3, 2, 1, 7, 6, 5, 4}, {0, 3, 2, 1, 7, 6, 5, 4, 8}};
  std::vector<std::size_t> turned;
  for (std::size_t i = 0; i < nodes.size(); ++i) turned.push_back(nodes[order[static_cast<int>(cell)][i]]);
  return turned;
}

/// The mesh in Gmsh's own numbers.
struct Raw {
  std::vector<std::size_t> tags;    ///< of nodes, ascending
  std::vector<double> coordinates;  ///< x, y, z of each
  struct Element {
    Cell cell;
    std::vector<std::size_t> nodes;
  };
  std::map<int, std::vector<Element>> surfaces;                            ///< by Gmsh's surface
  std::map<int, std::vector<std::pair<std::size_t, std::size_t>>> curves;  ///< end points of curve elements, by Gmsh's curve
  std::map<std::string, std::vector<int>> surfaceGroups, curveGroups;      ///< name -> Gmsh's surfaces or curves
  Point point(std::size_t tag) const {
    const std::size_t at = std::lower_bound(tags.begin(), tags.end(), tag) - tags.begin();
    return {coordinates[3 * at], coordinates[3 * at + 1], coordinates[3 * at + 2]};
  }
};

void readNodes(Raw& raw) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::vector<std::size_t> order(tags.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  for (const std::size_t i : order) {
    raw.tags.push_back(tags[i]);
    raw.coordinates.insert(raw.coordinates.end(), {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
  }
}

void readElements(Raw& raw, const std::string& file, Problems& problems) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  std::map<std::string, std::size_t> foreign;  // kind of cell -> how many
  for (const auto& [dimension, tag] : entities) {
    if (dimension == 0) continue;
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t count = elements[t].size();
      if (count == 0) continue;
      const std::size_t each = nodes[t].size() / count;
      const auto cell = cellOfGmshType(types[t]);
      if (dimension == 3 || (dimension == 2 && !cell)) {
        foreign[gmshTypeName(types[t])] += count;
        continue;
      }
      for (std::size_t e = 0; e < count; ++e) {
        const auto first = nodes[t].begin() + e * each;
        if (dimension == 1)
          raw.curves[tag].emplace_back(first[0], first[1]);  // a line's end points are its first two nodes, whatever its order
        else
          raw.surfaces[tag].push_back({*cell, {first, first + each}});
      }
    }
  }
  for (const auto& [name, count] : foreign)
    problems.add(path, file + ": " + std::to_string(count) + " elements of the kind '" + name +
                           "'; known are triangles of 3 or 6 nodes and quadrilaterals of 4, 8 or 9 nodes");
  if (raw.surfaces.empty() && foreign.empty())
    problems.add(path, file + ": holds no surface elements" +
                           (entities.empty() ? ": the geometry is empty" : "; is there a Surface, and does a .msh file hold its mesh?"));
}

void readGroups(Raw& raw) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    if (dimension != 1 && dimension != 2) continue;
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.empty()) continue;
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    std::vector<int>& all = (dimension == 2 ? raw.surfaceGroups : raw.curveGroups)[name];
    for (const int entity : entities) all.push_back(std::abs(entity));  // a curve may be named against its direction
  }
}

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
  for (const auto& [name, curves] : raw.curveGroups) {
    std::vector<Side>& sides = mesh.sideGroups[name];
    std::vector<Point> outside, inside;  // middles of curve elements that are no side of the boundary
    for (const int curve : curves) {
      const auto found = raw.curves.find(curve);
      if (found == raw.curves.end()) continue;
      for (const auto& [a, b] : found->second) {
        const std::vector<Side> here = table.between(numbering.node(a), numbering.node(b));
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
    const auto report = [&](const std::vector<Point>& middles, const std::string& what) {
      if (!middles.empty())
        problems.add(path, mesh.source + ": curve group '" + name + "': " + std::to_string(middles.size()) + " of its elements " + what +
                               " (the first at " + placeText(middles[0]) + ")");
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
    problems.add(path, file + ": nodes up to " + std::to_string(away) + " away from the plane z = 0; expected a plane mesh");

  for (const auto& [name, surfaces] : raw.surfaceGroups) {
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

// Gmsh names the temporary wrapper where the user knows his own file.
std::string withOwnName(std::string message, const std::string& wrapper, const std::string& file) {
  for (std::size_t at = message.find(wrapper); at != std::string::npos; at = message.find(wrapper, at + file.size()))
    message.replace(at, wrapper.size(), file);
  return message;
}

// Runs a step of Gmsh's. libgmsh 4.8 throws texts, later ones exceptions; errors in a file may be in the log only, and the first one
// there says most.
template <typename Step>
void withGmsh(const std::string& file, const std::string& opened, Step step) {
  std::string thrown;
  try {
    step();
  } catch (const std::string& error) {
    thrown = error;
  } catch (const std::runtime_error& error) {
    thrown = error.what();
  }
  const std::string logged = Session::error();
  if (thrown.empty() && logged.empty()) return;
  throw InputError(path, file + ": Gmsh says: " + withOwnName(logged.empty() ? thrown : logged, opened, file));
}

void openAndMesh(const GmshInput& input) {
  const GeoWrapper wrapper(input.path, input.constants);
  withGmsh(input.path, wrapper.path(), [&] { gmsh::open(wrapper.path()); });
  withGmsh(input.path, wrapper.path(), [&] {
    double factor = 1;
    gmsh::option::getNumber("Mesh.MeshSizeFactor", factor);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", factor * input.meshSizeFactor);
    gmsh::model::mesh::generate(2);
  });
}

Raw readRaw(const GmshInput& input, bool isGeometry, Problems& problems) {
  const Session session;
  Raw raw;
  if (isGeometry)
    openAndMesh(input);
  else
    withGmsh(input.path, input.path, [&] { gmsh::open(input.path); });
  withGmsh(input.path, input.path, [&] {
    readNodes(raw);
    readElements(raw, input.path, problems);
    readGroups(raw);
  });
  return raw;
}

}  // namespace

Mesh readGmsh(const GmshInput& input) {
  const bool isGeometry = std::filesystem::path(input.path).extension() == ".geo";
  Problems problems;
  if (isGeometry) checkConstants(input, problems);
  problems.throwIfAny();
  Raw raw = readRaw(input, isGeometry, problems);
  problems.throwIfAny();
  Mesh mesh = assemble(raw, input.path, problems);
  problems.throwIfAny();
  // Numbers of a .msh file are the user's; those of a mesh that is made here are nobody's yet.
  if (isGeometry) numberAlongHilbertCurve(mesh);
  return mesh;
}

}  // namespace suture
