#pragma once
#include <suture/answer/bound/StarMesh.hpp>

#include <optional>

namespace suture {

/// Complementary energy of the elastic support of a side, integral of |t + k v|^2 / k, t the traction without loads, as a quadratic form of
/// the nodal tractions of the side: energy + 2 x.product + x.gram x for their change x.
struct SupportForm {
  Matrix gram;
  Vector product;
  double energy = 0.0;
};

/// None if the side has no elastic support. Local. \param tractions  nodal tractions on the body [stress]
template <int D>
std::optional<SupportForm> supportForm(const StarMesh<D>& mesh, int side, const Vector& tractions);

/// Adds the forms of the sides of a simplex to the quadratic form of its data. Returns the energy of the data. Local.
/// \param data     tractions of the sides, then more (StressElement) [stress]
/// \param gram     receives the matrix of the form \param product  receives that matrix times the deviation of the data
template <int D>
double addSupports(const StarMesh<D>& mesh, int e, const Vector& data, Matrix& gram, Vector& product);

/// Energy of displacements of the nodes of a side on its elastic support: integral of k v^2. Local.
/// \param size  of the side \param moved  displacements at its nodes [length]
template <int D>
double supportEnergy(const SideCondition<D>& side, int degree, double size, const Eigen::Matrix<double, D, 6>& moved);

}  // namespace suture
