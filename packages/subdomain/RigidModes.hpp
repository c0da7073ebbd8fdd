#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

namespace suture {

/// Infinitesimal rigid motions of all nodes, (nodes x dimension) x modes, node-major, Cartesian: the translations, then the rotations about
/// the centroid, divided by half the diameter so that all columns are of the order of one. Local.
Matrix rigidModes(const CellBlock& block);

/// Orthonormal basis of the null space of `constraints` (rows x modes), by a singular value decomposition: singular values below 1e-10
/// times the largest (or 1, if that is larger: rows are expected to be scaled to the order of one) count as zero. No rows: the identity.
Matrix nullSpace(const Matrix& constraints);

}  // namespace suture
