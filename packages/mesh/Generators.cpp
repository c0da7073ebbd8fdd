#include <suture/base/Errors.hpp>
#include <suture/base/Memory.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/mesh/Generators.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace suture {

namespace {

/// The nodes of one box: a lattice with `order` intervals a cell, numbered row by row. The middles of 8-node quadrilaterals are left out.
class Lattice {
 public:
  Lattice(const Box& box, Mesh& mesh) : order_(isQuadratic(box.cell) ? 2 : 1), columns_(order_ * box.nx + 1) {
    const int rows = order_ * box.ny + 1;
    int next = mesh.nodes();
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns_; ++i) {
        const bool middle = order_ == 2 && i % 2 == 1 && j % 2 == 1;
        const bool wanted = !(middle && box.cell == Cell::Quadrilateral8);
        number_.push_back(wanted ? next++ : -1);
        if (!wanted) continue;
        mesh.coordinates.push_back(between(box.x0, box.x1, i, columns_ - 1));
        mesh.coordinates.push_back(between(box.y0, box.y1, j, rows - 1));
      }
  }
  int order() const { return order_; }
  /// In steps of the lattice.
  int node(int i, int j) const { return number_[std::size_t(j) * columns_ + i]; }

  static bool isQuadratic(Cell cell) { return cell == Cell::Triangle6 || cell == Cell::Quadrilateral8 || cell == Cell::Quadrilateral9; }

 private:
  // Both ends exactly, so that boxes of equal ends have coinciding nodes there.
  static double between(double low, double high, int i, int n) { return i == n ? high : low + (high - low) * (static_cast<double>(i) / n); }

  int order_, columns_;
  std::vector<int> number_;
};

void check(const std::vector<Box>& all) {
  Problems problems;
  std::set<std::string> names;
  for (const Box& box : all) {
    const std::string path = "Mesh/Boxes/" + box.name;
    const auto integer = [](int i) { return std::to_string(i); };
    if (!names.insert(box.name).second) problems.add(path, "a second box of this name");
    if (!(box.x0 < box.x1)) problems.add(path + "/X", "an empty interval; expected its lower end first");
    if (!(box.y0 < box.y1)) problems.add(path + "/Y", "an empty interval; expected its lower end first");
    if (box.nx < 1 || box.ny < 1)
      problems.add(path + "/Cells", "{" + integer(box.nx) + ", " + integer(box.ny) + "}: expected at least one each way");
    else if (box.blocksX < 1 || box.blocksY < 1 || box.nx % box.blocksX != 0 || box.ny % box.blocksY != 0)
      problems.add(path + "/Blocks", "{" + integer(box.blocksX) + ", " + integer(box.blocksY) + "} do not divide the cells {" +
                                         integer(box.nx) + ", " + integer(box.ny) + "} into equal blocks");
    if (box.brickX < 0 || box.brickY < 0 || (box.brickX == 0) != (box.brickY == 0) ||
        (box.brickX >= std::max(1, box.nx) && box.brickY >= std::max(1, box.ny)))
      problems.add(path + "/Bricks", "{" + integer(box.brickX) + ", " + integer(box.brickY) + "} make no board of the cells {" +
                                         integer(box.nx) + ", " + integer(box.ny) +
                                         "}; expected at least one cell each way and two bricks");
  }
  problems.throwIfAny();
  // All that the mesh will take is known before any of it is.
  double nodes = 0, elements = 0, entries = 0;
  for (const Box& box : all) {
    const double cells = static_cast<double>(box.nx) * box.ny, order = Lattice::isQuadratic(box.cell) ? 2 : 1;
    const double made = cells * (cellInfo(box.cell).vertices == 3 ? 2 : 1);
    nodes += (order * box.nx + 1) * (order * box.ny + 1);
    elements += made;
    entries += made * cellInfo(box.cell).nodes;
  }
  const double most = std::numeric_limits<int>::max();
  if (nodes > most || entries > most)
    throw InputError("Mesh/Boxes",
                     realText(elements) + " elements with " + realText(nodes) + " nodes; expected fewer than 2^31 of anything");
  mustFit((16 * nodes + 4 * nodes + 4 * entries + 40 * elements) / (1 << 20), "Mesh/Boxes: a mesh of " + realText(elements) + " elements");
}

using Step = std::pair<int, int>;

class BoxMesher {
 public:
  BoxMesher(const Box& box, Mesh& mesh) : box_(box), mesh_(mesh), lattice_(box, mesh) {}

  void mesh() {
    const bool triangles = cellInfo(box_.cell).vertices == 3;
    for (int j = 0; j < box_.ny; ++j)
      for (int i = 0; i < box_.nx; ++i) {
        const Step a{i, j}, b{i + 1, j}, c{i + 1, j + 1}, d{i, j + 1};
        if (!triangles) {
          add({a, b, c, d}, i, j);
        } else if ((i + j) % 2 == 0) {  // diagonal a - c
          add({a, b, c}, i, j);
          add({a, c, d}, i, j);
        } else {  // diagonal b - d
          add({a, b, d}, i, j);
          add({b, c, d}, i, j);
        }
      }
  }

 private:
  void add(const std::vector<Step>& corners, int i, int j) {
    const int element = mesh_.elements();
    const int n = static_cast<int>(corners.size());
    const int q = lattice_.order();
    const auto put = [&](int x, int y) { mesh_.connectivity.push_back(lattice_.node(x, y)); };
    for (const Step& corner : corners) put(q * corner.first, q * corner.second);
    if (q == 2) {
      for (int s = 0; s < n; ++s) put(corners[s].first + corners[(s + 1) % n].first, corners[s].second + corners[(s + 1) % n].second);
      if (box_.cell == Cell::Quadrilateral9) put(2 * i + 1, 2 * j + 1);
    }
    mesh_.cells.push_back(box_.cell);
    mesh_.offsets.push_back(static_cast<int>(mesh_.connectivity.size()));

    mesh_.elementGroups[box_.name].push_back(element);
    const int blockX = i / (box_.nx / box_.blocksX), blockY = j / (box_.ny / box_.blocksY);
    mesh_.elementGroups["subdomain_" + box_.name + "_" + std::to_string(blockX) + "_" + std::to_string(blockY)].push_back(element);
    if (box_.brickX > 0)  // the last bricks are smaller where the cells do not divide
      mesh_.elementGroups[box_.name + ((i / box_.brickX + j / box_.brickY) % 2 == 0 ? "_bricks_even" : "_bricks_odd")].push_back(element);
    for (int s = 0; s < n; ++s) addSide(corners[s], corners[(s + 1) % n], Side{element, s});
  }

  void addSide(const Step& from, const Step& to, const Side& side) {
    const auto both = [&](int Step::*k, int at) { return from.*k == at && to.*k == at; };
    if (both(&Step::first, 0)) mesh_.sideGroups[box_.name + "_left"].push_back(side);
    if (both(&Step::first, box_.nx)) mesh_.sideGroups[box_.name + "_right"].push_back(side);
    if (both(&Step::second, 0)) mesh_.sideGroups[box_.name + "_bottom"].push_back(side);
    if (both(&Step::second, box_.ny)) mesh_.sideGroups[box_.name + "_top"].push_back(side);
  }

  const Box& box_;
  Mesh& mesh_;
  Lattice lattice_;
};

}  // namespace

Mesh boxes(const std::vector<Box>& all) {
  check(all);
  Mesh mesh;
  mesh.source = "boxes";
  std::vector<std::string> names;
  for (const Box& box : all) {
    BoxMesher(box, mesh).mesh();
    names.push_back(box.name);
  }
  assignBodies(mesh, names);
  return mesh;
}

}  // namespace suture
