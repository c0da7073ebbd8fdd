#include <precond/BrickScenes.hpp>

namespace suture::blocks {

Scene bricks(int blocksX, int blocksY, int cells, double jump, int brickX, int brickY) {
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

Scene brickBlocks(int rows) {
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

Scene cube(int k, int m, int bricks, Cell cell, double poisson) {
  Box box;
  box.x1 = box.y1 = box.z1 = k;
  box.nx = box.ny = box.nz = k * m;
  box.blocksX = box.blocksY = box.blocksZ = k;
  box.brickX = box.brickY = box.brickZ = bricks;
  box.cell = cell;
  Scene scene = scenes::fromBoxes({box}, 1.0, poisson);
  scene.model.dimension = 3;
  if (bricks > 0) scene.region("body_bricks_odd", kHardJump);
  for (int component = 0; component < 3; ++component) scene.hold("body_left", component, 0.0);
  return scene;
}

}  // namespace suture::blocks
