#include <suture/solver/nested/TriangleSearch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace suture {

TriangleSearch::TriangleSearch(const CellBlock& mesh) {
  Point high{-1e300, -1e300, 0};
  low_ = {1e300, 1e300, 0};
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> nodes = mesh.nodesOf(e);
    const int corners = static_cast<int>(cellInfo(mesh.cells[e]).sideNodes.size());  // as many as sides
    for (int k = 1; k + 1 < corners; ++k) {
      Triangle triangle{{nodes[0], nodes[k], nodes[k + 1]}, {}};
      for (int c = 0; c < 3; ++c) {
        triangle.points[c] = mesh.point(triangle.nodes[c]);
        for (int d = 0; d < 2; ++d) {
          low_[d] = std::min(low_[d], triangle.points[c][d]);
          high[d] = std::max(high[d], triangle.points[c][d]);
        }
      }
      triangles_.push_back(triangle);
    }
  }
  if (triangles_.empty()) return;
  const double width = high[0] - low_[0], height = high[1] - low_[1];
  size_ = std::max(std::sqrt(width * height / static_cast<double>(triangles_.size())) * 2.0, 1e-3 * std::max(width, height));
  nx_ = static_cast<int>(width / size_) + 1;
  ny_ = static_cast<int>(height / size_) + 1;
  bins_.resize(static_cast<std::size_t>(nx_) * ny_);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& p = triangles_[t].points;
    const Point least{std::min({p[0][0], p[1][0], p[2][0]}), std::min({p[0][1], p[1][1], p[2][1]}), 0};
    const Point most{std::max({p[0][0], p[1][0], p[2][0]}), std::max({p[0][1], p[1][1], p[2][1]}), 0};
    const auto from = bin(least), to = bin(most);
    for (int j = from[1]; j <= to[1]; ++j)
      for (int i = from[0]; i <= to[0]; ++i) bins_[static_cast<std::size_t>(j) * nx_ + i].push_back(static_cast<int>(t));
  }
}

std::array<int, 2> TriangleSearch::bin(const Point& point) const {
  return {std::clamp(static_cast<int>(std::floor((point[0] - low_[0]) / size_)), 0, nx_ - 1),
          std::clamp(static_cast<int>(std::floor((point[1] - low_[1]) / size_)), 0, ny_ - 1)};
}

TriangleSearch::Place TriangleSearch::find(const Point& point) const {
  Place best;
  if (triangles_.empty()) return best;
  const auto look = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= nx_ || j >= ny_) return;
    for (const int t : bins_[static_cast<std::size_t>(j) * nx_ + i]) {
      const auto& p = triangles_[t].points;
      const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]);
      std::array<double, 3> weights;
      for (int c = 0; c < 3; ++c) {
        const Point &a = p[(c + 1) % 3], &b = p[(c + 2) % 3];
        weights[c] = ((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])) / area;
      }
      const double outside = std::max(0.0, -*std::min_element(weights.begin(), weights.end()));
      if (outside < best.outside) best = {outside, triangles_[t].nodes, weights};
    }
  };
  // Points off a curved side lie in the next bin as a rule. Where bins are small next to some cells, or a hole is large, farther: rings of
  // bins until there is a triangle.
  const auto centre = bin(point);
  look(centre[0], centre[1]);
  for (int reach = 1; best.outside > 1e-12 && reach <= std::max(nx_, ny_); ++reach) {
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i)
        if (std::max(std::abs(i), std::abs(j)) == reach) look(centre[0] + i, centre[1] + j);
    if (best.outside < 1e300) break;
  }
  return best;
}

}  // namespace suture
