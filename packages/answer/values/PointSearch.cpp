#include <suture/answer/values/PointSearch.hpp>
#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/CellSearch.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <tuple>

namespace suture {

namespace {

/// An element that contains a point, or the one nearest to it. Trivially copyable.
struct Candidate {
  double off = std::numeric_limits<double>::infinity();  // distance outside: in reference coordinates, or [length]
  GlobalId element = -1;                                 // number in the mesh
  int body = -1, rank = -1;
  Point place{0, 0, 0};

  bool operator<(const Candidate& other) const { return std::tie(off, body, element) < std::tie(other.off, other.body, other.element); }
};

class PointSearch {
 public:
  PointSearch(const Comm& comm, const std::vector<SubdomainMesh>& meshes) : rank_(comm.getRank()), meshes_(meshes) {
    for (const SubdomainMesh& mesh : meshes) cells_.emplace_back(mesh);
  }

  Candidate find(const SoughtPoint& point, PointInElement& here) const {
    Candidate best;
    forEachMesh(point, [&](std::size_t m) {
      const CellSearch::Place place = cells_[m].find(point.place);
      const Candidate one = candidate(m, place, place.outside, point.place);
      if (place.element < 0 || !(one < best)) return;
      best = one;
      here = {static_cast<int>(m), place.element, place.at};
    });
    return best;
  }

  Candidate nearest(const SoughtPoint& point) const {
    Candidate best;
    forEachMesh(point, [&](std::size_t m) {
      const CellSearch::Nearest place = cells_[m].nearest(point.place);
      if (place.element >= 0) best = std::min(best, candidate(m, place, place.distance, place.foot));
    });
    return best;
  }

 private:
  template <typename Visit>
  void forEachMesh(const SoughtPoint& point, const Visit& visit) const {
    for (std::size_t m = 0; m < meshes_.size(); ++m)
      if (point.body < 0 || point.body == meshes_[m].body) visit(m);
  }
  Candidate candidate(std::size_t m, const CellSearch::Place& found, double off, const Point& place) const {
    return {off, found.element < 0 ? -1 : meshes_[m].globalElements[found.element], meshes_[m].body, rank_, place};
  }

  int rank_;
  const std::vector<SubdomainMesh>& meshes_;
  std::vector<CellSearch> cells_;
};

/// The best candidate of all ranks, for each point.
std::vector<Candidate> bestOf(const Comm& comm, const std::vector<Candidate>& mine) {
  Packer packer;
  packer.put(mine);
  std::vector<Candidate> best(mine.size());
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    const auto theirs = Unpacker(bytes).get<std::vector<Candidate>>();
    for (std::size_t i = 0; i < best.size(); ++i)
      if (theirs[i] < best[i]) best[i] = theirs[i];
  }
  return best;
}

}  // namespace

FoundPoints findPoints(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                       const std::vector<SoughtPoint>& points) {
  FoundPoints found;
  found.here.resize(points.size());
  std::vector<Candidate> mine(points.size());
  std::vector<PointSearch> search;
  collectively(comm, "finding the points of probes", [&] {
    search.emplace_back(comm, meshes);
    for (std::size_t i = 0; i < points.size(); ++i) mine[i] = search[0].find(points[i], found.here[i]);
  });
  const std::vector<Candidate> best = bestOf(comm, mine);
  std::vector<Candidate> nearest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (best[i].rank != comm.getRank()) found.here[i] = {};
    if (best[i].rank >= 0) continue;
    found.outside.push_back(static_cast<int>(i));
    nearest.push_back(search[0].nearest(points[i]));
  }
  if (found.outside.empty()) return found;
  const int dimension = agreedDimensionOf(comm, meshes);
  for (const Candidate& one : bestOf(comm, nearest)) {
    char text[300];
    std::snprintf(text, sizeof text, "'%s' is nearest, %.6g away at %s", one.body < 0 ? "" : bodies[one.body].c_str(), one.off,
                  placeText(one.place, dimension).c_str());
    found.nearest.push_back(text);
  }
  return found;
}

}  // namespace suture
