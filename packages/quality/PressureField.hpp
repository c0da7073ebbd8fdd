#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/PairResult.hpp>

#include <map>
#include <vector>

namespace suture {

/// A side of an element on a contact line, in space on a contact surface.
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

/// The contacts as far as pressures need them: the sides that carry them, on rank 0. Small beside any mesh.
struct ContactSides {
  std::map<int, std::vector<ContactSide>> ofLine;  ///< by the number of the contact
  std::vector<int> heldPairs;                      ///< ids of pairs whose nodes are all held along the normal: their force says nothing
};

/// The sides of several side groups in these subdomains. Local.
std::vector<ContactSide> contactSidesHere(const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& groups);

/// From the subdomains of all ranks. \param contact  the scene's list `Contact`. Collective.
ContactSides contactSides(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Parameters& contact,
                          const std::vector<PairResult>& pairs);

/// The pressure that belongs to the contact forces: forces f_j are integrals of p phi_j, hence  p_h = sum of p_j phi_j  over the closed
/// pairs with  sum over k of M_jk p_k = f_j,  M the mass matrix of the functions. These are the sides' shape functions; of six- and
/// eight-node sides those of the multiplier (multiplierValues); those of the vertices where no other node carries a pair. At a node held
/// along the normal the contact force cannot be told from that of the support: there p_h goes on from the nodes beside it, as a constant
/// (sides of the first order) or straight (second order).
///
/// Values at the nodes of a contact's sides; those that are missing are zero: no closed pair's function reaches there. Local.
/// \throws InternalError  the mass matrix is singular: sides of no length
std::map<GlobalId, double> pressureField(const std::vector<ContactSide>& sides, int line, const std::vector<PairResult>& pairs,
                                         const std::vector<int>& heldPairs);

}  // namespace suture
