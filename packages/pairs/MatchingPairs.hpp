#pragma once
#include <suture/pairs/ContactPairs.hpp>

#include <optional>

namespace suture {

/// Pairs the nodes of the two faces of a contact, in the order of face A's nodes (inOrder). 2D and 3D. Local.
///
/// The faces must match: the same number of connected parts, and facing parts with the same sides (FacingNodes). Partners may be separated
/// by an initial gap, but not shifted along the face: with n = (n_A - n_B) / |n_A - n_B|, d = x_B - x_A and gap d.n, the tangential
/// distance must be at most
///     tolerance x local mesh size + |gap| tan(theta),
/// where theta is the largest angle between n and the normals of the sides nearby. The second term lets d have any direction between the
/// normals of the two sides: across a gap between curved sides no direction is distinguished (a cylinder over a plane matches by x, one
/// over a cylinder by angle), and the difference is of second order. The normal of such a pair is the direction of d, so that its forces
/// have no moment.
/// \param problems  receives sides that do not match (number of nodes on each, nodes without partner, place and distance), do not face each
/// other or are of different order, and sides whose vertices carry no pressure (ContactFace); may be null
/// \return nothing if they do not match
std::optional<PairedSurface> matchingPairs(const Mesh& mesh, const ContactSurface& contact, Problems* problems);

}  // namespace suture
