#pragma once
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/quality/Balance.hpp>

#include <vector>

namespace suture {

/// The whole scene as one system of equations, numbered for one sparse factorisation: K x = f in the free components of the nodal axes,
/// contact components last, prescribed ones moved to the right-hand side; and the contact rows C x <= g in the same unknowns.
/// Pairs whose law restricts sliding have rows along their tangents beside the normal one. Local.
class MonolithicSystem {
 public:
  /// A contact row restricted to its free contact dofs (numbers from 0 among the trailing dofs); a row may have none.
  struct Row {
    std::vector<int> dofs;
    std::vector<double> coefficients;
    double bound = 0.0;           ///< gap (0 along tangents) minus what the prescribed components contribute [length]
    int pair = 0, component = 0;  ///< place of the contact pair; 0: along its normal, else along a tangent (PairFrame)
  };

  MonolithicSystem(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model);

  int dofs() const { return dofs_; }                ///< free ones
  int contactDofs() const { return contactDofs_; }  ///< the last of them, grouped by body
  const SymmetricMatrix& stiffness() const { return stiffness_; }
  const Vector& load() const { return load_; }
  const std::vector<Row>& rows() const { return rows_; }  ///< rows of the contact pairs in their order, as many as their laws restrict
  double prescribedEnergy() const { return energy_; }     ///< energy when all free dofs are zero
  const Vector& nodalForces() const { return forces_; }   ///< forces of the loads: node-major, Cartesian

  /// The contact component that stands at each trailing dof: node and Cartesian direction.
  struct ContactDof {
    int node;
    Point direction;
  };
  const std::vector<ContactDof>& contactDof() const { return contactDof_; }

  /// Displacement of the whole mesh, node-major and Cartesian, from the free dofs.
  Vector expand(const Vector& x) const;

  /// Components of nodal forces along the free dofs. \param nodal  node-major, Cartesian
  Vector onFree(const Vector& nodal) const;

  /// Internal forces K u of the whole mesh, prescribed nodes included; from stresses at quadrature points, not with stiffness(): a stiff
  /// part that moves rigidly answers with the rounding of its strains only. Same shape as u.
  Vector internalForces(const Vector& displacement) const;
  /// Adds the forces of elastic supports to a balance, and takes out of it the loads that stand for initial strains and stresses.
  void addParts(const Vector& displacement, Balance& balance) const;

 private:
  void number();
  SparseMatrix pattern() const;
  void assemble();

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
  double energy_ = 0.0;
  SymmetricMatrix stiffness_;
  std::vector<Row> rows_;
  std::vector<ContactDof> contactDof_;
};

}  // namespace suture
