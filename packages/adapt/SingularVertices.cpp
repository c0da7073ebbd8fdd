#include <suture/adapt/SingularVertices.hpp>

#include <set>

namespace suture {

namespace {

constexpr double kDominates = 8.0;  // mean squared error at a singular vertex over that of the next ring of elements

/// Elements at each vertex.
std::vector<std::vector<int>> starsOf(const Mesh& mesh) {
  std::vector<std::vector<int>> stars(static_cast<std::size_t>(mesh.nodes()));
  for (int e = 0; e < mesh.elements(); ++e)
    for (int k = 0; k <= mesh.dimension; ++k) stars[static_cast<std::size_t>(mesh.nodesOf(e)[k])].push_back(e);
  return stars;
}

}  // namespace

std::vector<int> singularVertices(const Mesh& mesh, const std::vector<double>& squares) {
  std::vector<int> singular(squares.size(), -1);
  if (mesh.dimension == 3) return singular;
  const std::vector<std::vector<int>> stars = starsOf(mesh);
  std::vector<double> most(squares.size(), 0.0);
  for (std::size_t v = 0; v < stars.size(); ++v) {
    if (stars[v].empty()) continue;
    double inner = 0, outer = 0;
    std::set<int> ring;
    for (const int e : stars[v]) {
      inner += squares[static_cast<std::size_t>(e)] / static_cast<double>(stars[v].size());
      for (int k = 0; k <= mesh.dimension; ++k)
        ring.insert(stars[static_cast<std::size_t>(mesh.nodesOf(e)[k])].begin(), stars[static_cast<std::size_t>(mesh.nodesOf(e)[k])].end());
    }
    for (const int e : stars[v]) ring.erase(e);
    for (const int e : ring) outer += squares[static_cast<std::size_t>(e)] / static_cast<double>(ring.size());
    if (ring.empty() || inner <= kDominates * outer) continue;
    for (const int e : stars[v]) {
      double& before = most[static_cast<std::size_t>(e)];
      if (inner <= before) continue;
      before = inner;
      singular[static_cast<std::size_t>(e)] = static_cast<int>(v);
    }
  }
  return singular;
}

}  // namespace suture
