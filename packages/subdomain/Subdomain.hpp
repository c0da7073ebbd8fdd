#pragma once
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/base/Registry.hpp>
#include <suture/elasticity/ElementForces.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/subdomain/Hint.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// Physics of one subdomain, made by name: `Bodies/<name>/Subdomain`. A user implements doAssemble(), doRigidModes() and doStresses(); this
/// base class numbers unknowns, eliminates prescribed components and finds the kernel. Unknowns are the components of nodal displacements
/// in the axes of the node (those of its NodeRule, else those of the drawn body, turned with it: Cartesian for bodies that stay). All
/// functions are local; the mesh must outlive the subdomain.
class Subdomain {
 public:
  static const char* kind() { return "subdomain"; }
  /// Mesh and model must outlive the subdomain.
  using Maker = std::function<std::unique_ptr<Subdomain>(const SubdomainMesh&, const ElasticModel&, const Parameters& own)>;

  explicit Subdomain(const SubdomainMesh& mesh);
  virtual ~Subdomain() = default;

  /// Assembles stiffness and loads. Call it once, before anything below.
  /// \throws NumericalError  the matrix has the wrong size or a non-positive diagonal. \throws InputError  an elastic support on physics
  /// that do not follow the model
  void assemble();
  /// Reads the current loads of the model and the current values of the mesh's rules; the stiffness is unchanged. After assemble().
  void reload();
  /// reload() for a mesh that rules, pairs and a rigid motion of its body have changed since assemble(): the stiffness is unchanged in axes
  /// that turn with the body. False: it is not, because axes of prescribed components do not turn with it or other components are
  /// prescribed; the subdomain must then be made anew.
  bool rearrange();
  /// Number of times that reload() changed load(): results that depend on the load stay valid while this number is unchanged.
  int loadChanges() const { return loadChanges_; }

  const SubdomainMesh& mesh() const { return mesh_; }
  int components() const { return mesh_.dimension; }

  /// True if stiffness, loads and stresses are those of the materials and loads of the ElasticModel: the verification then computes them
  /// without the subdomain. Otherwise it calls the following functions.
  virtual bool followsModel() const { return false; }
  /// Stresses at element centroids for nodal displacements (node-major, Cartesian): see elementStresses().
  Matrix stresses(const Vector& displacement) const;
  /// K u by the assembled matrix, including prescribed components, with its round-off and the order of the diagonal. After assemble().
  ElementForces internalForces(const Vector& displacement) const;
  /// Nodal loads: node-major, Cartesian [force]. After assemble().
  Vector nodalLoads() const;

  /// Number of free unknowns: those that no rule prescribes.
  int dofs() const { return static_cast<int>(free_.size()); }
  /// Free unknown of a node's component, or -1 if it is prescribed.
  int dof(int node, int component) const { return numberOf_[node * components() + component]; }
  int nodeOf(int dof) const { return free_[dof] / components(); }
  int componentOf(int dof) const { return free_[dof] % components(); }
  /// Number of a free unknown common to all subdomains: node of the mesh x components + component.
  GlobalId globalDof(int dof) const { return mesh_.globalNodes[nodeOf(dof)] * components() + componentOf(dof); }
  /// Unit vector along which a free unknown displaces its node.
  Point direction(int dof) const;

  const SymmetricMatrix& stiffness() const { return stiffness_; }  ///< free x free
  const Vector& load() const { return load_; }                     ///< free: loads minus stiffness times prescribed displacements [force]
  double constantEnergy() const { return constantEnergy_; }  ///< energy of prescribed displacements alone, minus the work of their loads
  /// Hint of this name on the free unknowns; the coarse modes are by default the rigid-body modes. Computed at each call, in time that
  /// grows with the subdomain: call it once, and keep the part on the boundary. \throws NumericalError  the number of its rows is not that
  /// of the unknowns
  Hint hint(const std::string& name) const;
  Matrix rigidModes() const;                              ///< free x all rigid-body modes
  const Matrix& heldModes() const { return heldModes_; }  ///< prescribed components and springs x all rigid-body modes
  /// Null space of stiffness(): modes that vanish at prescribed components, and masters of rigid groups that move no node of an element
  /// here.
  Matrix kernel() const;

  /// Nodal displacements (node-major, Cartesian) from the values of the free unknowns, including prescribed components.
  Vector cartesian(const Vector& freeValues) const;
  /// Values of the free unknowns from nodal displacements.
  Vector freeValues(const Vector& cartesian) const;
  /// Adds resultants in Cartesian components [force]: of the loads, of the reactions K u - f at prescribed components, and the sum of the
  /// absolute values of both, from which the round-off of a resultant is estimated.
  void resultants(const Vector& freeValues, Point& applied, Point& reactions, double& absoluteForces) const;

 protected:
  /// Stiffness matrix and loads over ALL unknowns: nodes x components, in the axes of the nodes (see toAxes()). Only the lower triangle of
  /// the symmetric matrix is read; compressed, rows ascending in each column.
  virtual void doAssemble(SparseMatrix& stiffness, Vector& load) = 0;
  /// Optional: only the loads of doAssemble(), for load steps.
  virtual Vector doLoad();
  /// elements x 4 (xx, yy, zz, xy; in 3D x 6, also yz, xz), tension positive, at centroids; `displacement`: node-major, Cartesian. [stress]
  virtual Matrix doStresses(const Vector& displacement) const = 0;
  /// All rigid-body modes over ALL unknowns, columns of the order of one, in the axes of the nodes.
  virtual Matrix doRigidModes() const = 0;
  /// Optional data over ALL unknowns, in the axes of the nodes, by the names in Hint or others.
  virtual Hint doHint(const std::string& name) const { return (void)name, Hint(); }

  /// Q of a node, or null if its axes are Cartesian.
  const Matrix* axes(int node) const { return axes_.empty() || axesOfNode_[node] < 0 ? nullptr : &axes_[axesOfNode_[node]]; }
  /// Rotates the rows of nodal vectors (node-major) from Cartesian components to the axes of the nodes, in place.
  void toAxes(LocalView values) const;
  /// Sum of element matrices, rotated into the axes of the nodes: the stiffness for doAssemble().
  /// \param elements  calls its argument with the matrix of every element in turn, Cartesian, node-major: see elementStiffnesses()
  SparseMatrix assembled(const std::function<void(const std::function<void(int element, ConstLocalView stiffness)>& take)>& elements) const;

 private:
  void takeAxes();
  Matrix onDrawn(const NodeRule& rule) const;
  void findFreeMotions();
  void takePrescribed();
  void expandRigidGroups();
  Matrix idleMasters() const;
  /// All unknowns, in the axes of the nodes, from the free ones.
  Vector expanded(const Vector& freeValues) const;
  void liftLoad();
  Matrix springModes(const Matrix& modes) const;
  Vector inAxes(const Vector& cartesian) const;
  Vector outOfAxes(Vector values) const;

  const SubdomainMesh& mesh_;
  std::vector<int> numberOf_, free_, fixed_;
  std::vector<int> axesOfNode_;  // empty if all axes are Cartesian
  std::vector<Matrix> axes_;
  Matrix turn_;                    // rotation of the body since it was drawn
  std::vector<NodeRule> rules_;    // with which the stiffness was assembled, their axes turned back into the drawn body; with motion only
  std::vector<double> followers_;  // coefficients of rigid groups; likewise
  Vector prescribed_;              // all unknowns; zero where free
  SymmetricMatrix stiffness_;
  SparseMatrix held_;       // all unknowns x prescribed components
  SparseMatrix expansion_;  // all unknowns x free ones; no rows if there are no rigid groups: each unknown is free or prescribed
  SymmetricMatrix whole_;   // stiffness of all unknowns, only kept with rigid groups
  Vector fullLoad_, load_;
  double constantEnergy_ = 0.0;
  int loadChanges_ = 0;
  Matrix heldModes_, freeMotions_;  // rigid-body modes at prescribed components and springs, and combinations of them that vanish there
};

void registerBuiltIns(Registry<Subdomain>& registry);

}  // namespace suture
