#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <suture/answer/bound/BoundParts.hpp>
#include <suture/answer/bound/PressedSides.hpp>
#include <suture/answer/bound/SplitQuadrilateral.hpp>
#include <suture/answer/bound/SplitSolid.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/SideMap.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr const char* kTooDistorted = "elements are so distorted that their energies are not known exactly";

Eigen::Matrix3d slopeTimes(const Eigen::Vector3d& x) {
  Eigen::Matrix3d all;
  all << 0, -x[2], x[1], x[2], 0, -x[0], -x[1], x[0], 0;
  return all;
}

/// Adds forces with given resultants about the mean of some nodes, of least norm.
void addResultants(const std::vector<int>& at, const Eigen::Matrix3Xd& places, const Eigen::Vector3d& force, const Eigen::Vector3d& moment,
                   const Eigen::Vector3d& origin, Eigen::Matrix3Xd& forces) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int node : at) centre += places.col(node) / double(at.size());
  const Eigen::Vector3d about = moment + (origin - centre).cross(force);
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (const int node : at) {
    const Eigen::Matrix3d arm = slopeTimes(places.col(node) - centre);
    inertia -= arm * arm;
  }
  const Eigen::Vector3d turn = inertia.ldlt().solve(about);
  for (const int node : at) forces.col(node) += force / double(at.size()) + turn.cross(Eigen::Vector3d(places.col(node) - centre));
}

Eigen::Matrix<double, 6, 1> strainOfSlope(const Eigen::Matrix3d& s) {
  Eigen::Matrix<double, 6, 1> e;
  e << s(0, 0), s(1, 1), s(2, 2), s(0, 1) + s(1, 0), s(1, 2) + s(2, 1), s(0, 2) + s(2, 0);
  return e;
}

}  // namespace

Eigen::Matrix3Xd placesOfParts(const CellBlock& block, int element, const CellParts<3>& parts) {
  const Span<const int> nodes = block.nodesOf(element);
  Eigen::Matrix3Xd places(3, int(nodes.size() + parts.diagonals.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Point p = block.point(nodes[i]);
    places.col(int(i)) << p[0], p[1], p[2];
  }
  for (std::size_t d = 0; d < parts.diagonals.size(); ++d)
    places.col(int(nodes.size() + d)) = 0.5 * (places.col(parts.diagonals[d][0]) + places.col(parts.diagonals[d][1]));
  return places;
}

void moveCentreForces(Cell type, const CellParts<3>& parts, const Eigen::Matrix3Xd& places, Eigen::Matrix3Xd& forces) {
  const CellInfo& cell = cellInfo(type);
  for (std::size_t d = 0; d < parts.diagonals.size(); ++d) {
    const int from = middleOf(type, parts.diagonals[d][0], parts.diagonals[d][1]), to = cell.nodes + int(d);
    if (from < 0) continue;
    const Eigen::Vector3d force = forces.col(from), moment = (places.col(from) - places.col(to)).cross(force);
    forces.col(to) += force;
    forces.col(from).setZero();
    const int side = sideThrough(cell, parts.diagonals[d].data(), 2);
    std::vector<int> around;
    for (int v = 0; v < cell.vertices; ++v)
      if (side < 0 || std::count(cell.sideNodes[side].begin(), cell.sideNodes[side].end(), v) > 0) around.push_back(v);
    addResultants(around, places, Eigen::Vector3d::Zero(), moment, places.col(to), forces);
  }
}

SplitSolid::SplitSolid(BoundedField<3>& field, int m, int element, const CellParts<3>& parts, const SideConditions<3>& conditions,
                       const SharedStresses& shared)
    : field_(field),
      m_(m),
      element_(element),
      parts_(parts),
      conditions_(conditions),
      shared_(shared),
      mesh_(field.mesh()),
      cell_(cellInfo(mesh_.cells[element])),
      nodes_(mesh_.nodesOf(element)),
      places_(placesOfParts(mesh_, element, parts)),
      solid_(mesh_, element) {
  findSides();
}

void SplitSolid::findSides() {
  for (int s = 0; s < int(cell_.sideNodes.size()); ++s) {
    const std::vector<int>& own = cell_.sideNodes[s];
    if (std::count_if(own.begin(), own.end(), [&](int node) { return node < cell_.vertices; }) != 4) continue;
    int diagonal = -1, isOdd = 0;
    for (std::size_t d = 0; d < parts_.diagonals.size(); ++d)
      for (int odd = 0; odd < 2; ++odd)
        if (std::minmax(own[std::size_t(odd)], own[std::size_t(odd) + 2]) == std::minmax(parts_.diagonals[d][0], parts_.diagonals[d][1]))
          diagonal = int(d), isOdd = odd;
    std::vector<Point> points;
    for (const int node : own) points.push_back(mesh_.point(nodes_[node]));
    std::vector<int> nodes = own;
    if (own.size() > 4) nodes.push_back(cell_.nodes + diagonal);
    sides_.push_back({s, nodes, SplitSide(points, isOdd != 0)});
  }
}

void SplitSolid::makeSimplices(SplitElement<3>& result, double& oscillation) {
  const SimplexLaw<3>& law = field_.lawOf(element_);
  bool isFolded = false;
  for (const auto& part : parts_.parts) {
    BoundElement<3>& own = result.simplices.emplace_back();
    for (int i = 0; i < 4; ++i) {
      own.vertices[i] = mesh_.globalNodes[nodes_[part.nodes[i]]];
      own.places.col(i) = places_.col(part.nodes[i]);
    }
    own.compliance = law.compliance;
    const Eigen::Matrix3d map = own.places.rightCols<3>().colwise() - own.places.col(0);
    isFolded = isFolded || !(part.orientation * map.determinant() > 0.0);
    oscillation += field_.sources().setSources(element_, std::abs(map.determinant()) / 6, own);
  }
  if (isFolded) field_.remark("elements are so distorted that their parts overlap");
}

Eigen::Vector3d SplitSolid::atNewNode(const std::array<int, 2>& diagonal) const {
  const Eigen::Vector3d place = 0.5 * (places_.col(diagonal[0]) + places_.col(diagonal[1]));
  const Eigen::Vector3d guess = 0.5 * (solid_.referenceOf(diagonal[0]) + solid_.referenceOf(diagonal[1]));
  const Eigen::Vector3d between = 0.5 * (solid_.rest().col(diagonal[0]) + solid_.rest().col(diagonal[1]));
  const int number = sideThrough(cell_, diagonal.data(), 2);
  Eigen::Vector3d value;
  if (solid_.isCurved() || !solid_.restAt(place, guess, value)) return between;
  for (const OfSide& side : sides_)
    if (side.number == number && !side.geometry.isPlane()) return between;
  return value;
}

/// Values of r at the nodes of the cell, then those of v at the new ones.
Eigen::Matrix3Xd SplitSolid::valuesOnSimplices(const Forces& rest) const {
  Eigen::Matrix3Xd values = Eigen::Matrix3Xd::Zero(3, places_.cols());
  values.leftCols(rest.cols()) = rest;
  for (std::size_t d = 0; d < parts_.diagonals.size() && cell_.order == 2; ++d)
    values.col(int(rest.cols() + d)) = atNewNode(parts_.diagonals[d]);
  return values;
}

void SplitSolid::replaceInner(const OfSide& side, const Forces& rest, const Eigen::Matrix3Xd& values, Eigen::Matrix3Xd& forces,
                              double& work) const {
  const SplitSide& geometry = side.geometry;
  const LinearStress& stress = shared_.at(m_, element_, side.number);
  const bool linear = cell_.order == 2 && geometry.isPlane();
  for (int i = 0; i < geometry.nodes(); ++i) {
    const Eigen::Vector3d force = SplitSide::force(stress, geometry.ofCell()[i], linear);
    forces.col(side.nodes[i]) -= force;
    work += force.dot(rest.col(side.nodes[i]));
  }
  for (std::size_t i = 0; i < geometry.ofTriangles().size(); ++i) {
    const Eigen::Vector3d force = SplitSide::force(stress, geometry.ofTriangles()[i], linear);
    forces.col(side.nodes[i]) += force;
    work -= force.dot(values.col(side.nodes[i]));
  }
  if (geometry.isPlane()) return;
  work += geometry.lens() * stress.col(0).dot(strainOfSlope(solid_.slope()));
  if (!shared_.isOneMaterial(m_, element_, side.number)) field_.remark("sides with four vertices between materials are not plane");
}

void SplitSolid::replaceOuter(const OfSide& side, const Forces& rest, const Eigen::Matrix3Xd& values, Eigen::Matrix3Xd& forces,
                              double& work, double& supports) const {
  const SplitSide& geometry = side.geometry;
  if (!geometry.isPlane()) field_.remark("sides with four vertices at the boundary are not plane");
  const LinearStress& stress = shared_.at(m_, element_, side.number);
  const bool linear = cell_.order == 2 && geometry.isPlane();
  const int count = SimplexNodes<3>::sideNodes(cell_.order);
  const Matrix& mass = sideMass(3, cell_.order);
  SideCondition<3> condition;
  Eigen::Matrix3Xd onCell = conditions_.loadsOn(element_, side.number);
  Eigen::Matrix3Xd onTriangles = Eigen::Matrix3Xd::Zero(3, int(geometry.ofTriangles().size()));
  Eigen::Matrix3d known = Eigen::Matrix3d::Zero();
  for (int t = 0; t < 2; ++t) {
    std::vector<int> nodes;
    for (int j = 0; j < count; ++j) {
      const int node = side.nodes[geometry.triangle(t)[j]];
      nodes.push_back(node < cell_.nodes ? nodes_[node] : -1);
    }
    condition = conditions_.of(element_, side.number, nodes);
    if (t == 0)
      for (int k = 0; k < 3; ++k)
        if (condition.known >> k & 1u) known += condition.axes.row(k).transpose() * condition.axes.row(k);
    for (int i = 0; i < count; ++i)
      onTriangles.col(geometry.triangle(t)[i]) += geometry.area(t) * known * (condition.traction.leftCols(count) * mass.col(i));
    if (condition.isSupported()) supports -= supportEnergy(condition, cell_.order, geometry.area(t), condition.moved);
  }
  if (condition.isSupported()) {
    supports += conditions_.supportEnergyOn(element_, side.number, condition);
    if (cell_.order == 2) field_.remark("sides with four vertices of second order are on elastic supports");
  }
  const Eigen::Matrix3d unknown = Eigen::Matrix3d::Identity() - known;
  for (int i = 0; i < geometry.nodes(); ++i) {
    const Eigen::Vector3d given = known * onCell.col(i);
    forces.col(side.nodes[i]) -= given + unknown * SplitSide::force(stress, geometry.ofCell()[i], linear);
    work += given.dot(rest.col(side.nodes[i]));
  }
  for (std::size_t i = 0; i < geometry.ofTriangles().size(); ++i) {
    forces.col(side.nodes[i]) += onTriangles.col(int(i)) + unknown * SplitSide::force(stress, geometry.ofTriangles()[i], linear);
    work -= onTriangles.col(int(i)).dot(values.col(side.nodes[i]));
  }
}

/// The body forces between the bilinear side and the triangles act on one cell before, and on the other one afterwards.
void SplitSolid::addLens(const OfSide& side, Eigen::Matrix3Xd& forces) const {
  const SplitSide& geometry = side.geometry;
  if (geometry.isPlane() || field_.sources().empty()) return;
  const Eigen::Vector3d source = field_.sources().at(element_, geometry.centre());
  addResultants({side.nodes.begin(), side.nodes.begin() + 4}, places_, geometry.lens() * source, geometry.lensMoment().cross(source),
                geometry.centre(), forces);
}

SplitElement<3> SplitSolid::split(double& oscillation) {
  SplitElement<3> result;
  const SimplexLaw<3>& law = field_.lawOf(element_);
  const bool isInitial = field_.initial().isIn(element_), loaded = !field_.sources().empty();
  if (solid_.isCurved()) field_.remark(kCurvedSides);
  if (!solid_.isAccurate()) field_.remark(kTooDistorted);
  makeSimplices(result, oscillation);
  const Forces u = field_.nodalOf(element_, field_.displacement());
  solid_.set(u);
  const Forces& rest = solid_.rest();
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> source;
  if (loaded) source = [&](const Eigen::Vector3d& place) -> Eigen::Vector3d { return field_.sources().at(element_, place); };
  const SolidField::Integrals inCell = solid_.integrals(law.stiffness, source);
  const Eigen::Matrix<double, 6, 1> affineStrain = strainOfSlope(solid_.slope()), affineStress = law.stiffness * affineStrain;

  const Eigen::Matrix3Xd values = valuesOnSimplices(rest);
  double square = 0.0, work = 0.0, affineWork = 0.0, volume = 0.0;
  Eigen::Matrix<double, 6, 1> strain = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t t = 0; t < result.simplices.size(); ++t) {
    BoundElement<3>& own = result.simplices[t];
    const SimplexField<3> simplex(own.places);
    SimplexField<3>::Nodal nodal = SimplexField<3>::Nodal::Zero();
    for (int i = 0; i < SimplexNodes<3>::nodes(cell_.order); ++i) nodal.col(i) = values.col(parts_.parts[t].nodes[i]);
    const SimplexField<3>::AtVertices strains = simplex.strains(nodal, cell_.order);
    own.stresses = law.stiffness * strains;
    square += simplex.energy(own.stresses, own.compliance);
    strain += simplex.volume() * strains.rowwise().mean();
    volume += simplex.volume();
    own.stresses.colwise() += affineStress;
    if (!loaded) continue;
    Eigen::Matrix<double, 3, 4> sources = own.sources;
    if (cell_.order == 1) sources.colwise() = own.sources.col(0).eval();
    work += simplex.forcesOfSources(sources, cell_.order).cwiseProduct(nodal).sum();
    const SimplexField<3>::Nodal linear = simplex.forcesOfSources(sources, 1);
    for (int i = 0; i < 4; ++i) affineWork += linear.col(i).dot(solid_.affineAt(own.places.col(i)));
  }
  result.square = affineStress.dot(affineStrain) * solid_.volume() + 2 * affineStress.dot(inCell.strain) + inCell.square;
  result.uncertainty = inCell.error;
  double difference = 2 * affineStress.dot(inCell.strain - strain) + inCell.square - square - 2 * (inCell.work - work);
  Eigen::Matrix<double, 6, 1> initialStress = Eigen::Matrix<double, 6, 1>::Zero();
  if (isInitial) {
    initialStress = -result.simplices[0].stresses.col(0);
    for (BoundElement<3>& own : result.simplices) field_.addInitialStress(element_, law, own);
    initialStress += result.simplices[0].stresses.col(0);
    difference += 2 * initialStress.dot(inCell.strain - strain);
  }
  const bool isPlane = std::all_of(sides_.begin(), sides_.end(), [](const OfSide& side) { return side.geometry.isPlane(); });
  if (!isPlane)
    difference += (affineStress + 2 * initialStress).dot(affineStrain) * (solid_.volume() - volume) - 2 * (inCell.affineWork - affineWork);

  const Forces before = field_.forcesOf(element_, field_.balanced(), field_.initial(), law);
  const Forces internal =
      field_.isCorrected() || isInitial ? field_.forcesOf(element_, field_.displacement(), InitialState(), law) : before;
  result.energyOfForm = (result.square - internal.cwiseProduct(u).sum()) / 2;
  Forces onNodes = before;
  field_.sources().subtractForces(element_, nodes_.begin(), int(nodes_.size()), onNodes);
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, places_.cols());
  forces.leftCols(onNodes.cols()) = onNodes;
  double replaced = 0.0, supports = 0.0;
  for (const OfSide& side : sides_) {
    if (conditions_.isInner(element_, side.number))
      replaceInner(side, rest, values, forces, replaced);
    else
      replaceOuter(side, rest, values, forces, replaced, supports);
    addLens(side, forces);
  }
  moveCentreForces(mesh_.cells[element_], parts_, places_, forces);
  result.interpolation = solid_.isCurved() ? 0.0 : difference - 2 * replaced + supports + result.uncertainty;
  for (BoundElement<3>& own : result.simplices) own.forces = forcesOfStresses(own, field_.kind());
  splitForces(parts_, forces, places_, cell_.order, result.simplices.data());
  return result;
}

}  // namespace suture
