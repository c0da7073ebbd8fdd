#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

namespace suture {

/// Infinitesimal rigid motions of all nodes, (nodes x dimension) x modes, node-major, Cartesian: the translations, then the rotations about
/// the centroid, divided by half the diameter so that all columns are of the order of one. Local.
Matrix rigidModes(const CellBlock& block);

}  // namespace suture
