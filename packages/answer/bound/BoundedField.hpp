#pragma once
#include <suture/answer/bound/BodySources.hpp>
#include <suture/answer/bound/ErrorBound.hpp>
#include <suture/answer/bound/SimplexLaw.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace suture {

/// An element as simplices, and what its displacement differs from that of the simplices.
template <int D>
struct SplitElement {
  std::vector<BoundElement<D>> simplices;  ///< without conditions at the boundary
  double interpolation = 0.0;              ///< BoundParts::interpolation [energy]
  double square = 0.0;                     ///< a(u_h, u_h) [energy]
  double energyOfForm = 0.0;               ///< BoundParts::energyOfForm [energy]
  double uncertainty = 0.0;                ///< by how much `interpolation` may be too large [energy]
};

/// The solution on a subdomain as its elements have it, and their materials and body forces. Local.
template <int D>
class BoundedField {
 public:
  using Forces = Eigen::Matrix<double, D, Eigen::Dynamic, 0, D, mostNodes<D>>;

  /// All arguments must outlive this object. \param m  subdomain of this rank \param reasons  receives why a bound is not strict
  BoundedField(const BoundedSolution& solution, int m, const BoundKind& kind, std::set<std::string>& reasons);

  const SubdomainMesh& mesh() const { return mesh_; }
  const BoundKind& kind() const { return kind_; }
  BodySources<D>& sources() { return sources_; }
  void remark(const std::string& reason) { reasons_.insert(reason); }
  const Vector& displacement() const { return displacement_; }
  /// The displacement with the correction of the solver: the forces of its elements are in balance.
  const Vector& balanced() const { return isCorrected() ? balanced_ : displacement_; }
  bool isCorrected() const { return balanced_.size() > 0; }
  const InitialState& initial() const { return initial_; }

  const SimplexLaw<D>& lawOf(int element);
  /// Values of a nodal vector at the nodes of an element.
  Forces nodalOf(int element, const Vector& values) const;
  /// Forces of an element on its nodes, by its form and the quadrature of its stiffness. \param initial  of the mesh, or none
  Forces forcesOf(int element, const Vector& displacement, const InitialState& initial, const SimplexLaw<D>& law) const;
  /// Stress of an element in 3D by its form, fitted linearly, about its centroid; with cells of order 1 without derivatives.
  LinearStress linearStressOf(int element, const SimplexLaw<D>& law, Eigen::Vector3d& centroid) const;
  /// Adds the initial stress of an element to that of one of its simplices.
  void addInitialStress(int element, const SimplexLaw<D>& law, BoundElement<D>& simplex) const;

 private:
  const BoundedSolution& solution_;
  const SubdomainMesh& mesh_;
  BoundKind kind_;
  std::set<std::string>& reasons_;
  const Vector& displacement_;
  Vector balanced_;  // empty: as the displacement
  InitialState initial_;
  BodySources<D> sources_;
  std::map<const Material*, std::unique_ptr<SimplexLaw<D>>> laws_;
  const Material* lastMaterial_ = nullptr;
  const SimplexLaw<D>* lastLaw_ = nullptr;
  bool lastIsMixed_ = false;
};

}  // namespace suture
