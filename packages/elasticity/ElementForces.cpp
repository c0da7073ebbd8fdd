#include <suture/base/Errors.hpp>
#include <suture/elasticity/Coatings.hpp>
#include <suture/elasticity/ElementForces.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/EnhancedModes.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>
#include <suture/elasticity/NodeCounts.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace suture {

namespace {

/// Displacements minus those of the first node, in components where translations are free of energy. Returns the largest input value.
template <int D, bool hoop, int count>
double localDisplacement(const int* nodes, const Vector& displacement, double* u) {
  double first[D];
  for (int k = 0; k < D; ++k) first[k] = hoop && k == 0 ? 0.0 : displacement[D * nodes[0] + k];
  double largest = 0.0;
  for (int a = 0; a < count; ++a)
    for (int k = 0; k < D; ++k) {
      const double value = displacement[D * nodes[a] + k];
      u[D * a + k] = value - first[k];
      largest = std::max(largest, std::abs(value));
    }
  return largest;
}

/// Strain as scalars, so that the components stay in registers.
struct Strain {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, yz = 0.0, xz = 0.0;
  double steepness = 0.0;  ///< sum of the magnitudes of the gradients' components

  /// Adds another strain.
  void add(const StressVector<2>& e) { xx += e[0], yy += e[1], zz += e[2], xy += e[3]; }
  void add(const StressVector<3>& e) { xx += e[0], yy += e[1], zz += e[2], xy += e[3], yz += e[4], xz += e[5]; }

  /// Adds the contribution of a node's displacement.
  template <int D>
  void add(const double* gradient, const double* u) {
    const double ux = u[0], uy = u[1], gx = gradient[0], gy = gradient[1];
    xx += gx * ux;
    yy += gy * uy;
    xy += gy * ux + gx * uy;
    steepness += std::abs(gx) + std::abs(gy);
    if constexpr (D == 3) {
      const double uz = u[2], gz = gradient[2];
      zz += gz * uz;
      yz += gz * uy + gy * uz;
      xz += gz * ux + gx * uz;
      steepness += std::abs(gz);
    }
  }
};

/// Sum of the magnitudes of a gradient's components, and sum of their squares.
template <int D>
double slopeOf(const double* g) {
  const double plane = std::abs(g[0]) + std::abs(g[1]);
  if constexpr (D == 2) return plane;
  return plane + std::abs(g[D - 1]);
}
template <int D>
double squaresOf(const double* g) {
  const double plane = g[0] * g[0] + g[1] * g[1];
  if constexpr (D == 2) return plane;
  return plane + g[D - 1] * g[D - 1];
}

/// Mean stiffness of a node along the axes, divided by its squared gradient.
template <int D>
double meanStiffness(const HookesLaw<D>& law) {
  return (law.normal() + (D - 1) * law.pointwise.diagonal().template tail<stressComponents<D> - 3>().maxCoeff()) / D;
}

/// Sum over the axes of twice the energies of unit displacements of one node. \param h  hoop strain of the radial displacement
double stiffnessAt(const StressMatrix<2>& c, const double* g, double h) {
  const double x = g[0], y = g[1];
  return (c(0, 0) + c(3, 3)) * x * x + (c(1, 1) + c(3, 3)) * y * y + 2 * (c(0, 3) + c(1, 3)) * x * y +
         (c(2, 2) * h + 2 * (c(0, 2) * x + c(2, 3) * y)) * h;
}

double stiffnessAt(const StressMatrix<3>& c, const double* g, double) {
  const double x = g[0], y = g[1], z = g[2];
  return (c(0, 0) + c(3, 3) + c(5, 5)) * x * x + (c(1, 1) + c(3, 3) + c(4, 4)) * y * y + (c(2, 2) + c(4, 4) + c(5, 5)) * z * z +
         2 * ((c(0, 3) + c(1, 3) + c(4, 5)) * x * y + (c(1, 4) + c(2, 4) + c(3, 5)) * y * z + (c(0, 5) + c(2, 5) + c(3, 4)) * x * z);
}

/// Enhanced strain of an element; adds the mean stiffness of each node. \param map  is left at the last point of the rule
template <int D>
EnhancedStrain<D> enhancedStrain(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw<D>& law,
                                 const double* u, ElementMap<D>& map, Vector& stiffness) {
  using Modes = EnhancedModes<D>;
  Modes modes(block, element, reference, map);
  double sums[Modes::nodes] = {};
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    modes.add(map);
    for (int a = 0; a < Modes::nodes; ++a)
      sums[a] += map.measure() * stiffnessAt(law.pointwise, map.gradient(a), block.axisymmetric ? map.hoop(a) : 0.0);
  }
  modes.close(law.pointwise);
  const auto softening = modes.softening();
  const int* nodes = block.nodesOf(element).begin();
  for (int a = 0; a < Modes::nodes; ++a) stiffness[nodes[a]] += (sums[a] - softening.template segment<D>(D * a).sum()) / D;
  return modes.strainOf(Eigen::Map<const Eigen::Matrix<double, D * Modes::nodes, 1>>(u));
}

/// \tparam count  number of nodes of the element, so that the compiler unrolls the loops
template <int D, bool hoop, int count>
void addElement(const CellBlock& block, int element, const HookesLaw<D>& law, const Vector& displacement, ElementForces& forces) {
  const ReferenceElement& reference = stiffnessElement(block, element);
  const int* nodes = block.nodesOf(element).begin();
  double u[D * count];
  const double largest = localDisplacement<D, hoop, count>(nodes, displacement, u);
  ElementMap<D> map(block, element, reference);
  std::optional<MixedPressure<D>> pressure;
  if (law.projected != 0.0) pressure.emplace(block.cells[element], reference, map);
  std::optional<EnhancedStrain<D>> enhanced;
  if constexpr (count == EnhancedModes<D>::nodes)
    if (law.enhanced) enhanced = enhancedStrain<D>(block, element, reference, law, u, map, forces.stiffness);
  const double stiffest = law.normal() + law.projected, stiff = enhanced ? 0.0 : meanStiffness(law);
  for (int a = 0; pressure && a < count; ++a) {
    double sum = 0.0;
    for (int k = 0; k < D; ++k) sum += pressure->diagonal(D * a + k);
    forces.stiffness[nodes[a]] += law.projected * sum / D;
  }
  for (int q = 0; q < reference.points; ++q) {
    map.at(q);
    Strain e;
    for (int a = 0; a < count; ++a) {
      e.add<D>(map.gradient(a), u + D * a);
      if constexpr (hoop) {
        e.zz += map.hoop(a) * u[D * a];
        e.steepness += map.hoop(a);
      }
    }
    if (enhanced) e.add(enhanced->at(map));
    StressVector<D> stress = law.pointwise.col(0) * e.xx + law.pointwise.col(1) * e.yy + law.pointwise.col(3) * e.xy;
    if constexpr (hoop || D == 3) stress += law.pointwise.col(2) * e.zz;
    if constexpr (D == 3) stress += law.pointwise.col(4) * e.yz + law.pointwise.col(5) * e.xz;
    if (pressure)
      stress.template head<3>().array() +=
          law.projected * pressure->dilatation(Eigen::Map<const Eigen::Matrix<double, D * count, 1>>(u), map.place());
    stress *= map.measure();
    const double rounded = map.measure() * stiffest * unitRoundoff * e.steepness * largest;
    for (int a = 0; a < count; ++a) {
      const double* g = map.gradient(a);
      Eigen::Matrix<double, D, 1> force = forceOfStress<D>(g, stress);
      double slope = slopeOf<D>(g), squares = squaresOf<D>(g);
      if constexpr (hoop) {
        const double h = map.hoop(a);
        force[0] += h * stress[2];
        slope += h;
        squares += h * h;
      }
      for (int k = 0; k < D; ++k) forces.internal[D * nodes[a] + k] += force[k];
      forces.rounding[nodes[a]] += rounded * slope;
      forces.stiffness[nodes[a]] += stiff * map.measure() * squares;
    }
  }
}

/// Gradients of the shape functions of a linear simplex. Returns its size; zero or negative if it is folded.
double simplexGradients(const CellBlock& block, const int* nodes, double (&g)[3][2]) {
  double x[3], y[3];
  for (int a = 0; a < 3; ++a) {
    x[a] = block.coordinates[std::size_t(nodes[a]) * 2];
    y[a] = block.coordinates[std::size_t(nodes[a]) * 2 + 1];
  }
  const double twice = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]), inverse = 1.0 / twice;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    g[a][0] = (y[b] - y[c]) * inverse;
    g[a][1] = (x[c] - x[b]) * inverse;
  }
  return 0.5 * twice;
}

double simplexGradients(const CellBlock& block, const int* nodes, double (&g)[4][3]) {
  Point edges[3];
  const Point first = block.point(nodes[0]);
  for (int a = 0; a < 3; ++a) edges[a] = minus(block.point(nodes[a + 1]), first);
  const double sixfold = dot(edges[0], cross(edges[1], edges[2])), inverse = 1.0 / sixfold;
  for (int k = 0; k < 3; ++k) g[0][k] = 0.0;
  for (int a = 0; a < 3; ++a) {
    const Point normal = cross(edges[(a + 1) % 3], edges[(a + 2) % 3]);
    for (int k = 0; k < 3; ++k) {
      g[a + 1][k] = normal[k] * inverse;
      g[0][k] -= g[a + 1][k];
    }
  }
  return sixfold / 6.0;
}

/// Adds a linear 2D triangle or a linear tetrahedron: the strain is constant, and most elements of large meshes take two thirds of the
/// instructions. False if it is folded, which addElement() reports.
template <int D>
bool addSimplex(const CellBlock& block, int element, const HookesLaw<D>& law, const Vector& displacement, ElementForces& forces) {
  const int* nodes = block.nodesOf(element).begin();
  double u[D * (D + 1)], g[D + 1][D];
  const double largest = localDisplacement<D, false, D + 1>(nodes, displacement, u), size = simplexGradients(block, nodes, g);
  if (!(size > 0.0)) return false;
  Strain e;
  for (int a = 0; a <= D; ++a) e.add<D>(g[a], u + D * a);
  StressVector<D> stress = law.pointwise.col(0) * e.xx + law.pointwise.col(1) * e.yy + law.pointwise.col(3) * e.xy;
  if constexpr (D == 3) stress += law.pointwise.col(2) * e.zz + law.pointwise.col(4) * e.yz + law.pointwise.col(5) * e.xz;
  stress *= size;
  const double rounded = size * law.normal() * unitRoundoff * e.steepness * largest, stiff = meanStiffness(law) * size;
  for (int a = 0; a <= D; ++a) {
    const Eigen::Matrix<double, D, 1> force = forceOfStress<D>(g[a], stress);
    for (int k = 0; k < D; ++k) forces.internal[D * nodes[a] + k] += force[k];
    forces.rounding[nodes[a]] += rounded * slopeOf<D>(g[a]);
    forces.stiffness[nodes[a]] += stiff * squaresOf<D>(g[a]);
  }
  return true;
}

template <int D>
ElementForces forcesOf(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement) {
  ElementForces forces;
  forces.internal = Vector::Zero(displacement.size());
  forces.rounding = forces.stiffness = Vector::Zero(block.nodes());
  constexpr Cell simplex = D == 2 ? Cell::Triangle3 : Cell::Tetrahedron4;
  const Material* last = nullptr;
  std::optional<Cell> lastCell;
  HookesLaw<D> law;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last || block.cells[e] != lastCell) {
      law = HookesLaw<D>(material, plane).of(block.cells[e]);
      last = &material;
      lastCell = block.cells[e];
    }
    const bool simple = block.cells[e] == simplex && !block.axisymmetric && law.projected == 0.0;
    if (simple && addSimplex<D>(block, e, law, displacement, forces)) continue;
    forNodes<D>(cellInfo(block.cells[e]).nodes, [&](auto nodes) {
      if (D == 2 && block.axisymmetric)
        addElement<D, D == 2, nodes()>(block, e, law, displacement, forces);
      else
        addElement<D, false, nodes()>(block, e, law, displacement, forces);
    });
  }
  return forces;
}

}  // namespace

ElementForces elementForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                            const Vector& displacement) {
  ElementForces forces =
      block.dimension == 2 ? forcesOf<2>(block, materialOf, plane, displacement) : forcesOf<3>(block, materialOf, plane, displacement);
  addCoatingForces(block, displacement, forces);
  return forces;
}

}  // namespace suture
