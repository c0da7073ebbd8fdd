#pragma once
#include <suture/answer/bound/StarMesh.hpp>

namespace suture {

/// Adds the complementary energy of the elastic supports on the sides of a simplex, integral of |t + k v|^2 / k over them, t the traction
/// without loads, to the quadratic form of its data. Returns the energy of the data. Local.
/// \param data     tractions of the sides, then more (StressElement) [stress]
/// \param gram     receives the matrix of the form \param product  receives that matrix times the deviation of the data
template <int D>
double addSupports(const StarMesh<D>& mesh, int e, const Vector& data, Matrix& gram, Vector& product);

/// Energy of displacements of the nodes of a side on its elastic support: integral of k v^2. Local.
/// \param size  of the side \param moved  displacements at its nodes [length]
template <int D>
double supportEnergy(const SideCondition<D>& side, int degree, double size, const Eigen::Matrix<double, D, 6>& moved);

}  // namespace suture
