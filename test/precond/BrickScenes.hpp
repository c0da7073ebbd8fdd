#pragma once
#include <support/Blocks.hpp>

namespace suture::blocks {

constexpr double kBrickJump = 1e4;  ///< ratio of Young moduli from brick to brick

/// A clamped square whose bricks, every other one stiffer, are cut by the seams of the subdomains.
Scene bricks(int blocksX, int blocksY, int cells, double jump = kBrickJump, int brickX = 3, int brickY = 2);

/// Two blocks of bricks in contact along y = 0, the lower one fixed: edges along the line with jumps on both sides.
Scene brickBlocks(int rows = 1);

/// A cube of side k, k^3 subdomains of m^3 cells, one side clamped. \param bricks  > 0: every other brick of this many cells per direction
/// is stiffer by kHardJump, across faces, edges and vertices of the subdomains
Scene cube(int k, int m, int bricks = 0, Cell cell = Cell::Hexahedron8, double poisson = 0.3);

constexpr double kHardJump = 1e6;

}  // namespace suture::blocks
