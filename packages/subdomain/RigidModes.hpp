#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

namespace suture {

/// Infinitesimal rigid motions of all nodes, (nodes x dimension) x modes, node-major, Cartesian: the translations, then the rotations about
/// the centroid, divided by half the diameter so that all columns are of the order of one. Of bodies of revolution only the translation
/// along the axis. Local.
Matrix rigidModes(const CellBlock& block);

/// The rigid motions of the cross-section, seen as a plane body: rigidModes() but for axisymmetric blocks. There the radial translation and
/// the rotation strain the body along the hoop only, by its size over its distance from the axis: the softest motions of a part of it.
Matrix sectionModes(const CellBlock& block);

}  // namespace suture
