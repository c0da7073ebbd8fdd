#include <suture/base/Dense.hpp>
#include <suture/precond/AdaptiveEdges.hpp>
#include <suture/precond/EdgeConstraints.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// With the flux as another column, where it is anything: nearly incompressible bodies are as stiff as their bulk modulus against jumps
/// that change the volume on one side, and averages of nodal values are no flux on edges that turn or whose nodes are of several kinds (Li,
/// Widlund, "BDDC algorithms for incompressible Stokes equations", SIAM J. Numer. Anal. 2006).
Matrix withFlux(const InterfaceSpace& space, const std::vector<int>& unknowns, const Matrix& modes) {
  Vector flux(modes.rows());
  for (int i = 0; i < flux.size(); ++i) flux(i) = space.flux(unknowns[i]);
  const double size = flux.size() > 0 ? flux.cwiseAbs().maxCoeff() : 0.0;
  if (!(size > 0.0)) return modes;
  Matrix all(modes.rows(), modes.cols() + 1);
  all << modes, flux / size;
  return all;
}

/// Columns: translations, and if asked for the rotation, of the edge's unknowns, of the order of one.
Matrix rigidMotions(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withRotation) {
  Point centre{0, 0, 0};
  for (const int place : unknowns)
    for (int k = 0; k < 3; ++k) centre[k] += space.point(place)[k] / static_cast<double>(unknowns.size());
  double size = 0.0;
  for (const int place : unknowns) {
    for (int k = 0; k < 3; ++k) size = std::max(size, std::abs(space.point(place)[k] - centre[k]));
    size = std::max(size, std::abs(space.moment(place)));
  }
  Matrix modes = Matrix::Zero(static_cast<int>(unknowns.size()), withRotation ? 3 : 2);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const Point& p = space.point(unknowns[i]);
    const Point& d = space.direction(unknowns[i]);
    const int row = static_cast<int>(i);
    modes(row, 0) = d[0];
    modes(row, 1) = d[1];
    if (withRotation && size > 0.0)
      modes(row, 2) = (d[1] * (p[0] - centre[0]) - d[0] * (p[1] - centre[1]) + space.moment(unknowns[i])) / size;
  }
  return modes;
}

/// Columns: one, and if asked for the place along the line.
Matrix momentsAlong(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withFirst) {
  const int n = static_cast<int>(unknowns.size());
  Matrix moments = Matrix::Ones(n, withFirst && n > 1 ? 2 : 1);
  if (moments.cols() == 1) return moments;
  moments(0, 1) = 0.0;
  for (int i = 1; i < n; ++i) {
    const Point &a = space.point(unknowns[i - 1]), &b = space.point(unknowns[i]);
    moments(i, 1) = moments(i - 1, 1) + std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  const double length = moments(n - 1, 1);
  moments.col(1).array() -= moments.col(1).mean();
  moments.col(1) /= length;
  return moments;
}

std::vector<Matrix> momentRows(const InterfaceSpace& space, bool first) {
  std::vector<Matrix> all;
  for (const InterfaceEdge& edge : space.edges()) {
    const Matrix modes = edge.contact ? momentsAlong(space, edge.unknowns, first) : rigidMotions(space, edge.unknowns, first);
    all.push_back(orthonormalBasis(withFlux(space, edge.unknowns, modes), 1e-8).transpose());
  }
  return all;
}

}  // namespace

std::vector<Matrix> NoEdgeConstraints::rows(const InterfaceSpace& space, const LocalProblems&, const Weighting&) const {
  std::vector<Matrix> all;
  for (const InterfaceEdge& edge : space.edges()) all.emplace_back(0, static_cast<int>(edge.unknowns.size()));
  return all;
}

std::vector<Matrix> EdgeAverages::rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const {
  return stiff_.addedTo(momentRows(space, false), space, locals, weighting);
}

std::vector<Matrix> EdgeRigidModes::rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const {
  return stiff_.addedTo(momentRows(space, true), space, locals, weighting);
}

void registerBuiltIns(Registry<EdgeConstraints>& registry) {
  const auto add = [&](const char* name, const char* doc, auto make) {
    registry.add(name, Schema(doc), [make](const Parameters&) { return make(); });
  };
  add("None", "Corners only.", [] { return std::unique_ptr<EdgeConstraints>(std::make_unique<NoEdgeConstraints>()); });
  add("Averages",
      "The average of each component; on contact lines of the normal displacement. With a Poisson ratio above 0.45 also the volume "
      "that flows through.",
      [] { return std::unique_ptr<EdgeConstraints>(std::make_unique<EdgeAverages>()); });
  add("Rigid Modes", "Averages and the first moment: all rigid motions of the edge.",
      [] { return std::unique_ptr<EdgeConstraints>(std::make_unique<EdgeRigidModes>()); });
  registry.add("Adaptive", AdaptiveEdges::schema(),
               [](const Parameters& own) { return std::make_unique<AdaptiveEdges>(own.get<double>("Threshold")); });
}

}  // namespace suture
