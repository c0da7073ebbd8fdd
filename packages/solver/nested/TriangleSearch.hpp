#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <array>
#include <vector>

namespace suture {

/// Finds the cell of a plane mesh that holds a point, cells seen as the triangles between their corners; by bins of about a cell's size.
/// Local. `mesh` need not outlive it.
class TriangleSearch {
 public:
  explicit TriangleSearch(const CellBlock& mesh);

  struct Place {
    double outside = 1e300;                    ///< largest negative barycentric coordinate: 0 inside, the distance in cell sizes outside
    std::array<int, 3> nodes{{0, 0, 0}};       ///< corners of the triangle
    std::array<double, 3> weights{{0, 0, 0}};  ///< weights of linear interpolation; extrapolates outside
  };
  /// The triangle nearest to the point, in its own size, among those in the bins about it; outside = 1e300 for a mesh of no cells.
  Place find(const Point& point) const;

 private:
  struct Triangle {
    std::array<int, 3> nodes;
    std::array<Point, 3> points;
  };
  std::array<int, 2> bin(const Point& point) const;

  std::vector<Triangle> triangles_;
  Point low_{0, 0, 0};
  double size_ = 1.0;
  int nx_ = 1, ny_ = 1;
  std::vector<std::vector<int>> bins_;
};

}  // namespace suture
