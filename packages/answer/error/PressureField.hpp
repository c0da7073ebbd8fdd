#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <vector>

namespace suture {

/// A side of an element on a contact line (2D) or surface (3D).
struct ContactSide {
  std::vector<GlobalId> nodes;  ///< in the order of SideGeometry.hpp
  std::vector<Point> points;
  bool axisymmetric = false;
  int dimension = 2;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.nodes), each(self.points), each(self.axisymmetric), each(self.dimension);
  }
};

/// Contact data needed for pressures: the carrying sides, on rank 0. Small compared with any mesh.
struct ContactSides {
  std::map<int, std::vector<ContactSide>> ofLine;  ///< by contact number
  std::vector<int> heldPairs;                      ///< ids of pairs whose nodes are all fixed along the normal: their force is meaningless
};

/// Sides of several side groups in these subdomains. Local.
std::vector<ContactSide> contactSidesHere(const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& groups);

/// Contact sides from the subdomains of all ranks. \param contact  the scene's list `Contact`. Collective.
ContactSides contactSides(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Parameters& contact,
                          const std::vector<PairResult>& pairs);

/// The pressure equivalent to the contact forces: forces f_j are integrals of p phi_j, hence  p_h = sum of p_j phi_j  over the closed pairs
/// with  sum over k of M_jk p_k = f_j,  M the mass matrix of the functions. These are the sides' shape functions; for six- and eight-node
/// sides those of the multiplier (multiplierValues), or of the vertices if no other node carries a pair. At a node fixed along the normal
/// the contact force cannot be separated from the support force: p_h is extrapolated there from the neighbouring nodes, constant
/// (first-order sides) or linear (second-order sides).
///
/// Returns values at the nodes of a contact's sides; missing values are zero, because no function of a closed pair extends there. Local.
/// \throws InternalError  if the mass matrix is singular: sides of zero length
std::map<GlobalId, double> pressureField(const std::vector<ContactSide>& sides, int line, const std::vector<PairResult>& pairs,
                                         const std::vector<int>& heldPairs);

}  // namespace suture
