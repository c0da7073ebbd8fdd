#pragma once
#include <support/Blocks.hpp>

namespace suture::blocks {

constexpr double kBrickJump = 1e4;  ///< ratio of Young moduli from brick to brick

/// A clamped square whose bricks, every other one stiffer, are cut by the seams of the subdomains.
Scene bricks(int blocksX, int blocksY, int cells, double jump = kBrickJump, int brickX = 3, int brickY = 2);

/// Two blocks of bricks in contact along y = 0, the lower one fixed: edges along the line with jumps that both sides see.
Scene brickBlocks(int rows = 1);

}  // namespace suture::blocks
