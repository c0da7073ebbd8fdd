#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/reader/MeshArrays.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace suture {

namespace {

/// Checks arrays one after the other and collects all errors.
class ArrayChecker {
 public:
  ArrayChecker(MeshArrays arrays, std::string path, const std::string& source) : arrays_(std::move(arrays)), path_(std::move(path)) {
    mesh_.source = source;
  }

  Mesh mesh() {
    takeBlock();
    problems_.throwIfAny();  // groups refer to elements: check groups only if the elements are sound
    takeElementGroups();
    takeSideGroups();
    problems_.throwIfAny();
    return std::move(mesh_);
  }

 private:
  void wrong(const std::string& place, const std::string& what) { problems_.add(path_, mesh_.source + ": " + place + ": " + what); }

  void takeBlock() {
    if (arrays_.dimension.size() != 1 || (arrays_.dimension[0] != 2 && arrays_.dimension[0] != 3)) {
      wrong("/Dimension", "expected 2 or 3");
      return;
    }
    mesh_.dimension = arrays_.dimension[0];
    mesh_.coordinates = std::move(arrays_.coordinates);
    mesh_.offsets = std::move(arrays_.offsets);
    mesh_.connectivity = std::move(arrays_.connectivity);
    checkCoordinates();
    if (takeCells()) checkNumbers("/Connectivity", mesh_.connectivity, 1, 0, mesh_.nodes(), "node");
  }

  void checkCoordinates() {
    const auto width = static_cast<std::size_t>(mesh_.dimension);
    if (mesh_.coordinates.size() % width != 0)
      wrong("/Coordinates", std::to_string(mesh_.coordinates.size()) + " values; expected " + std::to_string(width) + " per node");
    for (std::size_t i = 0; i < mesh_.coordinates.size(); ++i) {
      if (std::isfinite(mesh_.coordinates[i])) continue;
      wrong("/Coordinates", "the coordinates of node " + std::to_string(i / width) + " are not finite");
      break;
    }
  }

  bool takeCells() {
    const std::vector<int>& cells = arrays_.cells;
    if (cells.empty()) wrong("/Cells", "no elements");
    if (mesh_.offsets.size() != cells.size() + 1 || mesh_.offsets[0] != 0 ||
        mesh_.offsets.back() != static_cast<int>(mesh_.connectivity.size())) {
      wrong("/Offsets", std::to_string(mesh_.offsets.size()) + " values for " + std::to_string(cells.size()) + " elements with " +
                            std::to_string(mesh_.connectivity.size()) + " nodes in /Connectivity; expected " +
                            std::to_string(cells.size() + 1) + " values from 0 to " + std::to_string(mesh_.connectivity.size()));
      return false;
    }
    mesh_.cells.reserve(cells.size());
    for (std::size_t e = 0; e < cells.size(); ++e) {
      if (cells[e] < 0 || cells[e] >= kCells) {
        wrong("/Cells", "element " + std::to_string(e) + " has the unknown shape " + std::to_string(cells[e]) + "; expected 0 to " +
                            std::to_string(kCells - 1));
        return false;
      }
      const Cell cell = static_cast<Cell>(cells[e]);
      if (dimensionOf(cell) != mesh_.dimension) {
        wrong("/Cells", "element " + std::to_string(e) + " is a " + cellInfo(cell).name + "; expected a shape of dimension " +
                            std::to_string(mesh_.dimension) + ", as in /Dimension");
        return false;
      }
      const int nodes = mesh_.offsets[e + 1] - mesh_.offsets[e];
      if (nodes != cellInfo(cell).nodes) {
        wrong("/Offsets", "element " + std::to_string(e) + " (" + cellInfo(cell).name + ") has " + std::to_string(nodes) + " nodes");
        return false;
      }
      mesh_.cells.push_back(cell);
    }
    return true;
  }

  // Checks that the entries at `offset`, `offset + stride`, ... lie in 0 .. limit - 1.
  bool checkNumbers(const std::string& place, const std::vector<int>& values, std::size_t stride, std::size_t offset, int limit,
                    const std::string& what) {
    for (std::size_t i = offset; i < values.size(); i += stride) {
      if (values[i] >= 0 && values[i] < limit) continue;
      wrong(place, what + " " + std::to_string(values[i]) + "; there are " + std::to_string(limit) + ", counted from 0");
      return false;
    }
    return true;
  }

  void takeElementGroups() {
    for (MeshArrays::Group& group : arrays_.elementGroups) {
      checkNumbers(group.place, group.numbers, 1, 0, mesh_.elements(), "element");
      if (!mesh_.elementGroups.emplace(group.name, std::move(group.numbers)).second)
        wrong(group.place, "a second group named '" + group.name + "'");
    }
  }

  std::vector<Side> sidesOf(const MeshArrays::Group& group) {
    std::vector<Side> sides;
    if (group.numbers.size() % 2 != 0) wrong(group.place, "an odd number of values for (element, side)");
    if (group.numbers.size() % 2 != 0 || !checkNumbers(group.place, group.numbers, 2, 0, mesh_.elements(), "element")) return sides;
    for (std::size_t i = 0; i < group.numbers.size(); i += 2) {
      const Side side{group.numbers[i], group.numbers[i + 1]};
      const int count = static_cast<int>(cellInfo(mesh_.cells[side.element]).sideNodes.size());
      if (side.side < 0 || side.side >= count) {
        wrong(group.place,
              "side " + std::to_string(side.side) + " of element " + std::to_string(side.element) + ", which has " + std::to_string(count));
        return {};
      }
      sides.push_back(side);
    }
    return sides;
  }

  void takeSideGroups() {
    std::map<std::string, std::string> placeOf;  // by the group's name
    std::vector<Side> all;
    for (const MeshArrays::Group& group : arrays_.sideGroups) {
      std::vector<Side> sides = sidesOf(group);
      all.insert(all.end(), sides.begin(), sides.end());
      if (mesh_.sideGroups.emplace(group.name, std::move(sides)).second)
        placeOf[group.name] = group.place;
      else
        wrong(group.place, "a second group named '" + group.name + "'");
    }
    const SideTable table(mesh_, all);
    for (const auto& [name, sides] : mesh_.sideGroups) {
      const auto inside = std::find_if(sides.begin(), sides.end(), [&](const Side& side) { return !table.onBoundary(side); });
      if (inside != sides.end())
        wrong(placeOf.at(name), "group '" + name + "': side " + std::to_string(inside->side) + " of element " +
                                    std::to_string(inside->element) + " at " +
                                    placeText(centreOf(mesh_, inside->element), mesh_.dimension) + " lies inside the material");
    }
  }

  MeshArrays arrays_;
  const std::string path_;
  Mesh mesh_;
  Problems problems_;
};

}  // namespace

Mesh meshFromArrays(MeshArrays arrays, const std::string& path, const std::string& source) {
  return ArrayChecker(std::move(arrays), path, source).mesh();
}

}  // namespace suture
