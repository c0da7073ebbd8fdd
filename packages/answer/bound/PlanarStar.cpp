#include <suture/answer/bound/PlanarStar.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

/// Collects the triangles and sides in their order around the vertex, from one boundary to the other. False if that is not possible.
bool PlanarStar::walk(int v) {
  const Span<const int> star = mesh_.star(v);
  triangles_.clear();
  spokes_.clear();
  const auto numberOf = [v](const auto& vertices) { return vertices[0] == v ? 0 : vertices[1] == v ? 1 : 2; };
  int element = star[0], side = -1, place = 0;  // place: of the side in the triangle
  for (const int e : star)
    for (int a = 0; a < 3 && side < 0; ++a)
      if (mesh_.verticesOf(e)[a] != v && mesh_.elementsOfSide(mesh_.sidesOfElement(e)[a])[1] < 0)
        element = e, side = mesh_.sidesOfElement(e)[a], place = a;
  closed_ = side < 0;
  if (closed_) {
    place = numberOf(mesh_.verticesOf(element)) == 0 ? 1 : 0;
    side = mesh_.sidesOfElement(element)[place];
  }
  const int first = side;
  double sign = -mesh_.sign(element, place);
  while (true) {
    if (triangles_.size() == star.size()) return false;
    const int node = numberOf(mesh_.verticesOf(element));
    triangles_.push_back({element, node});
    spokes_.push_back({side, numberOf(mesh_.verticesOfSide(side)), sign});
    place = 3 - node - place;
    side = mesh_.sidesOfElement(element)[place];
    sign = mesh_.sign(element, place);
    const auto& both = mesh_.elementsOfSide(side);
    if (both[1] < 0) {
      if (closed_) return false;
      spokes_.push_back({side, numberOf(mesh_.verticesOfSide(side)), sign});
      break;
    }
    if (side == first) break;
    element = both[0] == element ? both[1] : both[0];
    const auto& sides = mesh_.sidesOfElement(element);
    place = int(std::find(sides.begin(), sides.end(), side) - sides.begin());
  }
  return triangles_.size() == star.size();
}

bool PlanarStar::isUnknown(const Spoke& spoke, int k) const {
  const SideCondition<2>* boundary = mesh_.boundaryOf(spoke.side);
  return !boundary || !(boundary->known >> k & 1u);
}

double PlanarStar::balanceVertex(int v) {
  if (!walk(v)) return -1.0;
  for (const Spoke& spoke : spokes_)
    if (const SideCondition<2>* boundary = mesh_.boundaryOf(spoke.side))
      if ((boundary->known == 1 || boundary->known == 2) && !boundary->axes.isIdentity(0.0)) return -1.0;
  return std::max(balanceComponent(0), balanceComponent(1));
}

/// A moment acts on the triangle before it with the sign of the spoke and on the next one with the opposite sign: changes differ from spoke
/// to spoke by the rest of the triangle between them.
double PlanarStar::balanceComponent(int k) {
  const std::size_t n = triangles_.size(), count = spokes_.size();
  const auto moment = [&](std::size_t i) {
    const Spoke& spoke = spokes_[i % count];
    return spoke.sign * moments_(2 * spoke.node + k, spoke.side);
  };
  changes_.assign(n + 1, 0.0);
  double before = moment(0);
  for (std::size_t i = 0; i < n; ++i) {
    const double behind = moment(i + 1);
    changes_[i + 1] = changes_[i] + mesh_.element(triangles_[i].element).forces(k, triangles_[i].node) - behind + before;
    before = behind;
  }
  const double total = changes_[n];
  double rest = 0.0, shift = 0.0;
  const bool unknownFirst = closed_ || isUnknown(spokes_.front(), k), unknownLast = closed_ || isUnknown(spokes_.back(), k);
  if (unknownFirst && unknownLast) {  // the change of least norm
    for (std::size_t i = 0; i < count; ++i) shift -= changes_[i] / double(count);
    if (closed_) rest = std::abs(total);
  } else if (unknownFirst) {
    shift = -total;
  } else if (!unknownLast) {
    rest = std::abs(total);
  }
  for (std::size_t i = 0; i < count; ++i)
    if ((i > 0 || unknownFirst) && (i < n || unknownLast))
      moments_(2 * spokes_[i].node + k, spokes_[i].side) += spokes_[i].sign * (changes_[i] + shift);
  return rest;
}

double PlanarStar::balanceMiddle(int side) {
  const auto& both = mesh_.elementsOfSide(side);
  Eigen::Vector2d rests[2] = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  double signs[2] = {0.0, 0.0};
  auto moment = moments_.col(side).segment<2>(4);
  for (int i = 0; i < 2 && both[i] >= 0; ++i) {
    const auto& sides = mesh_.sidesOfElement(both[i]);
    const int a = int(std::find(sides.begin(), sides.end(), side) - sides.begin());
    signs[i] = mesh_.sign(both[i], a);
    rests[i] = mesh_.element(both[i]).forces.col(SimplexNodes<2>::vertices + a) - signs[i] * moment;
  }
  Eigen::Vector2d change = signs[0] * rests[0];
  if (const SideCondition<2>* boundary = mesh_.boundaryOf(side)) {
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d axis = boundary->axes.row(k).transpose();
      if (boundary->known >> k & 1u) change -= axis * axis.dot(change);
    }
  } else {
    change = 0.5 * (change + signs[1] * rests[1]);
  }
  moment += change;
  return (rests[0] + rests[1] - (signs[0] + signs[1]) * change).cwiseAbs().maxCoeff();
}

}  // namespace suture
