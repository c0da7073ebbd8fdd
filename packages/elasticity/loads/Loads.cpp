#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/SideMap.hpp>

namespace suture {

void addSideLoad(const CellBlock& block, const std::vector<Side>& sides, const Load& load, Vector& forces) {
  if (load.kind != Load::Kind::Traction && load.kind != Load::Kind::Pressure)
    throw InternalError("a " + nameOf(load.kind) + " on sides: expected a Traction or a Pressure (call resolveLoads() first)");
  const int dimension = block.dimension;
  for (const Side& side : sides) {
    const std::vector<int> nodes = block.nodesOf(side);
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(block.point(node));
    SideMap map(points, dimension, load.rule(), block.axisymmetric);
    const ReferenceElement& reference = map.reference();
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      const Point value = scaled(load.factor, load.at(map.place()));
      const bool pushes = load.kind == Load::Kind::Pressure;  // along the normal: a polynomial, integrated exactly also on curved sides
      const Point force = pushes ? scaled(-value[0], map.normal()) : scaled(map.measure(), value);
      for (int a = 0; a < reference.nodes; ++a)
        for (int k = 0; k < dimension; ++k) forces[Eigen::Index(nodes[a]) * dimension + k] += force[k] * reference.valuesAt(q)[a];
    }
  }
}

void addSideFlux(const CellBlock& block, const Side& side, double factor, Vector& flux) {
  Load inward;  // a pressure acts into the body
  inward.kind = Load::Kind::Pressure;
  inward.value[0] = -factor;
  addSideLoad(block, {side}, inward, flux);
}

namespace {

template <int D>
void addTo(const CellBlock& block, int element, const Load& load, double mass, Vector& forces) {
  const ReferenceElement& reference = referenceElement(block.cells[element], load.rule());
  const Span<const int> nodes = block.nodesOf(element);
  ElementMap<D> map(block, element, reference);
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    const Point value = scaled(load.usesDensity() ? load.factor * mass : load.factor, load.at(map.place()));
    for (int a = 0; a < reference.nodes; ++a)
      for (int k = 0; k < D; ++k) forces[D * nodes[a] + k] += value[k] * reference.valuesAt(q)[a] * map.measure();
  }
}

}  // namespace

void addBodyForce(const CellBlock& block, const std::vector<int>& elements, const Load& load, Vector& forces,
                  const std::function<double(int element)>& density) {
  if (!load.onElements()) throw InternalError("a " + nameOf(load.kind) + " does not act on elements");
  if (load.usesDensity() && !density) throw InternalError("a " + nameOf(load.kind) + " without densities");
  for (const int e : elements) {
    const double mass = load.usesDensity() ? density(e) : 1.0;
    block.dimension == 2 ? addTo<2>(block, e, load, mass, forces) : addTo<3>(block, e, load, mass, forces);
  }
}

}  // namespace suture
