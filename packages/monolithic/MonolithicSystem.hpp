#pragma once
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/answer/verdict/Balance.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// The whole scene as one system of equations, numbered for one sparse factorisation: K x = f in the free components of the nodal axes,
/// with contact components last and prescribed ones moved to the right-hand side, and contact rows C x <= g in the same unknowns. Pairs
/// whose law restricts sliding have tangential rows in addition to the normal one. Local.
class MonolithicSystem {
 public:
  /// A contact row restricted to its free contact dofs (numbers from 0 among the trailing dofs); a row may have none.
  struct Row {
    std::vector<int> dofs;
    std::vector<double> coefficients;
    double bound = 0.0;           ///< gap (0 along tangents) minus the contribution of prescribed components [length]
    int pair = 0, component = 0;  ///< index of the contact pair; 0: normal, else a tangent (PairFrame)
  };

  MonolithicSystem(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model);

  int dofs() const { return dofs_; }                ///< free dofs
  int contactDofs() const { return contactDofs_; }  ///< trailing dofs, grouped by body
  const SymmetricMatrix& stiffness() const { return stiffness_; }
  const Vector& load() const { return load_; }
  const std::vector<Row>& rows() const { return rows_; }  ///< rows of the contact pairs in their order, one per restricted direction
  double prescribedEnergy() const { return energy_; }     ///< energy when all free dofs are zero
  const Vector& nodalForces() const { return forces_; }   ///< forces of the loads: node-major, Cartesian

  /// Contact component of a trailing dof: node and Cartesian direction.
  struct ContactDof {
    int node;
    Point direction;
  };
  const std::vector<ContactDof>& contactDof() const { return contactDof_; }

  /// Displacement of the whole mesh, node-major and Cartesian, from the free dofs.
  Vector expand(const Vector& x) const;

  /// Components of nodal forces along the free dofs. \param nodal  node-major, Cartesian
  Vector onFree(const Vector& nodal) const;

  /// Internal forces K u of the whole mesh, including prescribed nodes, from stresses at quadrature points instead of stiffness(): the
  /// error for a stiff part in rigid motion is then only the round-off of its strains. Same shape as u.
  Vector internalForces(const Vector& displacement) const;
  /// Adds the forces of elastic supports to a balance, and removes the loads that represent initial strains and stresses.
  void addParts(const Vector& displacement, Balance& balance) const;

 private:
  void number();
  SparseMatrix pattern() const;
  void assemble();
  void assembleWithRigidGroups();
  /// Calls each(unknown, coefficient) for the unknowns on which a component depends: itself if it is free, the masters in a rigid group.
  template <typename Each>
  void forEachUnknown(int node, int k, const Each& each) const {
    if (index_[component(node, k)] >= 0)
      each(index_[component(node, k)], 1.0);
    else
      rigid_.forEachMaster(node, k, [&](int master, int c, double coefficient) { each(index_[component(master, c)], coefficient); });
  }

  int component(int node, int k) const { return node * mesh_.dimension + k; }
  bool isFree(int dof) const { return index_[dof] >= 0; }

  const Mesh& mesh_;
  const Constraints& constraints_;
  const ElasticModel& model_;
  int dofs_ = 0, contactDofs_ = 0;
  std::vector<int> ruleOf_;  // node -> rule or -1
  std::vector<int> index_;   // node-major component in nodal axes -> unknown, or -1 when prescribed
  Vector prescribed_;        // node-major in nodal axes; zero where free
  Vector forces_, load_;
  RigidGroupNodes rigid_;
  double energy_ = 0.0;
  SymmetricMatrix stiffness_;
  std::vector<Row> rows_;
  std::vector<ContactDof> contactDof_;
};

}  // namespace suture
