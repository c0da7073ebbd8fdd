#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/Coatings.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Surface.hpp>

#include <cmath>

namespace suture {
namespace {

/// A box whose top is coated.
struct CoatedBox {
  Mesh mesh;
  double size = 0.0;  // of the top

  explicit CoatedBox(Cell cell, bool revolved = false) {
    Box box;
    box.name = "box";
    box.x1 = 2;
    box.nx = 3;
    box.ny = box.nz = 2;
    box.cell = cell;
    mesh = boxes({box});
    mesh.axisymmetric = revolved;
    const std::vector<Side> top = mesh.sideGroups.at("box_top");
    const Surface surface(mesh, top);
    std::map<int, int> outer;
    for (const auto& [node, data] : surface.nodes()) {
      outer[node] = mesh.nodes();
      const Point place = mesh.point(node);
      mesh.coordinates.insert(mesh.coordinates.end(), place.begin(), place.begin() + mesh.dimension);
    }
    for (const Side& side : top) {
      mesh.coatings.push_back({side.element, side.side, 0, int(mesh.coatingNodes.size()), 5.0, 2.0});
      for (const int node : mesh.nodesOf(side)) mesh.coatingNodes.push_back(outer.at(node));
    }
    size = revolved ? 3.14159265358979 * 4 : mesh.dimension == 2 ? 2.0 : 2.0 * (box.y1 - box.y0);
  }

  ElementForces forces(const Vector& u) const {
    ElementForces all{Vector::Zero(u.size()), Vector::Zero(mesh.nodes()), Vector::Zero(mesh.nodes())};
    addCoatingForces(mesh, u, all);
    return all;
  }
};

TEUCHOS_UNIT_TEST(Coatings, ResistUniformJumpsByTheirStiffnessTimesTheArea) {
  for (int number = 0; number < kCells; ++number)
    for (const bool revolved : {false, true}) {
      const auto cell = static_cast<Cell>(number);
      if (cell == Cell::Pyramid5 || (revolved && dimensionOf(cell) == 3)) continue;
      const CoatedBox box(cell, revolved);
      const int d = box.mesh.dimension;
      for (int k = 0; k < d; ++k) {
        Vector u = Vector::Constant(Eigen::Index(d) * box.mesh.nodes(), 0.7);  // a common motion needs no force
        for (int node = box.mesh.bodyNodes(); node < box.mesh.nodes(); ++node) u[d * node + k] += 0.1;
        const Vector force = box.forces(u).internal;
        Point outer{0, 0, 0}, inner{0, 0, 0};
        for (int node = 0; node < box.mesh.nodes(); ++node)
          for (int c = 0; c < d; ++c) (node < box.mesh.bodyNodes() ? inner : outer)[c] += force[d * node + c];
        for (int c = 0; c < d; ++c) {
          const double expected = c == k ? 0.1 * box.size * (k == d - 1 ? 5.0 : 2.0) : 0.0;
          TEST_COMPARE(std::abs(outer[c] - expected), <, 1e-12 * box.size);
          TEST_COMPARE(std::abs(inner[c] + expected), <, 1e-12 * box.size);
        }
      }
    }
}

TEUCHOS_UNIT_TEST(Coatings, HaveTheForcesOfTheirMatrices) {
  const CoatedBox box(Cell::Hexahedron20);
  const int d = box.mesh.dimension;
  Vector u(Eigen::Index(d) * box.mesh.nodes()), f = Vector::Zero(u.size()), diagonal = Vector::Zero(box.mesh.nodes());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = std::sin(double(7 * i));
  const CoatedBlock coated(box.mesh);
  coatingStiffnesses(box.mesh, [&](int element, ConstLocalView k) {
    const Span<const int> nodes = coated.block().nodesOf(element);
    for (int i = 0; i < k.rows(); ++i) {
      for (int j = 0; j < k.cols(); ++j) f[d * nodes[i / d] + i % d] += k(i, j) * u[d * nodes[j / d] + j % d];
      diagonal[nodes[i / d]] += k(i, i) / d;
    }
  });
  const ElementForces forces = box.forces(u);
  TEST_COMPARE((forces.internal - f).norm(), <, 1e-13 * f.norm());
  TEST_COMPARE((forces.stiffness - diagonal).norm(), <, 1e-13 * diagonal.norm());
  TEST_COMPARE(forces.rounding.minCoeff(), >=, 0.0);
}

}  // namespace
}  // namespace suture
