#include <suture/base/Errors.hpp>
#include <suture/base/Memory.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/mesh/Generators.hpp>

#include <algorithm>
#include <limits>
#include <set>

namespace suture {

namespace {

using Step = std::array<int, 3>;  // lattice indices

Step cellsOf(const Box& box) { return dimensionOf(box.cell) == 2 ? Step{box.nx, box.ny, 0} : Step{box.nx, box.ny, box.nz}; }
Step blocksOf(const Box& box) { return {box.blocksX, box.blocksY, dimensionOf(box.cell) == 2 ? 1 : box.blocksZ}; }
Step bricksOf(const Box& box) { return {box.brickX, box.brickY, dimensionOf(box.cell) == 2 ? box.brickX : box.brickZ}; }

/// "{6, 4}"
std::string textOf(const Step& values, int dimension) {
  std::string text;
  for (int k = 0; k < dimension; ++k) text += (k ? ", " : "{") + std::to_string(values[k]);
  return text + "}";
}

/// Lattice intervals per cell: two if nodes lie between vertices or, in pyramids, at the centre of the cell.
int intervalsOf(Cell cell) { return cellInfo(cell).order == 2 || cell == Cell::Pyramid5 ? 2 : 1; }

/// Number of elements into which a cell of the box is split.
int elementsOfCell(Cell cell) {
  if (isSimplex(cell)) return dimensionOf(cell) == 2 ? 2 : 6;
  return cell == Cell::Wedge6 ? 2 : cell == Cell::Pyramid5 ? 6 : 1;
}

/// The nodes of one box: a lattice of one or two intervals per cell, numbered row by row; lattice points without an element are omitted.
class Lattice {
 public:
  Lattice(const Box& box, Mesh& mesh) : dimension_(dimensionOf(box.cell)), intervals_(intervalsOf(box.cell)) {
    const Step cells = cellsOf(box);
    for (int k = 0; k < 3; ++k) count_[k] = intervals_ * cells[k] + 1;
    const double low[] = {box.x0, box.y0, box.z0}, high[] = {box.x1, box.y1, box.z1};
    int next = mesh.nodes();
    for (int k = 0; k < count_[2]; ++k)
      for (int j = 0; j < count_[1]; ++j)
        for (int i = 0; i < count_[0]; ++i) {
          const bool wanted = isNode(box.cell, {i, j, k});
          number_.push_back(wanted ? next++ : -1);
          const Step at{i, j, k};
          for (int d = 0; wanted && d < dimension_; ++d) mesh.coordinates.push_back(between(low[d], high[d], at[d], count_[d] - 1));
        }
  }
  int intervals() const { return intervals_; }
  int node(const Step& at) const { return number_[(std::size_t(at[2]) * count_[1] + at[1]) * count_[0] + at[0]]; }

 private:
  bool isNode(Cell cell, const Step& at) const {
    if (intervals_ == 1) return true;
    const int odd = at[0] % 2 + at[1] % 2 + at[2] % 2;
    if (cell == Cell::Quadrilateral8 || cell == Cell::Hexahedron20) return odd < 2;
    return cell != Cell::Pyramid5 || odd == 0 || odd == 3;
  }
  // Both ends are exact, so that boxes with equal ends have coinciding nodes there.
  static double between(double low, double high, int i, int n) { return i == n ? high : low + (high - low) * (static_cast<double>(i) / n); }

  int dimension_, intervals_;
  Step count_{};
  std::vector<int> number_;
};

void checkBox(const Box& box, Problems& problems) {
  const std::string path = "Mesh/Boxes/" + box.name;
  const int dimension = dimensionOf(box.cell);
  const Step cells = cellsOf(box), blocks = blocksOf(box), bricks = bricksOf(box);
  const double low[] = {box.x0, box.y0, box.z0}, high[] = {box.x1, box.y1, box.z1};
  for (int k = 0; k < dimension; ++k)
    if (!(low[k] < high[k])) problems.add(path + "/" + "XYZ"[k], "an empty interval; expected its lower end first");
  bool some = true, divides = true, small = false, isBoard = true;
  for (int k = 0; k < dimension; ++k) {
    some = some && cells[k] >= 1;
    divides = divides && blocks[k] >= 1 && cells[k] % std::max(1, blocks[k]) == 0;
    small = small || bricks[k] < std::max(1, cells[k]);
    isBoard = isBoard && bricks[k] >= 0 && (bricks[k] == 0) == (bricks[0] == 0);
  }
  if (!some)
    problems.add(path + "/Cells", textOf(cells, dimension) + ": expected at least one in each direction");
  else if (!divides)
    problems.add(path + "/Blocks",
                 textOf(blocks, dimension) + " do not divide the cells " + textOf(cells, dimension) + " into equal blocks");
  if (!isBoard || !small)
    problems.add(path + "/Bricks", textOf(bricks, dimension) + " do not form a board of the cells " + textOf(cells, dimension) +
                                       "; expected at least one cell in each direction and two bricks");
}

void check(const std::vector<Box>& all) {
  Problems problems;
  std::set<std::string> names;
  for (const Box& box : all) {
    if (!names.insert(box.name).second) problems.add("Mesh/Boxes/" + box.name, "a second box of this name");
    if (dimensionOf(box.cell) != dimensionOf(all.front().cell))
      problems.add("Mesh/Boxes/" + box.name + "/Cell", cellInfo(box.cell).name + ", but " + cellInfo(all.front().cell).name + " in '" +
                                                           all.front().name + "'; expected all boxes in 2D or all in 3D");
    checkBox(box, problems);
  }
  problems.throwIfAny();
  // Checks the memory needed before any is allocated.
  double nodes = 0, elements = 0, entries = 0;
  for (const Box& box : all) {
    double cells = 1, places = 1;
    for (int k = 0; k < dimensionOf(box.cell); ++k) {
      cells *= cellsOf(box)[k];
      places *= static_cast<double>(intervalsOf(box.cell)) * cellsOf(box)[k] + 1;
    }
    const double made = cells * elementsOfCell(box.cell);
    nodes += places;
    elements += made;
    entries += made * cellInfo(box.cell).nodes;
  }
  const double most = std::numeric_limits<int>::max();
  if (nodes > most || entries > most)
    throw InputError("Mesh/Boxes", realText(elements) + " elements with " + realText(nodes) + " nodes; expected fewer than 2^31 of each");
  mustFit((24 * nodes + 4 * nodes + 4 * entries + 40 * elements) / (1 << 20), "Mesh/Boxes: a mesh of " + realText(elements) + " elements");
}

class BoxMesher {
 public:
  BoxMesher(const Box& box, Mesh& mesh) : box_(box), mesh_(mesh), lattice_(box, mesh), cell_(cellInfo(box.cell)) {}

  void mesh() {
    const Step cells = cellsOf(box_);
    for (int k = 0; k < std::max(1, cells[2]); ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i) cut({i, j, k});
  }

 private:
  /// A corner of the cell, in cell indices: bit d of `corner` is the step in direction d.
  static Step cornerOf(const Step& cell, int corner) {
    return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1)};
  }

  void cut(const Step& cell) {
    const bool even = (cell[0] + cell[1]) % 2 == 0;
    const auto put = [&](const std::vector<int>& corners) { add(corners, cell); };
    switch (box_.cell) {
      case Cell::Triangle3:
      case Cell::Triangle6:
        put(even ? std::vector<int>{0, 1, 3} : std::vector<int>{0, 1, 2});
        put(even ? std::vector<int>{0, 3, 2} : std::vector<int>{1, 3, 2});
        return;
      case Cell::Wedge6:
        put(even ? std::vector<int>{0, 1, 3, 4, 5, 7} : std::vector<int>{0, 1, 2, 4, 5, 6});
        put(even ? std::vector<int>{0, 3, 2, 4, 7, 6} : std::vector<int>{1, 3, 2, 5, 7, 6});
        return;
      case Cell::Tetrahedron4:
      case Cell::Tetrahedron10:
        return cutIntoTetrahedra(cell, put);
      case Cell::Pyramid5:
        for (const std::vector<int>& side :
             {std::vector<int>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
          put({side[3], side[2], side[1], side[0], -1});  // orientation of the base: seen from the apex
        return;
      default:
        put(dimensionOf(box_.cell) == 2 ? std::vector<int>{0, 1, 3, 2} : std::vector<int>{0, 1, 3, 2, 4, 5, 7, 6});
    }
  }

  // The six paths from a corner to the opposite one along the edges (Kuhn), from the corner with three even indices: adjacent cells split
  // their common side in the same way.
  template <typename Put>
  static void cutIntoTetrahedra(const Step& cell, const Put& put) {
    const int start = (cell[0] % 2) | (cell[1] % 2) << 1 | (cell[2] % 2) << 2;
    const bool mirrored = (cell[0] + cell[1] + cell[2]) % 2 != 0;
    static const int ways[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int way = 0; way < 6; ++way) {
      std::vector<int> corners{start};
      for (const int direction : ways[way]) corners.push_back(corners.back() ^ 1 << direction);
      if ((way >= 3) != mirrored) std::swap(corners[2], corners[3]);
      put(corners);
    }
  }

  /// \param corners  of the cell, one per vertex of the element; -1: the cell's centre
  void add(const std::vector<int>& corners, const Step& cell) {
    const int element = mesh_.elements();
    const int n = lattice_.intervals();
    std::vector<Step> places;  // lattice indices of the vertices
    for (const int corner : corners) {
      const Step at = corner < 0 ? Step{2 * cell[0] + 1, 2 * cell[1] + 1, 2 * cell[2] + 1} : cornerOf(cell, corner);
      places.push_back(corner < 0 ? at : Step{n * at[0], n * at[1], n * at[2]});
      mesh_.connectivity.push_back(lattice_.node(places.back()));
    }
    const auto middle = [&](const auto& vertices) {
      Step sum{0, 0, 0};
      int count = 0;
      for (const int vertex : vertices) {
        if (vertex >= cell_.vertices) continue;
        for (int d = 0; d < 3; ++d) sum[d] += places[vertex][d];
        ++count;
      }
      for (int& s : sum) s /= count;
      mesh_.connectivity.push_back(lattice_.node(sum));
    };
    if (cell_.order == 2)
      for (const auto& edge : cell_.edges) middle(edge);
    if (box_.cell == Cell::Hexahedron27)
      for (const std::vector<int>& side : cell_.sideNodes) middle(side);
    if (box_.cell == Cell::Quadrilateral9 || box_.cell == Cell::Hexahedron27) middle(std::vector<int>{0, cell_.dimension == 2 ? 2 : 6});
    mesh_.cells.push_back(box_.cell);
    mesh_.offsets.push_back(static_cast<int>(mesh_.connectivity.size()));
    addToGroups(element, cell);
    for (int s = 0; s < static_cast<int>(cell_.sideNodes.size()); ++s) addSide(places, Side{element, s});
  }

  void addToGroups(int element, const Step& cell) {
    mesh_.elementGroups[box_.name].push_back(element);
    const Step cells = cellsOf(box_), blocks = blocksOf(box_), bricks = bricksOf(box_);
    std::string block = "subdomain_" + box_.name;
    int brick = 0;
    for (int d = 0; d < cell_.dimension; ++d) {
      block += "_" + std::to_string(cell[d] / (cells[d] / blocks[d]));
      if (bricks[d] > 0) brick += cell[d] / bricks[d];
    }
    mesh_.elementGroups[block].push_back(element);
    if (bricks[0] > 0)  // the last bricks are smaller if the cells are not divisible
      mesh_.elementGroups[box_.name + (brick % 2 == 0 ? "_bricks_even" : "_bricks_odd")].push_back(element);
  }

  void addSide(const std::vector<Step>& places, const Side& side) {
    static const char* const inPlane[] = {"_left", "_right", "_bottom", "_top"};
    static const char* const inSpace[] = {"_left", "_right", "_front", "_back", "_bottom", "_top"};
    const Step cells = cellsOf(box_);
    for (int d = 0; d < cell_.dimension; ++d)
      for (const int end : {0, 1}) {
        const int wanted = end == 0 ? 0 : lattice_.intervals() * cells[d];
        bool all = true;
        for (const int local : cell_.sideNodes[side.side]) all = all && (local >= cell_.vertices || places[local][d] == wanted);
        if (all) mesh_.sideGroups[box_.name + (cell_.dimension == 2 ? inPlane : inSpace)[2 * d + end]].push_back(side);
      }
  }

  const Box& box_;
  Mesh& mesh_;
  Lattice lattice_;
  const CellInfo& cell_;
};

}  // namespace

Mesh boxes(const std::vector<Box>& all) {
  check(all);
  Mesh mesh;
  mesh.source = "boxes";
  if (!all.empty()) mesh.dimension = dimensionOf(all.front().cell);
  std::vector<std::string> names;
  for (const Box& box : all) {
    BoxMesher(box, mesh).mesh();
    names.push_back(box.name);
  }
  assignBodies(mesh, names);
  return mesh;
}

}  // namespace suture
