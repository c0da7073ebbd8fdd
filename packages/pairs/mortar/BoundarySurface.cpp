#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/Types.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/pairs/mortar/BoundarySurface.hpp>
#include <suture/pairs/mortar/SmoothParts.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr int kPasses = 20;           // largest number of updates of the normal
constexpr double kUpright = 1e-14;    // last tilt and change of k
constexpr double kCurvatures = 1e-3;  // scale of curvatures: neighbours in two rows cannot separate tilt and curvature; tilt is preferred
constexpr std::size_t kEnough = 6;    // neighbours for five coefficients
constexpr double kDependent = 3e-5;   // ratio of pivots up to which neighbours cannot separate coefficients: curvatures of two rows
constexpr double kUncurved = 1e-9;    // trace of H relative to the inverse distance of the neighbours

using Jet = BoundarySurface::Jet;

/// Fits the surface at one node. \param arms  to its neighbours [length]
Jet fit(Point normal, const std::vector<Point>& arms) {
  double size = 0;
  for (const Point& arm : arms) size += norm(arm) / double(arms.size());
  Vector c = Vector::Zero(5);
  Point s{}, t{};
  double k = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<Point> frame = pairFrame(normal, 3);
    s = frame[1], t = frame[2];
    Matrix by(arms.size(), 5);
    Vector heights(arms.size());
    for (std::size_t i = 0; i < arms.size(); ++i) {
      const Point d = scaled(1 / size, arms[i]);
      const double x = dot(d, s), y = dot(d, t), z = dot(d, normal), weight = 1 / dot(d, d);
      by.row(Eigen::Index(i)) << weight * x, weight * y, -weight * x * x / 2, -weight * x * y, -weight * y * y / 2;
      by.row(Eigen::Index(i)).tail(3) *= kCurvatures;
      heights[Eigen::Index(i)] = weight * (z + k * z * z / 2);
    }
    Eigen::CompleteOrthogonalDecomposition<Matrix> solver;
    solver.setThreshold(kDependent);
    c = solver.compute(by).solve(heights);
    c.tail(3) *= kCurvatures;
    // For a saddle the trace may vanish: the norm of the tensor bounds every curvature.
    const double trace = c[2] + c[4], squares = c[2] * c[2] + 2 * c[3] * c[3] + c[4] * c[4], most = std::sqrt(squares);
    const double before = k;
    k = std::abs(trace) > kUncurved ? std::clamp(squares / trace, -most, most) : 0.0;
    normal = unit(minus(normal, plus(scaled(c[0], s), scaled(c[1], t))));
    if (std::abs(c[0]) + std::abs(c[1]) + std::abs(k - before) <= kUpright) break;
  }
  Jet jet;
  jet.normal = normal;
  jet.along = k / size;
  for (int i = 0; i < 3; ++i)
    jet.bend[i] = scaled(1 / size, plus(scaled(c[2] * s[i] + c[3] * t[i], s), scaled(c[3] * s[i] + c[4] * t[i], t)));
  return jet;
}

/// The sides of one part around each node.
class Fitting {
 public:
  Fitting(const Surface& surface, const std::vector<int>& sides) : surface_(surface) {
    for (const int side : sides)
      for (const int node : surface.nodesOf(side)) sidesAt_[node].push_back(side);
  }

  const Jet& at(int node) {
    const auto found = jets_.find(node);
    if (found != jets_.end()) return found->second;
    std::set<int> near{node};
    for (std::size_t before = 0; near.size() <= kEnough && near.size() > before;) before = near.size(), near = grown(near);
    near.erase(node);
    std::vector<Point> arms;
    for (const int other : near) arms.push_back(minus(surface_.at(other).position, surface_.at(node).position));
    return jets_[node] = fit(firstNormal(node), arms);
  }

 private:
  std::set<int> grown(const std::set<int>& nodes) const {
    std::set<int> all;
    for (const int node : nodes)
      for (const int side : sidesAt_.at(node)) all.insert(surface_.nodesOf(side).begin(), surface_.nodesOf(side).end());
    return all;
  }
  /// Mean over the corners, exact for spheres if nodes surround this one (Max 1999).
  Point firstNormal(int node) const {
    Point sum{0, 0, 0};
    for (const int side : sidesAt_.at(node)) {
      const std::vector<int>& nodes = surface_.nodesOf(side);
      const std::size_t at = std::size_t(std::find(nodes.begin(), nodes.end(), node) - nodes.begin()), count = nodes.size();
      const Point &here = surface_.at(node).position, a = minus(surface_.at(nodes[(at + 1) % count]).position, here),
                  b = minus(surface_.at(nodes[(at + count - 1) % count]).position, here);
      sum = plus(sum, scaled(1 / (dot(a, a) * dot(b, b)), cross(a, b)));
    }
    return unit(sum);
  }

  const Surface& surface_;
  std::map<int, std::vector<int>> sidesAt_;
  std::map<int, Jet> jets_;
};

}  // namespace

double BoundarySurface::Jet::curvature(const Point& arm) const {
  const double height = dot(normal, arm);
  return along * height * height + arm[0] * dot(bend[0], arm) + arm[1] * dot(bend[1], arm) + arm[2] * dot(bend[2], arm);
}

BoundarySurface::BoundarySurface(const Surface& surface, const std::vector<int>& groupOf) : jets_(std::size_t(surface.sides())) {
  if (surface.dimension() != 3) throw InternalError("BoundarySurface needs a 3D surface");
  for (int side = 0; side < surface.sides(); ++side)
    if (surface.nodesOf(side).size() > 4) throw InternalError("BoundarySurface needs first-order sides");
  const SmoothParts parts = smoothParts(surface, groupOf);
  std::map<int, std::vector<int>> curved;
  for (int side = 0; side < surface.sides(); ++side)
    if (!parts.isFlat[side]) curved[parts.partOf[side]].push_back(side);
  for (const auto& [part, sides] : curved) {
    Fitting fitting(surface, sides);
    for (const int side : sides)
      for (const int node : surface.nodesOf(side)) jets_[side].push_back(fitting.at(node));
  }
}

}  // namespace suture
