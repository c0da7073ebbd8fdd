#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <set>
#include <string>
#include <vector>

namespace suture {

/// Body forces of a subdomain: polynomial sources of simplices, and the forces that the elements of the solution have in their place.
/// Local.
template <int D>
class BodySources {
 public:
  using Place = Eigen::Matrix<double, D, 1>;

  /// All arguments must outlive this object. \param reasons  receives why a bound is not strict
  BodySources(const SubdomainMesh& mesh, const ElasticModel& model, const BoundKind& kind, std::set<std::string>& reasons);

  bool empty() const { return loads_.empty(); }
  /// Body force of an element at a place. [force / volume]
  Place at(int element, const Place& place) const;
  /// Subtracts the forces of the loads on the nodes of an element. \param nodes  of the mesh at the columns of `forces`
  template <typename Forces>
  void subtractForces(int element, const int* nodes, int count, Forces& forces);
  /// Sets the sources of a simplex of an element, which has places and a compliance. Returns the square of the estimated effect of what is
  /// no polynomial of the degree of the sources. [energy] \param volume  of the simplex
  double setSources(int element, double volume, BoundElement<D>& simplex);

 private:
  void addForces(int element);

  const SubdomainMesh& mesh_;
  const ElasticModel& model_;
  BoundKind kind_;
  std::set<std::string>& reasons_;
  std::vector<const Load*> loads_;
  Vector scratch_;  // nodal forces, zero between calls
};

template <int D>
template <typename Forces>
void BodySources<D>::subtractForces(int element, const int* nodes, int count, Forces& forces) {
  if (loads_.empty()) return;
  addForces(element);
  for (int i = 0; i < count; ++i) {
    forces.col(i) -= scratch_.template segment<D>(D * Eigen::Index(nodes[i]));
    scratch_.template segment<D>(D * Eigen::Index(nodes[i])).setZero();
  }
}

}  // namespace suture
