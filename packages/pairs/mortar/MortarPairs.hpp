#pragma once
#include <suture/pairs/ContactPairs.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Pairs of a contact whose faces need not match, by dual mortar. One side carries the contact stress, sum of p_j psi_j over its nodes. On
/// each of its elements the psi_j are combinations of the shape functions, biorthogonal to them over the part covered by the other side:
/// int psi_j phi_k = delta_jk int phi_k (Wohlmuth 2000; on partly covered elements as in Cichosz and Bischoff 2011). Condition j is the
/// mean of the gap with weight psi_j,
///     int psi_j (g - (u_A - u_B) . n_j) >= 0,  divided by int psi_j.
/// Its force is p_j int psi_j; it involves one node of the carrying side and all nodes of the other side that the support of psi_j covers.
/// n_j is the mean of the nodal normals of both sides. Points of the two sides are matched along n_j, so that the pair's forces have no
/// moment; integrals are split wherever an element of the other side begins (segments), so that constant stress is transmitted exactly on
/// straight lines and flat faces. Between straight elements on curved lines the gap is that of smooth curves (LineSampling).
///
/// A three-node element that is covered in part carries a linear stress, because a quadratic one is not positive there; the same holds for
/// second-order sides in 3D, which have functions with positive integrals where they are covered entirely (FaceSampling): a condition may
/// then have several nodes of the carrying side. Sides of which less than a twentieth is uncovered count as covered entirely. If the hat
/// function of a node beyond the end of the other side stays below .9 on the covered part, the node transfers its psi to the nearest node
/// that the other side reaches: the psi sum to one wherever the sides meet.
///
/// \param problems  receives sides that do not overlap;  \param notes  receives warnings if the scene selects the finer of two curved sides
/// as carrier, or if the sides share only part of an element
/// \return pairs as pairSurface(), in the order of the carrying side's nodes. Local.
PairedSurface mortarPairs(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes);

/// The same for face A against an obstacle, with nodes of face A only. \param sampling  of the obstacle
PairedSurface mortarPairs(const ContactSurface& contact, std::unique_ptr<const MortarSampling> sampling);

}  // namespace suture
