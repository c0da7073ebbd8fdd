#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Nodes of a side group through which another program acts on a scene (Simulation::coupling()), restricted to the nodes owned by this
/// rank: each node of the group belongs to one rank. Lists are ordered by node, vectors node-major and Cartesian.
struct CouplingSurface {
  std::string group;
  int dimension = 2;
  std::vector<GlobalId> nodes;      ///< numbers in the mesh, ascending
  std::vector<double> coordinates;  ///< [length]
  /// Integrals of the shape functions over the group, i.e. the nodal forces of a unit traction; the sum over all ranks is the size of the
  /// group. Entries may be zero or negative on second-order sides. [length; area in 3D and for axisymmetric sides]
  std::vector<double> areas;
  /// Integrals of the shape functions times the outward normal: a pressure p gives the forces -p * normals. [as areas]
  std::vector<double> normals;

  /// Local position of a node.
  struct Place {
    int mesh;  ///< index among the subdomains of this rank
    int node;  ///< local
  };
  std::vector<Place> places;
  std::size_t load = 0;  ///< index of the group's forces in ElasticModel::loads
};

/// Finds the surface of a group. Collective. \throws InputError  unknown group; suggests the nearest name
CouplingSurface couplingSurface(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group);

/// Gathers the values of all ranks by node, on every rank. Collective.
/// \param what  the quantity, for messages \throws InputError  the number of values does not match the nodes of a rank; NaN or infinity
std::map<GlobalId, Point> valuesByNode(const Comm& comm, const CouplingSurface& surface, const std::vector<double>& values,
                                       const std::string& what);

/// Nodal forces of tractions given at the nodes and interpolated by the shape functions. On every rank. Collective.
/// \param tractions  by node [stress]
std::map<GlobalId, Point> consistentForces(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group,
                                           const std::map<GlobalId, Point>& tractions);

}  // namespace suture
