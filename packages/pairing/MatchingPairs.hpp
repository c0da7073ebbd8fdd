#pragma once
#include <suture/pairing/ContactPairs.hpp>

#include <optional>

namespace suture {

/// Pairs the nodes of a contact's two faces, in the order of face A's nodes (inOrder). In the plane and in space. Local.
///
/// The faces must match: as many connected parts, facing parts with the same sides laid against each other (FacingNodes). Partners may
/// stand apart by an initial gap, but not be shifted along the face: with n = (n_A - n_B) / |n_A - n_B|, d = x_B - x_A and gap d.n, the
/// tangential distance must be at most
///     tolerance x local mesh size + |gap| tan(theta),
/// where theta is the largest angle between n and the normals of the sides nearby. The second term lets d lie anywhere between the normals
/// of the two sides: with a gap between curved sides no single direction is the right one (a cylinder over a plane matches by x, one over
/// a cylinder by angle), and the difference is of second order. The normal of such a pair is then the direction of d, so that its forces
/// have no moment.
/// \param problems  gets sides that do not match (how many nodes on each, how many without partner, where and how far), do not face each
///                  other or are of different order; sides whose vertices carry no pressure (ContactFace); may be null
/// \return nothing if they do not match
std::optional<PairedSurface> matchingPairs(const Mesh& mesh, const ContactSurface& contact, Problems* problems);

}  // namespace suture
