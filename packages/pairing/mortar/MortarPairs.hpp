#pragma once
#include <suture/pairing/ContactPairs.hpp>
#include <suture/pairing/mortar/MortarSampling.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Pairs of a contact whose faces need not match, by dual mortar. One side carries the contact stress, sum of p_j psi_j over its
/// nodes. On each of its elements the psi_j are combinations of the shape functions, biorthogonal to them over the part that the other
/// side covers: int psi_j phi_k = delta_jk int phi_k (Wohlmuth 2000; over partly covered elements as Cichosz and Bischoff 2011). Condition
/// j is the mean of the gap with weight psi_j,
///     int psi_j (g - (u_A - u_B) . n_j) >= 0,  divided by int psi_j:
/// its force is p_j int psi_j, and it has one node of the carrying side and all those of the other that psi_j meets. n_j is the mean of
/// both sides' nodal normals. Points of one side meet points of the other along n_j, so that the pair's forces have no moment; integrals
/// are split wherever an element of the other side begins (segments), so that constant stress passes exactly on straight lines and flat
/// faces. Between straight elements on curved lines the gap is that of smooth curves (LineSampling).
///
/// An element of three nodes that is covered in part carries a linear stress: a quadratic one is not positive there; in space second-order
/// sides likewise, and where they are covered wholly functions whose integrals are positive (FaceSampling): a condition may then have
/// several nodes of the carrying side. A node beyond the end of the other side whose hat function stays below .9 on the covered part hands
/// its psi on to the nearest node that the other side reaches: the sum of all psi is one wherever the sides meet.
///
/// \param problems  gets sides that meet nowhere;  \param notes  warnings where the scene lets the finer of two curved sides carry, and
/// where the sides share a part of an element only
/// \return pairs as pairSurface(), in the order of the carrying side's nodes. Local.
PairedSurface mortarPairs(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes);

/// The same of face A before an obstacle, with nodes of face A only. \param sampling  of the obstacle
PairedSurface mortarPairs(const ContactSurface& contact, std::unique_ptr<const MortarSampling> sampling);

}  // namespace suture
