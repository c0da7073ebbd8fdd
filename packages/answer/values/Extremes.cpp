#include <suture/answer/values/Extremes.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <Eigen/Eigenvalues>
#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace suture {

namespace {

constexpr double kEqual = 1e-6;  // relative difference of values that count as equal

constexpr double kNoStress = 1e-9;  // relative to von Mises: a smaller principal stress is round-off of others, without location

bool isBefore(const Extreme& a, const Extreme& b) { return std::tie(a.body, a.id) < std::tie(b.body, b.id); }

/// A stress tensor: xx, yy, zz, xy, yz, xz.
using Tensor = std::array<double, 6>;

double vonMises(const Tensor& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3.0 * s[3] * s[3] + 3.0 * s[4] * s[4] + 3.0 * s[5] * s[5]);
}

/// Smallest and largest principal stress.
std::array<double, 2> principal(const Tensor& s) {
  if (s[4] == 0.0 && s[5] == 0.0) {  // as in 2D: zz is a principal stress
    const double mean = 0.5 * (s[0] + s[1]), radius = std::sqrt(0.25 * (s[0] - s[1]) * (s[0] - s[1]) + s[3] * s[3]);
    return {std::min(mean - radius, s[2]), std::max(mean + radius, s[2])};
  }
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  return {values[0], values[2]};
}

/// Searches of one rank, in the order of Extremes.
class Search {
 public:
  template <typename Place>
  void stress(const Tensor& s, int body, GlobalId id, const Place& place) {
    const double equivalent = vonMises(s);
    all_[0].take(equivalent, body, id, place);
    // Bounds every principal stress: few tensors need their eigenvalues.
    const double mean = (s[0] + s[1] + s[2]) / 3.0, farthest = (2.0 / 3.0 + kEqual) * equivalent;
    if (!all_[1].mayTake(mean + farthest) && !all_[2].mayTake(farthest - mean)) return;
    const auto [smallest, largest] = principal(s);
    all_[1].take(largest, body, id, place);
    all_[2].take(-smallest, body, id, place);
  }
  template <typename Place>
  void displacement(double size, int body, GlobalId id, const Place& place) {
    all_[3].take(size, body, id, place);
  }

  std::array<Extreme, 4> over(const Comm& comm) const {
    Packer packer;
    for (const Largest& one : all_) packer.put(one);
    std::array<Largest, 4> whole;
    for (const std::string& bytes : allGather(comm, packer.bytes())) {
      Unpacker unpacker(bytes);
      for (Largest& one : whole) {
        Largest theirs;
        unpacker.get(theirs);
        one.take(theirs);
      }
    }
    std::array<Extreme, 4> found;
    std::transform(whole.begin(), whole.end(), found.begin(), [](const Largest& one) { return one.found(); });
    return found;
  }

 private:
  std::array<Largest, 4> all_;
};

void searchDisplacements(const SubdomainMesh& mesh, const Vector& u, Search& search) {
  const int nodes = mesh.bodyNodes();
  for (int node = 0; node < nodes; ++node) {
    double squared = 0.0;
    for (int k = 0; k < mesh.dimension; ++k) {
      const double component = mesh.fromDrawn(u, Eigen::Index(node) * mesh.dimension + k);
      squared += component * component;
    }
    search.displacement(std::sqrt(squared), mesh.body, mesh.globalNodes[node], [&] { return mesh.point(node); });
  }
}

/// \param stresses  as elementStresses(), per element or, if `atNodes`, per node
void searchStresses(const SubdomainMesh& mesh, const Matrix& stresses, bool atNodes, Search& search) {
  Tensor s{};
  const int count = atNodes ? mesh.bodyNodes() : int(stresses.rows());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < int(stresses.cols()); ++k) s[std::size_t(k)] = stresses(i, k);
    search.stress(s, mesh.body, atNodes ? mesh.globalNodes[i] : mesh.globalElements[i],
                  [&] { return atNodes ? mesh.point(i) : centreOf(mesh, i); });
  }
}

}  // namespace

void Largest::insert(const Extreme& one) {
  const auto at = std::lower_bound(front_.begin(), front_.end(), one, isBefore);
  if (at != front_.begin() && !((at - 1)->value < one.value)) return;  // an earlier location has the same value
  if (at != front_.end() && !isBefore(one, *at) && !(at->value < one.value)) return;
  const auto end = std::find_if(at, front_.end(), [&](const Extreme& later) { return later.value > one.value; });
  front_.insert(front_.erase(at, end), one);
  least_ = front_.back().value - kEqual * std::abs(front_.back().value);
  front_.erase(front_.begin(), std::find_if(front_.begin(), front_.end(), [&](const Extreme& kept) { return kept.value >= least_; }));
}

Extreme Largest::found() const {
  if (front_.empty()) return {};
  Extreme first = front_.front();
  first.value = front_.back().value;
  return first;
}

Extreme largestVector(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement) {
  Search search;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int node = 0, nodes = meshes[i].bodyNodes(); node < nodes; ++node) {
      const int d = meshes[i].dimension;
      search.displacement(displacement[i].segment(Eigen::Index(node) * d, d).norm(), meshes[i].body, meshes[i].globalNodes[node],
                          [&] { return meshes[i].point(node); });
    }
  return search.over(comm)[3];
}

Extremes findExtremes(const Comm& comm, const SearchedFields& fields) {
  Search search;
  collectively(comm, "finding the extremes", [&] {
    for (std::size_t i = 0; i < fields.meshes.size(); ++i) {
      const SubdomainMesh& mesh = fields.meshes[i];
      searchDisplacements(mesh, fields.displacement[i], search);
      const auto own = fields.own.find(static_cast<int>(i));
      if (own != fields.own.end()) {
        searchStresses(mesh, own->second, false, search);
      } else if (!fields.nodal.empty()) {
        searchStresses(mesh, fields.nodal[i], true, search);
      } else {
        searchStresses(mesh, elementStresses(mesh, fields.model, fields.displacement[i]), false, search);
      }
    }
  });
  int recovered = !fields.nodal.empty();
  recovered = unionOverRanks(comm, {recovered}).back();
  auto [vonMises, tension, compression, displacement] = search.over(comm);
  compression.value = -compression.value;
  for (Extreme* one : {&tension, &compression})
    if (std::abs(one->value) <= kNoStress * vonMises.value) *one = {};
  return {vonMises, tension, compression, displacement, {}, recovered > 0};
}

}  // namespace suture
