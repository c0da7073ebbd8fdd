#include <cmath>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>

namespace suture {

void addSideLoad(const CellBlock& block, const std::vector<Side>& sides, const Load& load, Vector& forces) {
  if (load.onBody()) throw InternalError("a load on bodies does not act on sides");
  for (const Side& side : sides) {
    const std::vector<int> nodes = block.nodesOf(side);
    const ReferenceElement& reference = referenceSide(static_cast<int>(nodes.size()));
    for (int q = 0; q < reference.points; ++q) {
      double tx = 0, ty = 0, weight = reference.weights[q];  // tangent, of the length ds/du
      for (int a = 0; a < reference.nodes; ++a) {
        const double slope = reference.gradientsAt(q)[a];
        tx += slope * block.coordinates[std::size_t(nodes[a]) * 2];
        ty += slope * block.coordinates[std::size_t(nodes[a]) * 2 + 1];
      }
      if (block.axisymmetric) {
        double radius = 0;
        for (int a = 0; a < reference.nodes; ++a) radius += reference.valuesAt(q)[a] * block.coordinates[std::size_t(nodes[a]) * 2];
        weight *= circumference(radius);
      }
      double fx, fy;  // force at this point: traction times weight times ds/du
      if (load.kind == Load::Kind::Pressure) {
        // The body is on the left, so the outward normal times ds is (ty, -tx): a polynomial, integrated exactly on curved sides.
        fx = -load.value[0] * weight * ty;
        fy = load.value[0] * weight * tx;
      } else {
        const double ds = weight * std::hypot(tx, ty);
        fx = load.value[0] * ds;
        fy = load.value[1] * ds;
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

void addBodyForce(const CellBlock& block, const std::vector<int>& elements, const Load& load, Vector& forces) {
  if (load.kind != Load::Kind::BodyForce) throw InternalError("only a body force acts on elements");
  for (int e : elements) {
    const ReferenceElement& reference = referenceElement(block.cells[e], Rule::Load);
    const Span<const int> nodes = block.nodesOf(e);
    ElementMap map(block, e, reference);
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      for (int a = 0; a < reference.nodes; ++a)
        for (int k = 0; k < 2; ++k) forces[2 * nodes[a] + k] += load.value[k] * reference.valuesAt(q)[a] * map.measure();
    }
  }
}

}  // namespace suture
