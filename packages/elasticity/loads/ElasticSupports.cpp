#include <suture/elasticity/SideSprings.hpp>
#include <suture/elasticity/loads/ElasticSupports.hpp>

#include <algorithm>
#include <limits>

namespace suture {

ElasticSupports::ElasticSupports(const CellBlock& block, const SideGroups& groups, const ElasticModel& model) : block_(block) {
  for (std::size_t number = 0; number < model.supports.size(); ++number)
    for (const Side& side : sidesOf(groups, model.supports[number].groups)) {
      OnSide own;
      own.support = static_cast<int>(number);
      own.nodes = block.nodesOf(side);
      std::vector<Point> points;
      const Span<const int> ofElement = block.nodesOf(side.element);
      for (const int node : own.nodes) {
        points.push_back(block.point(node));
        own.places.push_back(static_cast<int>(std::find(ofElement.begin(), ofElement.end(), node) - ofElement.begin()));
      }
      own.stiffness = sideSprings(points, block, model.supports[number].normal, model.supports[number].tangential);
      sides_.emplace(side.element, std::move(own));
    }
}

void ElasticSupports::addStiffness(int element, LocalView stiffness) const {
  const int dimension = block_.dimension;
  const auto [begin, end] = sides_.equal_range(element);
  for (auto own = begin; own != end; ++own) {
    const OnSide& side = own->second;
    for (std::size_t a = 0; a < side.places.size(); ++a)
      for (std::size_t b = 0; b < side.places.size(); ++b)
        stiffness.block(dimension * side.places[a], dimension * side.places[b], dimension, dimension) +=
            side.stiffness.block(dimension * a, dimension * b, dimension, dimension);
  }
}

Vector ElasticSupports::forceOf(const OnSide& side, const Vector& displacement) const {
  const int dimension = block_.dimension;
  Vector u(dimension * side.nodes.size());
  for (std::size_t a = 0; a < side.nodes.size(); ++a) u.segment(dimension * a, dimension) = ofNode(displacement, side.nodes[a]);
  return side.stiffness * u;
}

ElasticSupports::Forces ElasticSupports::forces(const Vector& displacement) const {
  const int dimension = block_.dimension;
  Forces all{Vector::Zero(displacement.size()), Vector::Zero(block_.nodes()), Vector::Zero(block_.nodes())};
  for (const auto& [element, side] : sides_) {
    const Vector force = forceOf(side, displacement);
    double largest = 0.0;
    for (const int node : side.nodes) largest = std::max(largest, ofNode(displacement, node).norm());
    for (std::size_t a = 0; a < side.nodes.size(); ++a) {
      const int node = side.nodes[a];
      ofNode(all.nodal, node) += force.segment(dimension * a, dimension);
      all.stiffness[node] += side.stiffness.diagonal().segment(dimension * a, dimension).sum() / dimension;
      all.rounding[node] +=
          std::numeric_limits<double>::epsilon() * side.stiffness.middleRows(dimension * a, dimension).cwiseAbs().sum() * largest;
    }
  }
  return all;
}

void ElasticSupports::forEachSupport(const Vector& displacement, const std::function<void(int number, const Vector& forces)>& take) const {
  const int dimension = block_.dimension;
  std::map<int, Vector> bySupport;
  for (const auto& [element, side] : sides_) {
    Vector& sum = bySupport.try_emplace(side.support, Vector::Zero(displacement.size())).first->second;
    const Vector force = forceOf(side, displacement);
    for (std::size_t a = 0; a < side.nodes.size(); ++a) ofNode(sum, side.nodes[a]) -= force.segment(dimension * a, dimension);
  }
  for (const auto& [number, forces] : bySupport) take(number, forces);
}

void supportedStiffnesses(const CellBlock& block, const SideGroups& groups, const std::function<const Material&(int element)>& materialOf,
                          const ElasticModel& model, const std::function<void(int element, ConstLocalView stiffness)>& take) {
  const ElasticSupports supports(block, groups, model);
  if (supports.empty()) return elementStiffnesses(block, materialOf, model.plane, take);
  Matrix sum;
  elementStiffnesses(block, materialOf, model.plane, [&](int element, ConstLocalView stiffness) {
    sum = stiffness;
    supports.addStiffness(element, sum);
    take(element, sum);
  });
}

}  // namespace suture
