#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>
#include <suture/quality/ElementForces.hpp>
#include <suture/quality/Findings.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

namespace suture {

namespace {

using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * ReferenceElement::maxNodes, 1>;

/// Displacements less those of the first node, as far as a translation costs nothing. Returns the largest of what was given.
template <bool hoop, int count>
double localDisplacement(const int* nodes, const Vector& displacement, double* u) {
  const double first[2] = {hoop ? 0.0 : displacement[2 * nodes[0]], displacement[2 * nodes[0] + 1]};
  double largest = 0.0;
  for (int a = 0; a < count; ++a)
    for (int k = 0; k < 2; ++k) {
      const double value = displacement[2 * nodes[a] + k];
      u[2 * a + k] = value - first[k];
      largest = std::max(largest, std::abs(value));
    }
  return largest;
}

/// \tparam count  nodes of the element: the compiler unrolls its loops
template <bool hoop, int count>
void addElement(const CellBlock& block, int element, const HookesLaw& law, const Vector& displacement, ElementForces& forces) {
  const ReferenceElement& reference = referenceElement(block.cells[element], stiffnessRule(block));
  const int* nodes = block.nodesOf(element).begin();
  double u[2 * count];
  const double largest = localDisplacement<hoop, count>(nodes, displacement, u);
  ElementMap map(block, element, reference);
  std::optional<MixedPressure> pressure;
  if (law.projected != 0.0) pressure.emplace(block.cells[element], reference, map);
  const double stiffest = law.normal() + law.projected, slip = law.pointwise(3, 3);
  for (int a = 0; pressure && a < count; ++a)
    forces.stiffness[nodes[a]] += 0.5 * law.projected * (pressure->diagonal(2 * a) + pressure->diagonal(2 * a + 1));
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, steepness = 0.0;
    for (int a = 0; a < count; ++a) {
      const double ux = u[2 * a], uy = u[2 * a + 1], gx = map.gradient(a)[0], gy = map.gradient(a)[1];
      xx += gx * ux;
      yy += gy * uy;
      xy += gy * ux + gx * uy;
      steepness += std::abs(gx) + std::abs(gy);
      if constexpr (hoop) {
        zz += map.hoop(a) * ux;
        steepness += map.hoop(a);
      }
    }
    Eigen::Vector4d stress = law.pointwise.col(0) * xx + law.pointwise.col(1) * yy + law.pointwise.col(3) * xy;
    if constexpr (hoop) stress += law.pointwise.col(2) * zz;
    if (pressure)
      stress.head<3>().array() += law.projected * pressure->dilatation(ElementVector(Eigen::Map<const Vector>(u, 2 * count)), map.place());
    stress *= map.measure();
    const double rounded = map.measure() * stiffest * unitRoundoff * steepness * largest;
    for (int a = 0; a < count; ++a) {
      const double gx = map.gradient(a)[0], gy = map.gradient(a)[1];
      double fx = gx * stress[0] + gy * stress[3], slope = std::abs(gx) + std::abs(gy), squares = gx * gx + gy * gy;
      if constexpr (hoop) {
        const double h = map.hoop(a);
        fx += h * stress[2];
        slope += h;
        squares += h * h;
      }
      forces.internal[2 * nodes[a]] += fx;
      forces.internal[2 * nodes[a] + 1] += gy * stress[1] + gx * stress[3];
      forces.rounding[nodes[a]] += rounded * slope;
      forces.stiffness[nodes[a]] += 0.5 * (law.normal() + slip) * map.measure() * squares;
    }
  }
}

/// Adds a plane 3-node triangle: its strain is constant, and the bulk of large meshes takes two thirds of the instructions. False: it is
/// folded, which addElement() reports.
bool addTriangle(const CellBlock& block, int element, const HookesLaw& law, const Vector& displacement, ElementForces& forces) {
  const int* nodes = block.nodesOf(element).begin();
  double u[6], x[3], y[3], gx[3], gy[3];
  const double largest = localDisplacement<false, 3>(nodes, displacement, u);
  for (int a = 0; a < 3; ++a) {
    x[a] = block.coordinates[std::size_t(nodes[a]) * 2];
    y[a] = block.coordinates[std::size_t(nodes[a]) * 2 + 1];
  }
  const double twice = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (!(twice > 0.0)) return false;
  const double inverse = 1.0 / twice, area = 0.5 * twice;
  double xx = 0.0, yy = 0.0, xy = 0.0, steepness = 0.0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    gx[a] = (y[b] - y[c]) * inverse;
    gy[a] = (x[c] - x[b]) * inverse;
    xx += gx[a] * u[2 * a];
    yy += gy[a] * u[2 * a + 1];
    xy += gy[a] * u[2 * a] + gx[a] * u[2 * a + 1];
    steepness += std::abs(gx[a]) + std::abs(gy[a]);
  }
  const Eigen::Matrix4d& hooke = law.pointwise;
  const double sx = area * (hooke(0, 0) * xx + hooke(0, 1) * yy + hooke(0, 3) * xy),
               sy = area * (hooke(1, 0) * xx + hooke(1, 1) * yy + hooke(1, 3) * xy),
               sxy = area * (hooke(3, 0) * xx + hooke(3, 1) * yy + hooke(3, 3) * xy);
  const double rounded = area * law.normal() * unitRoundoff * steepness * largest, stiff = 0.5 * (law.normal() + hooke(3, 3)) * area;
  for (int a = 0; a < 3; ++a) {
    forces.internal[2 * nodes[a]] += gx[a] * sx + gy[a] * sxy;
    forces.internal[2 * nodes[a] + 1] += gy[a] * sy + gx[a] * sxy;
    forces.rounding[nodes[a]] += rounded * (std::abs(gx[a]) + std::abs(gy[a]));
    forces.stiffness[nodes[a]] += stiff * (gx[a] * gx[a] + gy[a] * gy[a]);
  }
  return true;
}

/// call(n) with the number of an element's nodes as a constant.
template <typename Call>
void forNodes(int nodes, const Call& call) {
  switch (nodes) {
    case 3:
      return call(std::integral_constant<int, 3>());
    case 4:
      return call(std::integral_constant<int, 4>());
    case 6:
      return call(std::integral_constant<int, 6>());
    case 8:
      return call(std::integral_constant<int, 8>());
    case 9:
      return call(std::integral_constant<int, 9>());
    default:
      throw InternalError("an element of " + std::to_string(nodes) + " nodes");
  }
}

}  // namespace

ElementForces elementForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                            const Vector& displacement) {
  ElementForces forces;
  forces.internal = Vector::Zero(displacement.size());
  forces.rounding = forces.stiffness = Vector::Zero(block.nodes());
  const Material* last = nullptr;
  HookesLaw law;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) {
      law = HookesLaw(material, plane);
      last = &material;
    }
    const bool simple = block.cells[e] == Cell::Triangle3 && !block.axisymmetric && law.projected == 0.0;
    if (simple && addTriangle(block, e, law, displacement, forces)) continue;
    const auto add = [&](auto nodes) {
      if (block.axisymmetric)
        addElement<true, nodes()>(block, e, law, displacement, forces);
      else
        addElement<false, nodes()>(block, e, law, displacement, forces);
    };
    forNodes(cellInfo(block.cells[e]).nodes, add);
  }
  return forces;
}

}  // namespace suture
