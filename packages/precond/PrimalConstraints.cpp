#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/AdaptiveConstraints.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/Mechanisms.hpp>
#include <suture/precond/VolumetricPrimalModes.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// Adds the flux as a column, if it is nonzero. Nearly incompressible bodies are as stiff as their bulk modulus against jumps that change
/// the volume on one side, and averages of nodal values are not the flux on edges that turn or with nodes of different kinds (Li, Widlund,
/// "BDDC algorithms for incompressible Stokes equations", SIAM J. Numer. Anal. 2006).
Matrix withFlux(const InterfaceSpace& space, const std::vector<int>& unknowns, const Matrix& modes) {
  Vector flux(modes.rows());
  for (int i = 0; i < flux.size(); ++i) flux(i) = space.flux(unknowns[i]);
  const double size = flux.size() > 0 ? flux.cwiseAbs().maxCoeff() : 0.0;
  if (!(size > 0.0)) return modes;
  Matrix all(modes.rows(), modes.cols() + 1);
  all << modes, flux / size;
  return all;
}

/// Columns: one, and optionally the coordinate along the line.
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

/// Columns: one, and optionally the coordinates along the two directions of largest extent of a surface.
Matrix momentsOver(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withFirst) {
  const int n = static_cast<int>(unknowns.size());
  if (!withFirst || n == 1) return Matrix::Ones(n, 1);
  Matrix places(n, 3);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) places(i, k) = space.point(unknowns[i])[k];
  places.rowwise() -= places.colwise().mean().eval();
  const Eigenpairs axes = symmetricEigenpairs(places.transpose() * places);  // ascending
  Matrix moments(n, 3);
  moments << Vector::Ones(n), places * axes.vectors.rightCols(2);
  if (const double size = places.cwiseAbs().maxCoeff(); size > 0.0) moments.rightCols(2) /= size;
  return moments;
}

/// Moments of the normal displacements of closed pairs.
Matrix contactMoments(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withFirst) {
  return space.dimension() == 2 ? momentsAlong(space, unknowns, withFirst) : momentsOver(space, unknowns, withFirst);
}

}  // namespace

std::vector<char> verticesAndEnds(const InterfaceSpace& space) {
  std::vector<char> alone(space.overlapSize(), 0);
  for (const InterfaceEntity& entity : space.entities())
    for (const int place : entity.kind == EntityKind::Vertex ? entity.unknowns : entity.ends) alone[place] = 1;
  return alone;
}

PrimalChoice PrimalConstraints::choose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const {
  PrimalChoice choice = doChoose(space, locals, weighting);
  stopMechanisms(space, locals, choice);
  return choice;
}

PrimalChoice VertexConstraints::doChoose(const InterfaceSpace& space, const LocalProblems&, const Weighting&) const {
  PrimalChoice choice{verticesAndEnds(space), {}};
  for (const InterfaceEntity& entity : withoutAlone(space, choice.alone))
    choice.rows.emplace_back(0, static_cast<int>(entity.unknowns.size()));
  return choice;
}

PrimalChoice MomentConstraints::doChoose(const InterfaceSpace& space, const LocalProblems&, const Weighting&) const {
  PrimalChoice choice{verticesAndEnds(space), {}};
  for (const InterfaceEntity& entity : withoutAlone(space, choice.alone)) {
    if (entity.unknowns.empty()) {
      choice.rows.emplace_back(0, 0);
      continue;
    }
    const bool isSeam = entity.kind == (space.dimension() == 2 ? EntityKind::Edge : EntityKind::Face);
    // A body may be held by few sticking pairs of one contact edge; their average would let it turn.
    const bool withFirst = first_ == First::Everywhere || (first_ == First::OnSeams && (isSeam || entity.contact));
    const Matrix modes =
        entity.contact ? contactMoments(space, entity.unknowns, withFirst) : rigidMotionsOf(space, entity.unknowns, withFirst);
    choice.rows.push_back(orthonormalBasis(withFlux(space, entity.unknowns, modes), 1e-8).transpose());
  }
  return choice;
}

namespace {
std::unique_ptr<PrimalConstraints> withMoments(MomentConstraints::First first) {
  return std::make_unique<VolumetricPrimalModes>(std::make_unique<MomentConstraints>(first));
}
}  // namespace

std::unique_ptr<PrimalConstraints> automaticConstraints() { return withMoments(MomentConstraints::First::OnSeams); }

void registerBuiltIns(Registry<PrimalConstraints>& registry) {
  registry.add("Automatic",
               Schema("In 2D as Rigid Modes; in 3D averages on edges, all rigid motions on faces, and first moments on contact edges."),
               [](const Parameters&) { return automaticConstraints(); });
  registry.add("None", Schema("Vertices and ends of edges only. In 3D subdomains with few vertices are not held."),
               [](const Parameters&) { return std::make_unique<VertexConstraints>(); });
  registry.add(
      "Averages",
      Schema("The average of each displacement component; on contact surfaces of the normal displacement. With a Poisson ratio above "
             "0.45 also the volume flux."),
      [](const Parameters&) { return withMoments(MomentConstraints::First::Nowhere); });
  registry.add("Rigid Modes", Schema("Averages and first moments: all rigid motions of edges and faces."),
               [](const Parameters&) { return withMoments(MomentConstraints::First::Everywhere); });
  registry.add("Adaptive", AdaptiveConstraints::schema(),
               [](const Parameters& own) { return std::make_unique<AdaptiveConstraints>(own.get<double>("Threshold")); });
}

}  // namespace suture
