#pragma once
#include <suture/answer/bound/BoundElements.hpp>
#include <suture/constraints/BoundaryParts.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Loads, supports and contacts on the sides of the elements of a subdomain, as an error bound needs them: the given components of the
/// traction, and those that are unknown because displacements are prescribed. Local.
template <int D>
class SideConditions {
 public:
  /// \param parts         of the scene \param displacement  of the mesh, node-major, Cartesian [length]
  /// \param reasons       receives why a bound is not strict. All arguments must outlive this object
  SideConditions(const SubdomainMesh& mesh, const ElasticModel& model, const BoundaryParts& parts, const Vector& displacement,
                 std::set<std::string>& reasons);

  /// True for a side that two elements share, also with another subdomain.
  bool isInner(int element, int side) const { return inner_[std::size_t(element) * kMostSides + side] != 0; }
  /// Conditions on a side at the boundary. \param nodes  of the side, in the order of SimplexNodes
  SideCondition<D> of(int element, int side, const std::vector<int>& nodes) const;
  /// Contacts (places in BoundaryParts::touching) of which a side is part of side A, and of side B.
  const std::vector<int>& contactsOnA(int element, int side) const { return at(element, side).onA; }
  const std::vector<int>& contactsOnB(int element, int side) const { return at(element, side).onB; }

 private:
  static constexpr int kMostSides = 4;
  /// Places in BoundaryParts, and loads.
  struct OnSide {
    std::vector<const Load*> loads;
    std::vector<int> held, onA, onB;
    double normalStiffness = 0.0, tangentialStiffness = 0.0;  // elastic supports
    bool isRigid = false, onMean = false;
  };
  void collect();
  void findInner();
  const OnSide& at(int element, int side) const;
  void hold(SideCondition<D>& own, const OnSide& on, const Point& normal, const std::vector<int>& nodes) const;
  void holdAlongNormal(SideCondition<D>& own, unsigned held, const Point& normal, const std::vector<int>& nodes) const;
  void support(SideCondition<D>& own, const OnSide& on, const Point& normal, const std::vector<int>& nodes) const;
  double prescribedAlong(int node, const Point& normal) const;
  void addTraction(const Load& load, const Point& normal, const std::vector<int>& nodes, SideCondition<D>& own) const;
  void remark(const char* reason) const { reasons_.insert(reason); }

  const SubdomainMesh& mesh_;
  const ElasticModel& model_;
  const BoundaryParts& parts_;
  const Vector& displacement_;
  std::set<std::string>& reasons_;
  std::map<std::pair<int, int>, OnSide> sides_;  // by element and side
  std::vector<char> inner_;
  double largest_ = 0.0;  // displacement component
};

}  // namespace suture
