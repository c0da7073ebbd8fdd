#include <interface/FrictionBlocks.hpp>
#include <suture/constraints/BuildConstraints.hpp>

#include <algorithm>
#include <cmath>

namespace suture::blocks {

Scene rubbedBlocks(int dimension, Sides sides, const std::shared_ptr<const ContactLaw>& law, int cells, bool open, double angle) {
  const int up = dimension - 1;
  std::vector<Box> boxes;
  for (const bool upper : {false, true}) {
    if (sides == Sides::Obstacle && !upper) continue;
    Box box;
    box.name = upper ? "upper" : "lower";
    box.x1 = 2.0;
    (dimension == 2 ? box.y0 : box.z0) = upper ? 0.0 : -1.0;
    (dimension == 2 ? box.y1 : box.z1) = upper ? 1.0 : 0.0;
    box.nx = 2 * cells;
    box.ny = box.nz = cells;
    if (sides == Sides::Mortar && upper) box.nx += 2, box.ny += dimension - 2;
    box.blocksX = 2;
    box.cell = dimension == 2 ? Cell::Triangle3 : Cell::Hexahedron8;
    boxes.push_back(box);
  }
  Scene scene = scenes::fromBoxes(boxes, 1.0, 0.3);
  scene.model.dimension = dimension;
  if (sides != Sides::Obstacle) scene.model.materialOfBody[0].young = 2.0;
  const auto turned = [&](Point p) {
    const double x = p[0], height = p[up];
    p[0] = std::cos(angle) * x - std::sin(angle) * height;
    p[up] = std::sin(angle) * x + std::cos(angle) * height;
    return p;
  };
  const Mesh straight = scene.mesh;
  for (int node = 0; node < straight.nodes() && angle != 0.0; ++node) {
    const Point p = turned(straight.point(node));
    std::copy_n(p.begin(), dimension, scene.mesh.coordinates.begin() + std::ptrdiff_t(node) * dimension);
  }
  Point upwards{0, 0, 0};
  upwards[up] = 1.0;
  const Obstacle plane = Obstacle::plane({0, 0, 0}, turned(upwards));
  scene.constraints = buildConstraints(
      scene.mesh, {}, {sides == Sides::Obstacle ? Contact::with(plane, "upper_bottom") : Contact::between("upper_bottom", "lower_top")});
  applyLaws(ContactLaws({law}), scene.mesh, scene.constraints);
  for (const int node : scene.nodesOf("upper_top")) {
    const Point p = straight.point(node);
    Point u{0.02, 0.0, 0.0};
    if (dimension == 3) u[0] += 0.01 * p[1], u[1] = 0.012 - 0.008 * p[0];
    u[up] = -0.03 + (open ? 0.045 : 0.012) * (p[0] - 1.0);
    u = turned(u);
    for (int k = 0; k < dimension; ++k) scene.holdNode(node, k, u[k]);
  }
  if (sides != Sides::Obstacle)
    for (int k = 0; k < dimension; ++k) scene.hold("lower_bottom", k, 0.0);
  return scene;
}

}  // namespace suture::blocks
