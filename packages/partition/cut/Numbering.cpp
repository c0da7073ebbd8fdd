#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/mesh/HilbertOrder.hpp>
#include <suture/partition/cut/Numbering.hpp>

#include <algorithm>

namespace suture {

namespace {

struct Centre {
  int subdomain;
  Point point;
};

// Means of the nodes of the subdomains that this rank cuts.
std::vector<Centre> centresOf(const CellBlock& block, const NodeSubdomains& holders) {
  std::vector<Point> sums;
  std::vector<int> nodes;
  for (int node = 0; node < block.nodes(); ++node)
    for (const int s : holders.of(node)) {
      if (s >= static_cast<int>(sums.size())) {
        sums.resize(s + 1, Point{});
        nodes.resize(s + 1, 0);
      }
      for (int k = 0; k < block.dimension; ++k) sums[s][k] += block.coordinates[std::size_t(node) * block.dimension + k];
      ++nodes[s];
    }
  std::vector<Centre> centres;
  for (std::size_t s = 0; s < sums.size(); ++s) {
    if (nodes[s] == 0) continue;
    for (double& x : sums[s]) x /= nodes[s];
    centres.push_back({static_cast<int>(s), sums[s]});
  }
  return centres;
}

template <typename T>
void permute(const std::vector<int>& newOf, std::vector<T>& values) {
  std::vector<T> old(values.size());
  old.swap(values);
  for (std::size_t i = 0; i < old.size(); ++i) values[newOf[i]] = std::move(old[i]);
}

void renumber(const std::vector<int>& newOf, MeshShare& share) {
  for (int& s : share.subdomainOfElement) s = newOf[s];
  for (int& s : share.holders.subdomains) s = newOf[s];
  const auto begin = share.holders.subdomains.begin();
  for (std::size_t node = 0; node + 1 < share.holders.offsets.size(); ++node)
    std::sort(begin + share.holders.offsets[node], begin + share.holders.offsets[node + 1]);
}

}  // namespace

void numberSubdomainsAlongCurve(const Comm& comm, const CellBlock& mesh, MeshShare& share, Cut& cut) {
  const CellBlock& block = share.block(mesh);
  const std::vector<Centre> centres = joinOnRoot(comm, centresOf(block, share.holders));
  std::vector<int> newOf;  // old number -> new one
  collectivelyOnRoot(comm, "partition", [&] {
    std::vector<Point> points(cut.names.size(), Point{});
    for (const Centre& centre : centres) points[centre.subdomain] = centre.point;
    newOf.resize(points.size());
    int next = 0;
    for (const int s : orderAlongHilbertCurve(points, mesh.dimension)) newOf[s] = next++;
    permute(newOf, cut.names);
    permute(newOf, cut.bodyOf);
    for (int& s : cut.subdomainOfElement) s = newOf[s];
  });
  broadcast(comm, newOf);
  renumber(newOf, share);
}

std::vector<std::string> numberedNames(const std::vector<std::string>& bodies, const std::vector<int>& bodyOf) {
  std::vector<int> numberInBody(bodies.size(), 0);
  std::vector<std::string> names;
  names.reserve(bodyOf.size());
  for (const int body : bodyOf) names.push_back(bodies[body] + " " + std::to_string(++numberInBody[body]));
  return names;
}

}  // namespace suture
