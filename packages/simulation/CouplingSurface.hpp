#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Nodes of a side group at which another program acts on a scene (Simulation::coupling()): those that this rank owns. Lists by node, of
/// vectors node-major and Cartesian. All ranks together have every node of the group once.
struct CouplingSurface {
  std::string group;
  int dimension = 2;
  std::vector<GlobalId> nodes;      ///< numbers in the mesh, ascending
  std::vector<double> coordinates;  ///< [length]
  /// Integrals of the shape functions over the group, the forces of a unit traction: their sum over all ranks is the group's size. Some are
  /// zero or negative on sides of second order. [length, area in space and of revolved sides]
  std::vector<double> areas;
  /// Integrals of the shape functions times the outward normal: a pressure p pushes with the forces -p x these. [as areas]
  std::vector<double> normals;

  /// Where the rank holds its nodes.
  struct Place {
    int mesh;  ///< place among the subdomains of this rank
    int node;  ///< local
  };
  std::vector<Place> places;
  std::size_t load = 0;  ///< place of the group's forces in ElasticModel::loads
};

/// Finds the surface of a group. Collective. \throws InputError  no subdomain has the group: the nearest name
CouplingSurface couplingSurface(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group);

/// Values of all ranks by node, on every rank. Collective.
/// \param what  names them in messages \throws InputError  a rank has another number of values than components of its nodes; NaN or
/// infinity
std::map<GlobalId, Point> valuesByNode(const Comm& comm, const CouplingSurface& surface, const std::vector<double>& values,
                                       const std::string& what);

/// Nodal forces of tractions that the shape functions interpolate between values at the nodes. On every rank. Collective.
/// \param tractions  by node [stress]
std::map<GlobalId, Point> consistentForces(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::string& group,
                                           const std::map<GlobalId, Point>& tractions);

}  // namespace suture
