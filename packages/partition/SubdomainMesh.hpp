#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/RigidGroup.hpp>
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/pairs/ContactRow.hpp>
#include <suture/partition/Partition.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace suture {

/// All data that a rank has of one of its subdomains: elements, loaded sides, constraints, contact pairs and neighbours, in local numbers.
struct SubdomainMesh : CellBlock {
  int id = -1;
  int body = -1;
  int group = -1;  ///< contact group, or -1
  std::string name;
  std::vector<GlobalId> globalNodes;              ///< local -> node of the mesh, ascending
  std::vector<GlobalId> globalElements;           ///< local -> element of the mesh, ascending
  SideGroups sideGroups;                          ///< the mesh's side groups, restricted to this subdomain
  std::vector<NodeRule> rules;                    ///< node: local
  std::vector<Support> supports;                  ///< likewise
  std::vector<RigidGroup> rigidGroups;            ///< nodes: local; all masters, also those that are in no element of this subdomain
  std::vector<SpringDirection> springs;           ///< springs on sides of this subdomain; element and node: local
  std::vector<int> sharedOffsets{0}, sharedWith;  ///< nodes + 1; for each local node the other subdomains of its body that hold it

  /// An end of a contact pair whose node is in this subdomain.
  struct ContactEnd {
    int pair;  ///< id
    int end;   ///< index in ContactPair::ends: 0 carries the pair
    int node;  ///< local
  };
  std::vector<ContactEnd> contactEnds;
  /// All rows of every cluster that has a pair with a node here, ascending: enough to eliminate the whole cluster without communication.
  std::vector<ContactRow> contactRows;

  /// A side of an element that is also a side of another subdomain (of the same body). These sides form the seams.
  struct SeamSide {
    int element;    ///< local
    int side;       ///< number in cellInfo(...).sideNodes
    int neighbour;  ///< subdomain
  };
  std::vector<SeamSide> seamSides;  ///< by element, then side

  /// An edge of 3D elements where more than two subdomains (of the same body) meet, or two that have no side with it in common.
  struct SeamEdge {
    std::array<int, 2> vertices{{-1, -1}};  ///< local
    int middle = -1;                        ///< local; -1: the edge has none
    std::vector<int> sharers;               ///< all subdomains that have it as an edge of an element, ascending

    template <typename Self, typename Each>
    static void forEachField(Self& self, const Each& each) {
      each(self.vertices), each(self.middle), each(self.sharers);
    }
  };
  std::vector<SeamEdge> seamEdges;  ///< by vertices in the numbers of the mesh

  /// Cells between pairs in 3D (ContactPiece::cells) that have a pair whose row is here, by ids of the pairs.
  std::vector<std::vector<int>> contactCells;

  /// Rigid-body motion that takeOutRigidMotions() removed from rules and gaps. Solvers find displacements relative to it.
  struct Lift {
    std::vector<long double> amplitudes;  ///< amplitudes of the part of the body that the subdomain belongs to; empty with `motion`
    Vector motion;                        ///< motion of each node: node-major, Cartesian [length]; empty: no motion was removed
    std::vector<Point> values;            ///< original values of the rules
    std::map<int, double> gaps;           ///< original gaps of the contact rows' pairs, by id
    std::map<int, Point> slips;           ///< original ContactPair::past.slip of those that restrict sliding, by id
  };
  Lift lift;
  /// Displacement of a node's component from the drawn body. \param u  from the mesh, without the lift
  double fromDrawn(const Vector& u, Eigen::Index i) const {
    return drawn.empty() ? total(u, i) : total(u, i) + (coordinates[std::size_t(i)] - drawn[std::size_t(i)]);
  }
  /// Slip at the beginning of the load step, the lift included. [length]
  Point pastSlip(const ContactPair& pair) const {
    const auto original = lift.slips.find(pair.id);
    return original == lift.slips.end() ? pair.past.slip : original->second;
  }
  /// Component of a node's displacement, the lift included. \param i  node x dimension + component  \param u  relative to the lift
  double total(const Vector& u, Eigen::Index i) const { return lift.motion.size() > 0 ? u[i] + lift.motion[i] : u[i]; }

  Span<const int> others(int node) const {
    return {sharedWith.data() + sharedOffsets[node], std::size_t(sharedOffsets[node + 1] - sharedOffsets[node])};
  }
};

/// True in exactly one of the subdomains that share a node: the lowest.
inline bool counts(const SubdomainMesh& mesh, int node) {
  const Span<const int> others = mesh.others(node);
  return std::none_of(others.begin(), others.end(), [&](int other) { return other < mesh.id; });
}

/// Sends every subdomain to its rank. Collective. Returns this rank's subdomains in ascending order of ids.
std::vector<SubdomainMesh> distribute(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition);

}  // namespace suture
