#include <Eigen/LU>
#include <suture/answer/bound/NodalSums.hpp>
#include <suture/answer/bound/SolidField.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/mesh/GaussRule.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace suture {

namespace {

// Deviation of nodes from an affine map, and from the map of the vertices, relative to the size of the cell, that is round-off.
constexpr double kAffineSolid = 1e-11, kStraightSolid = 1e-9;
// Relative errors of integrals on cells with and without an affine map.
constexpr double kRoundOffInSolid = 4e-15, kIntegratedInSolid = 1e-4;
constexpr double kLogarithmInSolid = -14.0;  // logarithm of the error for which the number of points is chosen
constexpr double kWithinEllipse = 0.9;       // part of the logarithm of R that is used: away from the zeros
constexpr double kFoundInSolid = 1e-13;      // step of Newton's method in the reference cell that is round-off
constexpr int kNewtonStepsInSolid = 20;

using SolidJets = std::array<ShapeJet, kMostCellNodes>;

/// Image of a point of the cube [-1, 1]^3 in the reference cell, and the determinant.
Point collapsed(Cell cell, const Point& cube, double& determinant) {
  determinant = 1.0;
  if (cell == Cell::Wedge6) {
    const double r = (1 + cube[0]) / 2;
    determinant = (1 - r) / 4;
    return {r, (1 - r) * (1 + cube[1]) / 2, cube[2]};
  }
  if (cell == Cell::Pyramid5) {
    const double z = (1 + cube[2]) / 2;
    determinant = (1 - z) * (1 - z) / 2;
    return {cube[0] * (1 - z), cube[1] * (1 - z), z};
  }
  return cube;
}

ReferenceElement cubeRule(Cell cell, int points) {
  const LineRule line = gaussRule(points);
  ReferenceElement rule;
  rule.nodes = cellInfo(cell).nodes;
  rule.dimension = 3;
  rule.points = points * points * points;
  SolidJets jets;
  for (int q = 0; q < rule.points; ++q) {
    const int i = q % points, j = q / points % points, k = q / (points * points);
    double determinant = 1.0;
    const Point at = collapsed(cell, {line.points[i], line.points[j], line.points[k]}, determinant);
    rule.weights.push_back(line.weights[i] * line.weights[j] * line.weights[k] * determinant);
    rule.places.insert(rule.places.end(), at.begin(), at.end());
    shapeJets(cell, at, jets.data());
    for (int a = 0; a < rule.nodes; ++a) {
      rule.values.push_back(jets[a].value);
      rule.gradients.insert(rule.gradients.end(), jets[a].gradient.begin(), jets[a].gradient.end());
    }
  }
  return rule;
}

const ReferenceElement& cubeRuleOf(Cell cell, int points) {
  static std::mutex guard;
  static std::map<std::pair<Cell, int>, ReferenceElement> rules;
  const std::lock_guard<std::mutex> lock(guard);
  const auto found = rules.find({cell, points});
  return found != rules.end() ? found->second : rules.emplace(std::make_pair(cell, points), cubeRule(cell, points)).first->second;
}

/// Shape functions at the 27 points of the cube with coordinates -1, 0, 1; pyramids: their limits near the apex.
const std::vector<SolidJets>& latticeOf(Cell cell) {
  static std::mutex guard;
  static std::map<Cell, std::vector<SolidJets>> all;
  const std::lock_guard<std::mutex> lock(guard);
  std::vector<SolidJets>& own = all[cell];
  if (!own.empty()) return own;
  for (int q = 0; q < 27; ++q) {
    double unused = 0.0;
    // The determinant of a pyramid does not depend on the height.
    const double height = cell == Cell::Pyramid5 ? -0.5 : double(q / 9 - 1);
    own.emplace_back();
    shapeJets(cell, collapsed(cell, {double(q % 3 - 1), double(q / 3 % 3 - 1), height}, unused), own.back().data());
  }
  return own;
}

SolidJets jetsIn(Cell cell, const Point& at) {
  SolidJets jets;
  shapeJets(cell, at, jets.data());
  return jets;
}

/// The middle of three values becomes the Bernstein coefficient.
void toBernstein(std::array<double, 27>& values) {
  for (const int step : {1, 3, 9})
    for (int q = 0; q < 27; ++q)
      if (q / step % 3 == 1) values[q] = 2 * values[q] - 0.5 * (values[q - step] + values[q + step]);
}

}  // namespace

double rateOf(double k) {
  const double real = std::sqrt(k + std::sqrt(std::max(0.0, k * k - 1)));
  const double ofReal = (real + 1) / std::max(1e-300, real - 1);
  const double z = std::sqrt(k), sine = std::sqrt((1 + 1 / k) / 2), cross = 2 * std::sqrt(z) * sine;
  const double ofComplex = std::sqrt((z + 1 + cross) / std::max(1e-300, z + 1 - cross));
  return std::min(ofReal, ofComplex);
}

SolidField::SolidField(const CellBlock& block, int element) : block_(block), element_(element), cell_(block.cells[element]) {
  const Span<const int> nodes = block.nodesOf(element);
  places_.resize(3, int(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Point p = block.point(nodes[i]);
    places_.col(int(i)) << p[0], p[1], p[2];
  }
  findCurved();
  findAffinity();
  points_ = isCurved_ ? cellInfo(cell_).order + 1 : pointsFor();
}

Eigen::Vector3d SolidField::referenceOf(int node) const {
  const Point p = referencePoint(cell_, node);
  return {p[0], p[1], p[2]};
}

/// Nodes that are no vertices lie at the means of the vertices around them.
void SolidField::findCurved() {
  const CellInfo& cell = cellInfo(cell_);
  const double size = (places_.rowwise().maxCoeff() - places_.rowwise().minCoeff()).maxCoeff();
  for (int i = cell.vertices; i < cell.nodes; ++i) {
    const Eigen::Vector3d at = referenceOf(i);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    int count = 0;
    for (int v = 0; v < cell.vertices; ++v)
      if (((referenceOf(v) - at).array().abs() < 1.5).all()) mean += places_.col(v), ++count;
    if ((mean / count - places_.col(i)).norm() > kStraightSolid * size) isCurved_ = true;
  }
}

void SolidField::findAffinity() {
  const Point at = referenceCentre(cell_);
  const SolidJets jets = jetsIn(cell_, at);
  const Eigen::Matrix3d map = jacobianOf(jets, places_);
  centre_ = valueOf(jets, places_);
  inverse_ = map.inverse();
  for (int i = 0; i < int(places_.cols()); ++i) {
    values_.push_back(jets[i].value);
    gradients_.insert(gradients_.end(), jets[i].gradient.begin(), jets[i].gradient.end());
  }
  double deviation = 0.0;
  for (int i = 0; i < int(places_.cols()); ++i)
    deviation = std::max(deviation, (centre_ + map * (referenceOf(i) - Eigen::Vector3d(at[0], at[1], at[2])) - places_.col(i)).norm());
  isAffine_ = deviation <= kAffineSolid * (places_.rowwise().maxCoeff() - places_.rowwise().minCoeff()).maxCoeff();
}

int SolidField::pointsFor() const {
  const int least = cellInfo(cell_).order + 1;
  if (isAffine_) return least;
  std::array<double, 27> determinants;
  const std::vector<SolidJets>& lattice = latticeOf(cell_);
  for (int q = 0; q < 27; ++q) determinants[q] = jacobianOf(lattice[q], places_).determinant();
  toBernstein(determinants);
  const auto [low, high] = std::minmax_element(determinants.begin(), determinants.end());
  if (!(*low > 0.0)) return kMostPoints + 1;
  return least + 1 + int(std::ceil(-kLogarithmInSolid / (2 * kWithinEllipse * std::log(rateOf(*high / *low)))));
}

void SolidField::set(const Nodal& displacement) {
  mean_.setZero();
  Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
  for (int i = 0; i < int(places_.cols()); ++i) {
    mean_ += values_[std::size_t(i)] * displacement.col(i);
    for (int k = 0; k < 3; ++k) map.col(k) += gradients_[3 * std::size_t(i) + std::size_t(k)] * displacement.col(i);
  }
  slope_ = map * inverse_;
  rest_ = displacement - slope_ * (places_.colwise() - centre_);
  rest_.colwise() -= mean_;
}

bool SolidField::restAt(const Eigen::Vector3d& place, const Eigen::Vector3d& guess, Eigen::Vector3d& value) const {
  Eigen::Vector3d at = guess;
  for (int step = 0; step < kNewtonStepsInSolid; ++step) {
    const SolidJets jets = jetsIn(cell_, {at[0], at[1], at[2]});
    const Eigen::Vector3d change = jacobianOf(jets, places_).inverse() * (place - valueOf(jets, places_));
    if (!change.allFinite()) return false;
    at += change;
    if (change.norm() > kFoundInSolid) continue;
    value = valueOf(jetsIn(cell_, {at[0], at[1], at[2]}), rest_);
    return true;
  }
  return false;
}

SolidField::Integrals SolidField::integrals(const Eigen::Matrix<double, 6, 6>& stiffness,
                                            const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& source) {
  Integrals sums;
  volume_ = 0.0;
  const ReferenceElement& points = cubeRuleOf(cell_, std::min(points_, kMostPoints));
  ElementMap<3> map(block_, element_, points);
  for (int q = 0; q < points.points; ++q) {
    map.at(q);
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (int i = 0; i < int(rest_.cols()); ++i) slope += rest_.col(i) * Eigen::Map<const Eigen::RowVector3d>(map.gradient(i));
    Eigen::Matrix<double, 6, 1> strain;
    strain << slope(0, 0), slope(1, 1), slope(2, 2), slope(0, 1) + slope(1, 0), slope(1, 2) + slope(2, 1), slope(0, 2) + slope(2, 0);
    const double measure = map.measure();
    volume_ += measure;
    sums.strain += measure * strain;
    sums.square += measure * strain.dot(stiffness * strain);
    if (!source) continue;
    const Point p = map.place();
    const Eigen::Vector3d place(p[0], p[1], p[2]), force = measure * source(place);
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    for (int i = 0; i < int(rest_.cols()); ++i) value += points.valuesAt(q)[i] * rest_.col(i);
    sums.work += force.dot(value);
    sums.affineWork += force.dot(affineAt(place));
  }
  sums.error = (isAffine_ ? kRoundOffInSolid : kIntegratedInSolid) * sums.square + kRoundOffInSolid * std::abs(2 * sums.work);
  return sums;
}

}  // namespace suture
