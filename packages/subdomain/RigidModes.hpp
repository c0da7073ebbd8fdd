#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

namespace suture {

/// Infinitesimal rigid-body motions of all nodes, (nodes x dimension) x modes, node-major, Cartesian: the translations, then the rotations
/// about the centroid, divided by half the diameter, which makes all columns of the order of one. For bodies of revolution only the axial
/// translation. Local.
Matrix rigidModes(const CellBlock& block);

/// Rigid-body motions of the cross-section as a plane body. Equal to rigidModes(), except for axisymmetric blocks: there the radial
/// translation and the rotation only cause hoop strain, of the order of size over distance from the axis: the softest motions of a part.
Matrix sectionModes(const CellBlock& block);

}  // namespace suture
