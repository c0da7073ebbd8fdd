#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Auxiliary supports of bodies that only prescribed mean displacements hold.
///
/// Solvers know the uniform traction of a mean displacement as a load of given size, and cannot solve a scene in which a body is free to
/// move. Therefore one node for each such mean is held along the axis of the mean. Its displacement and the force of the mean are sought
/// (LoadControl) such that the mean has its value and the auxiliary support carries no force: the solution is that without auxiliary
/// supports, which the verdict no longer has.
class MeanSupports {
 public:
  struct Held {
    int load = -1;       ///< mean displacement, index in ElasticModel::loads
    int component = 0;   ///< axis
    int body = -1;       ///< body that the node belongs to
    GlobalId node = -1;  ///< node, numbered as in the mesh
  };

  /// Where auxiliary supports are added.
  enum class Where {
    Needed,     ///< nowhere if the scene has a solution without its means
    Everywhere  ///< at all bodies that prescribed displacements and elastic supports do not hold completely
  };

  /// Checks that the scene has a solution, and finds its auxiliary supports. Nodes are chosen whose displacement equals the mean as closely
  /// as possible if the body is rigid. Collective. \param mesh, constraints  on rank 0 \param model  with resolved loads \param
  /// bodiesAreConnected  as for freeRigidMotions() \throws InputError  as checkSolvability(); no node is free along the axis of a mean
  static MeanSupports find(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                           bool bodiesAreConnected, Where where = Where::Needed);

  bool empty() const { return all_.empty(); }
  const std::vector<Held>& all() const { return all_; }
  /// Means of rigid bodies per displacement of the supports: means x supports.
  const Matrix& transfer() const { return transfer_; }
  /// Condition number of the first auxiliary support in Reactions::supports.
  int firstCondition() const { return firstCondition_; }

  /// Adds the supports to the constraints of the whole mesh. \param values  displacements of the nodes [length]
  void addTo(Constraints& constraints, const Vector& values) const;
  /// Adds the supports to subdomains. Local.
  void addTo(std::vector<SubdomainMesh>& meshes, const Vector& values) const;
  /// Frees the nodes. Local.
  void removeFrom(std::vector<SubdomainMesh>& meshes) const;

 private:
  void findOnRoot(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, bool bodiesAreConnected, Where where);
  void add(std::size_t i, int node, double value, std::vector<NodeRule>& rules, std::vector<Support>& supports) const;

  std::vector<Held> all_;
  Matrix transfer_;
  int firstCondition_ = 0;
};

}  // namespace suture
