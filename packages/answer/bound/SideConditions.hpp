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
  /// Conditions on a side at the boundary, or on one of the two triangles of a side with four vertices. \param nodes  of the side or
  /// triangle, in the order of SimplexNodes; -1: the middle of a diagonal
  SideCondition<D> of(int element, int side, const std::vector<int>& nodes) const;
  /// Forces of the loads on a side on its nodes, in the order of SideGeometry.hpp. [force]
  Eigen::Matrix<double, D, Eigen::Dynamic> loadsOn(int element, int side) const;
  /// Energy of the elastic support of a side under the displacements of the elements, as supportEnergy. \param condition  of the side
  double supportEnergyOn(int element, int side, const SideCondition<D>& condition) const;
  /// Contacts (places in BoundaryParts::touching) of which a side is part of side A, and of side B.
  const std::vector<int>& contactsOnA(int element, int side) const { return at(element, side).onA; }
  const std::vector<int>& contactsOnB(int element, int side) const { return at(element, side).onB; }

 private:
  static constexpr int kMostSides = 6;
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
  std::vector<Point> placesOf(const std::vector<int>& nodes) const;
  void hold(SideCondition<D>& own, const OnSide& on, const Point& normal, const std::vector<int>& nodes) const;
  void checkHeld(const Side& side, const SideCondition<D>& own) const;
  void holdAlongNormal(SideCondition<D>& own, unsigned held, const Point& normal, const std::vector<int>& nodes) const;
  void support(SideCondition<D>& own, const OnSide& on, const Point& normal, const std::vector<int>& nodes) const;
  double prescribedAlong(int node, const Point& normal) const;
  static void addTraction(const Load& load, const Point& normal, const std::vector<Point>& places, SideCondition<D>& own);
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
