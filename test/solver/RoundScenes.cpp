#include <solver/RoundScenes.hpp>

namespace suture::scenes {

Scene quarterRing(Cell cell, double a, double b, int nr, int nt, const Material& material, bool axisymmetric) {
  Box box;
  box.x0 = a;
  box.x1 = b;
  box.nx = nr;
  box.ny = nt;
  box.cell = cell;
  Scene scene = fromBoxes({box}, material.young, material.poisson);
  scene.model.materialOfBody[0] = material;
  const double quarter = std::acos(0.0);
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    double* x = &scene.mesh.coordinates[2 * node];
    const double r = x[0], t = x[1];
    x[0] = t == 1.0 ? 0.0 : r * std::cos(t * quarter);
    x[1] = r * std::sin(t * quarter);
  }
  if (axisymmetric) {
    makeAxisymmetric(scene.mesh);
    scene.model.axisymmetric = true;
    Problems problems;
    scene.constraints.rules = nodalRules(scene.mesh, {}, problems, scene.constraints.supports, scene.constraints.prescribed);
  } else {
    scene.hold("body_top", 0, 0.0);
  }
  scene.hold("body_bottom", 1, 0.0);
  return scene;
}

}  // namespace suture::scenes
