#include <pairs/PairsTesting.hpp>

namespace pairstesting {

void move(Mesh& mesh, int body, const std::function<Point(Point)>& to) {
  for (int i = 0; i < mesh.nodes(); ++i) {
    if (mesh.bodyOfNode[i] != body) continue;
    const Point p = to(mesh.point(i));
    for (int k = 0; k < mesh.dimension; ++k) mesh.coordinates[std::size_t(mesh.dimension) * i + k] = p[k];
  }
}

void moveAll(Mesh& mesh, const std::function<Point(Point)>& to) {
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body) move(mesh, static_cast<int>(body), to);
}

}  // namespace pairstesting
