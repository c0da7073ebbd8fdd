// Recovered 3D stresses and estimated errors: exact where they must be, and close to the true error of Galerkin solutions.
#include <Eigen/SparseCholesky>
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/SolidScenes.hpp>
#include <suture/answer/error/ErrorEstimate.hpp>
#include <suture/answer/values/NodalStresses.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementMap.hpp>

namespace suture {
namespace solidestimates {

using solids::operator*;

constexpr double kPoisson = 0.3, kShear = 1.0, kYoung = 2 * kShear * (1 + kPoisson);
constexpr double kLambda = 2 * kShear * kPoisson / (1 - 2 * kPoisson);
const Material kMaterial{"m", kYoung, kPoisson};

struct Exact {
  solids::Field displacement;
  std::function<Eigen::Matrix3d(const Point&)> gradient;  ///< row k: of component k

  StressVector<3> stress(const Point& x) const {
    const Eigen::Matrix3d g = gradient(x), s = kLambda * g.trace() * Eigen::Matrix3d::Identity() + kShear * (g + g.transpose());
    StressVector<3> all;
    for (int k = 0; k < 6; ++k) all[k] = s(kStressAxes[k][0], kStressAxes[k][1]);
    return all;
  }
};

/// The gradient of a harmonic function, exp(sqrt(2) x) cos(y) cos(z): no body forces for any material.
Exact harmonic() {
  const double a = std::sqrt(2.0);
  return {
      [a](const Point& x) {
        const double e = std::exp(a * x[0]);
        return Point{a * e * std::cos(x[1]) * std::cos(x[2]), -e * std::sin(x[1]) * std::cos(x[2]), -e * std::cos(x[1]) * std::sin(x[2])};
      },
      [a](const Point& x) {
        const double e = std::exp(a * x[0]), cy = std::cos(x[1]), sy = std::sin(x[1]), cz = std::cos(x[2]), sz = std::sin(x[2]);
        Eigen::Matrix3d g;
        g << 2 * e * cy * cz, -a * e * sy * cz, -a * e * cy * sz, -a * e * sy * cz, -e * cy * cz, e * sy * sz, -a * e * cy * sz,
            e * sy * sz, -e * cy * cz;
        return g;
      }};
}

/// A second-order (or first-order) field with all its terms.
Exact polynomial(int order) {
  const double c = order > 1 ? 1.0 : 0.0;
  return {[c](const Point& p) {
            const double x = p[0], y = p[1], z = p[2];
            return Point{1 + 2 * x - y + 0.5 * z + c * (x * x - 2 * x * y + 0.3 * z * z + y * z),
                         -x + 3 * y + z + c * (0.5 * y * y + x * z - x * x),
                         0.2 * x - y + z + c * (z * z + x * y - 0.7 * y * z + 0.4 * x * x)};
          },
          [c](const Point& p) {
            const double x = p[0], y = p[1], z = p[2];
            Eigen::Matrix3d g;
            g << 2 + c * (2 * x - 2 * y), -1 + c * (-2 * x + z), 0.5 + c * (0.6 * z + y), -1 + c * (z - 2 * x), 3 + c * y, 1 + c * x,
                0.2 + c * (y + 0.8 * x), -1 + c * (x - 0.7 * z), 1 + c * (2 * z - 0.7 * y);
            return g;
          }};
}

/// The displacement of the mesh with exact values on its boundary, by Galerkin's method.
Vector solve(const Mesh& mesh, const Exact& exact) {
  std::vector<char> fixed(mesh.nodes(), 0);
  for (const auto& group : mesh.sideGroups)
    for (const Side& side : group.second)
      for (const int node : mesh.nodesOf(side)) fixed[node] = 1;
  std::vector<int> place(3 * mesh.nodes(), -1);
  int unknowns = 0;
  for (int node = 0; node < mesh.nodes(); ++node)
    for (int k = 0; !fixed[node] && k < 3; ++k) place[3 * node + k] = unknowns++;
  Vector u = solids::atNodes(static_cast<const CellBlock&>(mesh), exact.displacement), right = Vector::Zero(unknowns);
  std::vector<Eigen::Triplet<double>> entries;
  elementStiffnesses(mesh, kMaterial, PlaneModel::Strain, [&](int element, ConstLocalView k) {
    const Span<const int> nodes = mesh.nodesOf(element);
    for (Eigen::Index i = 0; i < k.rows(); ++i)
      for (Eigen::Index j = 0; j < k.cols(); ++j) {
        const int row = 3 * nodes[i / 3] + int(i % 3), column = 3 * nodes[j / 3] + int(j % 3);
        if (place[row] < 0) continue;
        if (place[column] < 0)
          right[place[row]] -= k(i, j) * u[column];
        else
          entries.emplace_back(place[row], place[column], k(i, j));
      }
  });
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Vector found = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  for (int dof = 0; dof < 3 * mesh.nodes(); ++dof)
    if (place[dof] >= 0) u[dof] = found[place[dof]];
  return u;
}

/// Energy norm of the true error.
double trueError(const Mesh& mesh, const Vector& u, const Exact& exact) {
  double square = 0.0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const ReferenceElement& rule = referenceElement(mesh.cells[e], Rule::Data);
    ElementMap<3> map(mesh, e, rule);
    const auto nodes = mesh.nodesOf(e);
    for (int q = 0; q < rule.points; ++q) {
      map.at(q);
      Eigen::Matrix3d g = -exact.gradient(map.place());
      for (int a = 0; a < rule.nodes; ++a)
        for (int k = 0; k < 3; ++k)
          for (int j = 0; j < 3; ++j) g(k, j) += map.gradient(a)[j] * u[3 * nodes[a] + k];
      const Eigen::Matrix3d strain = 0.5 * (g + g.transpose());
      square += map.measure() * (kLambda * g.trace() * g.trace() + 2 * kShear * strain.squaredNorm());
    }
  }
  return std::sqrt(square);
}

std::vector<PatchRecovery> recovered(const Mesh& mesh, const Vector& u) {
  std::vector<PatchRecovery> one;
  one.emplace_back(
      mesh, [](int) -> const Material& { return kMaterial; }, PlaneModel::Strain, u);
  recoverPatches(one);
  return one;
}

/// Largest difference of the recovered stresses at the nodes from the exact ones.
double nodalError(const Mesh& mesh, const Vector& u, const Exact& exact) {
  const Matrix sums = recovered(mesh, u)[0].nodalSums();
  double most = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node)
    most = std::max(most, (sums.col(node).head<6>() / sums(6, node) - exact.stress(mesh.point(node))).cwiseAbs().maxCoeff());
  return most;
}

TEUCHOS_UNIT_TEST(SolidEstimates, RecoverUniformStressesOnDistortedMeshesOfEveryCell) {
  const Exact exact = polynomial(1);
  for (const Cell cell : solids::cells())
    for (const int n : {1, 2, 3}) {
      Mesh mesh = boxes({solids::cube(cell, n)});
      solids::distort(mesh, 0.1 / n, true);
      const Vector u = solids::atNodes(static_cast<const CellBlock&>(mesh), exact.displacement);
      TEST_COMPARE(nodalError(mesh, u, exact), <, 1e-10);
      TEST_COMPARE(recovered(mesh, u)[0].errors().error.sum(), <, 1e-20);
    }
}

TEUCHOS_UNIT_TEST(SolidEstimates, RecoverLinearStressesOnDistortedMeshesOfTheSecondOrder) {
  const Exact exact = polynomial(2);
  for (const Cell cell : {Cell::Tetrahedron10, Cell::Hexahedron20, Cell::Hexahedron27})
    for (const int n : {2, 4}) {
      Mesh mesh = boxes({solids::cube(cell, n)});
      // Serendipity functions contain all second-order polynomials on parallelepipeds only.
      if (cell != Cell::Hexahedron20) solids::distort(mesh, 0.1 / n);
      for (int node = 0; node < mesh.nodes(); ++node) {
        double* x = &mesh.coordinates[3 * std::size_t(node)];
        x[0] += 0.3 * x[1] - 0.2 * x[2], x[1] += 0.1 * x[2];
      }
      const Vector u = solids::atNodes(static_cast<const CellBlock&>(mesh), exact.displacement);
      TEST_COMPARE(nodalError(mesh, u, exact), <, 1e-9);
      TEST_COMPARE(recovered(mesh, u)[0].errors().error.sum(), <, 1e-18);
    }
}

/// The strains of interpolated second-order fields are exact in the middle of a parallelepiped: the sampling point.
TEUCHOS_UNIT_TEST(SolidEstimates, RecoverLinearStressesFromHexahedraOfTheFirstOrder) {
  const Exact exact = polynomial(2);
  for (const int n : {2, 3, 5}) {
    const Mesh mesh = boxes({solids::cube(Cell::Hexahedron8, n)});
    TEST_COMPARE(nodalError(mesh, solids::atNodes(static_cast<const CellBlock&>(mesh), exact.displacement), exact), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(SolidEstimates, ApproachTheTrueErrorOfEveryCell) {
  const Exact exact = harmonic();
  for (const Cell cell : solids::cells())
    for (const bool isDistorted : {false, true}) {
      double last = 0.0;
      for (const int n : cellInfo(cell).order == 1 ? std::vector<int>{4, 8} : std::vector<int>{3, 5}) {
        Mesh mesh = boxes({solids::cube(cell, n)});
        if (isDistorted) solids::distort(mesh, 0.1 / n);
        const Vector u = solve(mesh, exact);
        const double truth = trueError(mesh, u, exact), estimated = std::sqrt(recovered(mesh, u)[0].errors().error.sum());
        out << cellInfo(cell).name << (isDistorted ? " distorted " : " straight ") << n << ": exact " << truth << ", effectivity "
            << estimated / truth << ", order " << (last > 0 ? std::log(last / truth) / std::log(n == 8 ? 2.0 : 5.0 / 3) : 0.0) << "\n";
        TEST_COMPARE(estimated / truth, >, 0.8);
        TEST_COMPARE(estimated / truth, <, 1.2);
        // The middles of distorted wedges are not superconvergence points.
        if (last > 0) TEST_COMPARE(std::abs(estimated / truth - 1), <, cell == Cell::Wedge6 && isDistorted ? 0.15 : 0.1);
        last = truth;
      }
    }
}

TEUCHOS_UNIT_TEST(SolidEstimates, DoNotDependOnTheCut) {
  const Exact exact = harmonic();
  for (const Cell cell : {Cell::Tetrahedron4, Cell::Hexahedron8, Cell::Hexahedron20}) {
    scenes::Scene whole = solids::fromBoxes({solids::cube(cell, 4)}, kYoung, kPoisson);
    const Vector u = solids::atNodes(static_cast<const CellBlock&>(whole.mesh), exact.displacement);
    const std::vector<PatchRecovery> one = recovered(whole.mesh, u);
    const Vector reference = one[0].errors().error.cwiseSqrt();
    const Matrix sums = one[0].nodalSums();
    for (const int blocks : {2, 4}) {  // one cell each: no complete patch
      const scenes::Scene scene = solids::fromBoxes({solids::cube(cell, 4, blocks)}, kYoung, kPoisson);
      const auto meshes = solids::distributed(scene);
      const auto displacement = solids::atNodes(meshes, exact.displacement);
      const auto cut = recoverStresses(*solids::world(), meshes, scene.model, displacement);
      const DiscretisationError error = estimateError(*solids::world(), cut);
      TEST_FLOATING_EQUALITY(error.energyNorm, reference.norm(), 1e-12);
      const std::vector<Matrix> nodal = nodalStresses(*solids::world(), meshes, scene.model, cut);
      for (std::size_t i = 0; i < meshes.size(); ++i) {
        for (int e = 0; e < meshes[i].elements(); ++e)
          TEST_COMPARE(std::abs(error.ofElements[i](e) - reference(meshes[i].globalElements[e])), <, 1e-11 * reference.maxCoeff());
        TEST_EQUALITY(nodal[i].cols(), 6);
        for (int node = 0; node < meshes[i].nodes(); ++node) {
          const auto column = sums.col(meshes[i].globalNodes[node]);
          TEST_COMPARE((nodal[i].row(node).transpose() - column.head<6>() / column[6]).norm(), <, 1e-9);
        }
      }
    }
  }
}

/// Columns under one pressure whose modulus jumps within the body and between bodies: uniform in each, so that nothing is to be estimated.
TEUCHOS_UNIT_TEST(SolidEstimates, DoNotSmoothJumpsBetweenMaterialsAndBodies) {
  for (const Cell cell : solids::cells()) {
    std::vector<Box> both{solids::cube(cell, 4, 2), solids::cube(cell, 4, 2)};
    both[0].name = "lower";
    both[1].name = "upper";
    both[1].z0 = 1, both[1].z1 = 2;
    scenes::Scene scene = solids::fromBoxes(both, kYoung, 0.0);
    scene.model.materialOfBody[1].young = 7 * kYoung;
    scene.model.materialOfRegion = {{"hard", 50 * kYoung, 0.0}};
    scene.mesh.regions.assign(scene.mesh.elements(), -1);
    for (int e = 0; e < scene.mesh.elements(); ++e) {
      double z = 0;
      for (const int node : scene.mesh.nodesOf(e)) z += scene.mesh.point(node)[2] / double(scene.mesh.nodesOf(e).size());
      if (z < 0.5) scene.mesh.regions[e] = 0;
    }
    const auto meshes = solids::distributed(scene);
    const auto displacement = solids::atNodes(meshes, [](const Point& x) {
      const double z = x[2];
      return Point{0, 0, (std::min(z, 0.5) / 50 + std::clamp(z - 0.5, 0.0, 0.5) + std::max(z - 1, 0.0) / 7) / kYoung};
    });
    const DiscretisationError error = estimateError(*solids::world(), meshes, scene.model, displacement);
    TEST_COMPARE(error.relative(), <, 1e-10);
    TEST_COMPARE(error.solutionNorm, >, 0.1);
  }
}

}  // namespace solidestimates
}  // namespace suture
