#pragma once
#include <support/Blocks.hpp>

namespace suture::blocks {

constexpr double kBrickJump = 1e4;  ///< of the Young modulus, from brick to brick

/// A clamped square whose bricks, every other one stiffer, are cut by the seams of the subdomains.
inline Scene bricks(int blocksX, int blocksY, int cells, double jump = kBrickJump, int brickX = 3, int brickY = 2) {
  Box box;
  box.x1 = blocksX;
  box.y1 = blocksY;
  box.nx = blocksX * cells;
  box.ny = blocksY * cells;
  box.blocksX = blocksX;
  box.blocksY = blocksY;
  box.brickX = brickX;
  box.brickY = brickY;
  Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
  scene.region("body_bricks_odd", jump);
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  return scene;
}

/// Two blocks of bricks in contact along y = 0, the lower one fixed: edges along the line with jumps that both sides see.
inline Scene brickBlocks(int rows = 1) {
  std::vector<Box> all = twoBoxes(16, 8, 2, rows);
  for (Box& box : all) {
    box.x0 = 0;
    box.brickX = 3;
    box.brickY = 2;
  }
  Scene scene = scenes::fromBoxes(all, 1.0, 0.3);
  scene.region("lower_bricks_odd", kBrickJump);
  scene.region("upper_bricks_even", kBrickJump);
  scene.pairUp();
  scene.fixLower();
  scene.hold("upper_top", 0, 0.0);
  return scene;
}

}  // namespace suture::blocks
