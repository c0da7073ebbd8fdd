#pragma once
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/base/Registry.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/ElementForces.hpp>
#include <suture/subdomain/Hint.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// The physics of one subdomain, made by name: `Bodies/<name>/Subdomain`. A user writes doAssemble(), doRigidModes() and doStresses(); the
/// shell numbers unknowns, takes prescribed components out and finds the kernel. Unknowns are the components of nodal displacements in the
/// axes of the node (Cartesian, or those of its NodeRule). All functions are local; the mesh must outlive the subdomain.
class Subdomain {
 public:
  static const char* kind() { return "subdomain"; }
  /// The mesh and the model outlive what is made.
  using Maker = std::function<std::unique_ptr<Subdomain>(const SubdomainMesh&, const ElasticModel&, const Parameters& own)>;

  explicit Subdomain(const SubdomainMesh& mesh);
  virtual ~Subdomain() = default;

  /// Assembles stiffness and loads. Call it once, before anything below.
  /// \throws NumericalError  the matrix has the wrong size or a non-positive diagonal. \throws InputError  an elastic support on physics
  /// that do not follow the model
  void assemble();
  /// Takes the loads of the model and the values of the mesh's rules as they are now; the stiffness stays. After assemble().
  void reload();
  /// Number of times that reload() changed load(): whoever keeps what follows from it need not find it anew where that stays.
  int loadChanges() const { return loadChanges_; }

  const SubdomainMesh& mesh() const { return mesh_; }
  int components() const { return mesh_.dimension; }

  /// True if stiffness, loads and stresses are those of the materials and loads of the ElasticModel: whoever judges an answer may then
  /// find them without the subdomain. Of all others it asks what follows.
  virtual bool followsModel() const { return false; }
  /// Stresses at element centroids for nodal displacements (node-major, Cartesian): see elementStresses().
  Matrix stresses(const Vector& displacement) const;
  /// K u by the assembled matrix, prescribed components included, with its rounding and the order of the diagonal. After assemble().
  ElementForces internalForces(const Vector& displacement) const;
  /// Nodal loads: node-major, Cartesian [force]. After assemble().
  Vector nodalLoads() const;

  /// Free unknowns: those that no rule prescribes.
  int dofs() const { return static_cast<int>(free_.size()); }
  /// Free unknown of a node's component, or -1 if it is prescribed.
  int dof(int node, int component) const { return numberOf_[node * components() + component]; }
  int nodeOf(int dof) const { return free_[dof] / components(); }
  int componentOf(int dof) const { return free_[dof] % components(); }
  /// Number of a free unknown that all subdomains agree on: node of the mesh x components + component.
  GlobalId globalDof(int dof) const { return mesh_.globalNodes[nodeOf(dof)] * components() + componentOf(dof); }
  /// Unit vector along which a free unknown displaces its node.
  Point direction(int dof) const;

  const SymmetricMatrix& stiffness() const { return stiffness_; }  ///< free x free
  const Vector& load() const { return load_; }               ///< free: loads less the stiffness times prescribed displacements [force]
  double constantEnergy() const { return constantEnergy_; }  ///< energy of prescribed displacements alone, less their loads' work
  /// The hint of this name on the free unknowns; of the coarse modes the rigid ones, if the subdomain knows no others. Found anew at each
  /// call, in time that grows with the subdomain: ask once, and keep what belongs to the boundary. \throws NumericalError  it has not a row
  /// for every unknown
  Hint hint(const std::string& name) const;
  Matrix rigidModes() const;                                     ///< free x all rigid modes
  const Matrix& heldModes() const { return heldModes_; }         ///< prescribed components and springs x all rigid modes
  Matrix kernel() const { return rigidModes() * freeMotions_; }  ///< null space of stiffness(): the modes that vanish where prescribed

  /// Nodal displacements (node-major, Cartesian) of the free unknowns' values; prescribed ones filled in.
  Vector cartesian(const Vector& freeValues) const;
  /// Free unknowns' values of nodal displacements.
  Vector freeValues(const Vector& cartesian) const;
  /// Adds resultants in Cartesian components [force]: of the loads, of the reactions K u - f at prescribed components, and the sum of the
  /// absolute values of both, which says how large a resultant of rounding may be.
  void resultants(const Vector& freeValues, Point& applied, Point& reactions, double& absoluteForces) const;

 protected:
  /// Stiffness matrix and loads over ALL unknowns: nodes x components, in the axes of the nodes (see toAxes()). Of the matrix, which is
  /// symmetric, the lower triangle is read; compressed, rows ascending in each column.
  virtual void doAssemble(SparseMatrix& stiffness, Vector& load) = 0;
  /// Optional: the loads of doAssemble() alone, for load steps.
  virtual Vector doLoad();
  /// elements x 4 (xx, yy, zz, xy), tension positive, at centroids; `displacement`: node-major, Cartesian. [stress]
  virtual Matrix doStresses(const Vector& displacement) const = 0;
  /// All rigid modes over ALL unknowns, columns of the order of one, in the axes of the nodes.
  virtual Matrix doRigidModes() const = 0;
  /// Optional data over ALL unknowns, in the axes of the nodes, by the names in Hint or others.
  virtual Hint doHint(const std::string& name) const { return (void)name, Hint(); }

  /// Q of a node, or null when its axes are Cartesian.
  const Matrix* axes(int node) const { return axes_.empty() || axesOfNode_[node] < 0 ? nullptr : &axes_[axesOfNode_[node]]; }
  /// Rows of nodal vectors (node-major) from Cartesian components to those of the nodes' axes, in place.
  void toAxes(LocalView values) const;
  /// The sum of element matrices, turned into the axes of the nodes: what doAssemble() gives as stiffness.
  /// \param elements  calls what it is given with the matrix of every element in turn, Cartesian, node-major: see elementStiffnesses()
  SparseMatrix assembled(const std::function<void(const std::function<void(int element, ConstLocalView stiffness)>& take)>& elements) const;

 private:
  void takePrescribed();
  void liftLoad();
  Matrix springModes(const Matrix& modes) const;
  Vector inAxes(const Vector& cartesian) const;
  Vector outOfAxes(Vector values) const;

  const SubdomainMesh& mesh_;
  std::vector<int> numberOf_, free_, fixed_;
  std::vector<int> axesOfNode_;  // empty where all axes are Cartesian
  std::vector<Matrix> axes_;
  Vector prescribed_;  // all unknowns; zero where free
  SymmetricMatrix stiffness_;
  SparseMatrix held_;  // all unknowns x prescribed components
  Vector fullLoad_, load_;
  double constantEnergy_ = 0.0;
  int loadChanges_ = 0;
  Matrix heldModes_, freeMotions_;  // rigid modes where prescribed or on springs, and combinations of them that vanish there
};

void registerBuiltIns(Registry<Subdomain>& registry);

}  // namespace suture
