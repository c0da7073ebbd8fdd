#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/SideMap.hpp>

namespace suture {

void addSideLoad(const CellBlock& block, const std::vector<Side>& sides, const Load& load, Vector& forces) {
  if (load.kind != Load::Kind::Traction && load.kind != Load::Kind::Pressure)
    throw InternalError("a " + nameOf(load.kind) + " on sides: expected a Traction or a Pressure (resolveLoads() makes them)");
  for (const Side& side : sides) {
    const std::vector<int> nodes = block.nodesOf(side);
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(block.point(node));
    SideMap map(points, load.rule(), block.axisymmetric);
    const ReferenceElement& reference = map.reference();
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      const Point value = load.at(map.place());
      double fx, fy;  // force at this point: traction times weight times ds/du
      if (load.kind == Load::Kind::Pressure) {
        // The body is on the left, so the outward normal times ds is (ty, -tx): a polynomial, integrated exactly on curved sides.
        fx = -value[0] * map.tangent()[1];
        fy = value[0] * map.tangent()[0];
      } else {
        fx = value[0] * map.measure();
        fy = value[1] * map.measure();
      }
      for (int a = 0; a < reference.nodes; ++a) {
        forces[2 * nodes[a]] += fx * reference.valuesAt(q)[a];
        forces[2 * nodes[a] + 1] += fy * reference.valuesAt(q)[a];
      }
    }
  }
}

void addSideFlux(const CellBlock& block, const Side& side, double factor, Vector& flux) {
  Load inward;  // a pressure pushes into the body
  inward.kind = Load::Kind::Pressure;
  inward.value[0] = -factor;
  addSideLoad(block, {side}, inward, flux);
}

void addBodyForce(const CellBlock& block, const std::vector<int>& elements, const Load& load, Vector& forces,
                  const std::function<double(int element)>& density) {
  if (!load.onElements()) throw InternalError("a " + nameOf(load.kind) + " does not act on elements");
  if (load.usesDensity() && !density) throw InternalError("a " + nameOf(load.kind) + " without densities");
  for (int e : elements) {
    const ReferenceElement& reference = referenceElement(block.cells[e], load.rule());
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap map(block, e, reference);
    const double mass = load.usesDensity() ? density(e) : 1.0;
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      const Point value = load.usesDensity() ? scaled(mass, load.at(map.place())) : load.at(map.place());
      for (int a = 0; a < reference.nodes; ++a)
        for (int k = 0; k < 2; ++k) forces[2 * nodes[a] + k] += value[k] * reference.valuesAt(q)[a] * map.measure();
    }
  }
}

}  // namespace suture
