#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// Squares of the norms of an error and of the exact solution: sum over elements and ranks first, then take the root.
struct SquaredNorms {
  double error = 0.0, exact = 0.0;
  void add(const SquaredNorms& other) { error += other.error, exact += other.exact; }
};

/// Errors of a body's displacement against its exact fields (zero for a field that is not given). Local.
struct BodyErrors {
  SquaredNorms displacement;  ///< integral of |u_h - u|^2 [2D: length^4, 3D: length^5]
  SquaredNorms energy;        ///< integral of (s_h - s) : C (s_h - s), C the compliance of each element's material [force length]
};

/// \param displacement  node-major, Cartesian. Integrated with Rule::Data. \throws InputError  if an expression is not finite (names the
/// position)
BodyErrors bodyErrors(const CellBlock& block, const ExactFields& exact, const std::function<const Material&(int element)>& materialOf,
                      PlaneModel plane, const Vector& displacement, const InitialState& initial = InitialState());

/// Integrals of products of the shape functions of a side, with nodes in the order of SideGeometry.hpp [length or area]; axisymmetric: over
/// the revolved side [area]. Local.
Matrix sideMass(const std::vector<Point>& nodes, int dimension, bool axisymmetric = false);

/// Integral of (sum of values times shape functions - exact)^2 over a side. Local.
SquaredNorms sideErrors(const std::vector<Point>& nodes, int dimension, const Vector& values, const Expression& exact,
                        bool axisymmetric = false);

}  // namespace suture
