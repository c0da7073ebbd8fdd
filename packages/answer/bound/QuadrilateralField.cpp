#include <Eigen/LU>
#include <suture/answer/bound/NodalSums.hpp>
#include <suture/answer/bound/QuadrilateralField.hpp>
#include <suture/answer/bound/SimplexField.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/mesh/GaussRule.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

namespace suture {

namespace {

// Deviation of nodes from an affine map, relative to the size of the cell, that is round-off.
constexpr double kAffine = 1e-11;
// Relative errors of integrals on cells with and without an affine map.
constexpr double kRoundOffInCell = 4e-15, kIntegrated = 1e-13;
constexpr double kLogarithm = -35.0;  // logarithm of the error for which the number of points is chosen: 1e-2 kIntegrated
constexpr int kMostPoints = 128;      // per direction
constexpr int kStepOfPoints = 16;     // larger numbers of points are multiples of it: fewer rules
constexpr double kFlatCorner = 1e9;   // ratio of determinants above which the number of points does not change
constexpr double kFound = 1e-14;      // step of Newton's method in the reference cell that is round-off
constexpr int kMostNewtonSteps = 20;

using Jets = std::array<ShapeJet, 9>;

ReferenceElement tensorRule(Cell cell, int points) {
  const LineRule line = gaussRule(points);
  ReferenceElement rule;
  rule.nodes = cellInfo(cell).nodes;
  rule.dimension = 2;
  rule.points = points * points;
  Jets jets;
  for (int q = 0; q < rule.points; ++q) {
    const double x[2] = {line.points[q % points], line.points[q / points]};
    rule.weights.push_back(line.weights[q % points] * line.weights[q / points]);
    rule.places.insert(rule.places.end(), x, x + 2);
    shapeJets(cell, {x[0], x[1], 0.0}, jets.data());
    for (int i = 0; i < rule.nodes; ++i) {
      rule.values.push_back(jets[i].value);
      rule.gradients.insert(rule.gradients.end(), jets[i].gradient.begin(), jets[i].gradient.begin() + 2);
    }
  }
  return rule;
}

const ReferenceElement& tensorRuleOf(Cell cell, int points) {
  static std::mutex guard;
  static std::map<std::pair<Cell, int>, ReferenceElement> rules;
  const std::lock_guard<std::mutex> lock(guard);
  const auto found = rules.find({cell, points});
  return found != rules.end() ? found->second : rules.emplace(std::make_pair(cell, points), tensorRule(cell, points)).first->second;
}

Jets jetsAt(Cell cell, const Point& place) {
  Jets jets;
  shapeJets(cell, place, jets.data());
  return jets;
}

/// Shape functions and gradients at the centre of the reference cell.
const Jets& jetsAtCentre(Cell cell) {
  static const Jets four = jetsAt(Cell::Quadrilateral4, {0, 0, 0}), eight = jetsAt(Cell::Quadrilateral8, {0, 0, 0}),
                    nine = jetsAt(Cell::Quadrilateral9, {0, 0, 0});
  return cell == Cell::Quadrilateral4 ? four : cell == Cell::Quadrilateral8 ? eight : nine;
}

Eigen::Vector3d strainOf(const Eigen::Matrix2d& slope) { return {slope(0, 0), slope(1, 1), slope(0, 1) + slope(1, 0)}; }

}  // namespace

QuadrilateralField::QuadrilateralField(const CellBlock& block, int element, const CellParts<2>& parts, bool isCurved)
    : block_(block), element_(element), parts_(parts), isCurved_(isCurved) {
  const Span<const int> nodes = block.nodesOf(element);
  places_.resize(2, int(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int k = 0; k < 2; ++k) places_(k, int(i)) = block.coordinates[std::size_t(nodes[i]) * 2 + k];
  findAffinity();
  if (!isAffine_ && !isCurved_) findSpread();
}

void QuadrilateralField::findAffinity() {
  const Cell cell = block_.cells[element_];
  const Jets& jets = jetsAtCentre(cell);
  const Eigen::Matrix2d map = jacobianOf(jets, places_);
  centre_ = valueOf(jets, places_);
  slope_ = map.inverse();
  double deviation = 0.0;
  for (int i = 0; i < int(places_.cols()); ++i) {
    const Point at = referencePoint(cell, i);
    deviation = std::max(deviation, (centre_ + map * Eigen::Vector2d(at[0], at[1]) - places_.col(i)).cwiseAbs().maxCoeff());
  }
  isAffine_ = deviation <= kAffine * (places_.rowwise().maxCoeff() - places_.rowwise().minCoeff()).maxCoeff();
}

void QuadrilateralField::findSpread() {
  const Cell cell = block_.cells[element_];
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (int v = 0; v < 4; ++v) {
    const double determinant = jacobianOf(jetsAt(cell, referencePoint(cell, v)), places_).determinant();
    least = std::min(least, determinant);
    most = std::max(most, determinant);
  }
  spread_ = most > kFlatCorner * least ? kFlatCorner : most / least;
}

/// Reference point of the middle of the diagonal: on an affine map that of the reference cell, else by Newton's method.
Point QuadrilateralField::newNode() const {
  const Cell cell = block_.cells[element_];
  const std::array<int, 2>& diagonal = parts_.diagonals.front();
  Point at = scaled(0.5, plus(referencePoint(cell, diagonal[0]), referencePoint(cell, diagonal[1])));
  if (isAffine_ || isCurved_) return at;
  const Eigen::Vector2d target = 0.5 * (places_.col(diagonal[0]) + places_.col(diagonal[1]));
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const Jets jets = jetsAt(cell, at);
    const Eigen::Vector2d change = jacobianOf(jets, places_).inverse() * (target - valueOf(jets, places_));
    at[0] += change[0], at[1] += change[1];
    if (change.norm() < kFound) break;
  }
  return at;
}

int QuadrilateralField::points() const {
  const int least = cellInfo(block_.cells[element_]).order + 1;
  if (isAffine_) return least;
  const double root = std::sqrt(std::max(1.0 + 1e-6, spread_)), decay = 2.0 * std::log((root + 1) / (root - 1));
  const int count = least + 1 + int(std::ceil(-kLogarithm / decay));
  return count <= kStepOfPoints ? count : (count + kStepOfPoints - 1) / kStepOfPoints * kStepOfPoints;
}

InterpolantDifference QuadrilateralField::set(const Nodal& displacement, const Stiffness& stiffness, bool loaded,
                                              BoundElement<2>* simplices) const {
  using Nodes = SimplexNodes<2>;
  const Cell cell = block_.cells[element_];
  const Jets& jets = jetsAtCentre(cell);
  const Eigen::Matrix2d slope = jacobianOf(jets, displacement) * slope_;
  // Without the affine function mean + slope (x - centre).
  Nodal rest = displacement - slope * (places_.colwise() - centre_);
  rest.colwise() -= valueOf(jets, displacement);
  const Eigen::Vector3d affineStress = stiffness * strainOf(slope);
  const Eigen::Vector2d atNew = valueOf(isAffine_ ? jets : jetsAt(cell, newNode()), rest);
  InterpolantDifference onTriangles;
  for (std::size_t t = 0; t < parts_.parts.size(); ++t) {
    BoundElement<2>& own = simplices[t];
    const SimplexField<2> field(own.places);
    SimplexField<2>::Nodal values;
    for (int i = 0; i < Nodes::most; ++i) {
      const int node = parts_.parts[t].nodes[i];
      if (node < 0) {
        const auto& ends = Nodes::ends[i - 3];
        values.col(i) = 0.5 * (values.col(ends[0]) + values.col(ends[1]));
      } else {
        values.col(i) = node < int(rest.cols()) ? Eigen::Vector2d(rest.col(node)) : atNew;
      }
    }
    own.stresses = stiffness * field.strains(values, 2);
    onTriangles.square += field.energy(own.stresses, own.compliance);
    if (loaded) onTriangles.functional -= 2 * field.forcesOfSources(own.sources, 2).cwiseProduct(values).sum();
    own.stresses.colwise() += affineStress;
  }
  // Bilinear functions on parallelograms are polynomials of second order.
  if (isCurved_ || (cell == Cell::Quadrilateral4 && isAffine_)) return {};
  InterpolantDifference difference = inCell(rest, stiffness, loaded ? simplices : nullptr);
  // Both have the same values on the sides of the cell, hence the same mean strain: the affine function has no part in the difference.
  const double unsure = (isAffine_ ? kRoundOffInCell : kIntegrated) * (difference.square + std::abs(difference.functional));
  difference.square -= onTriangles.square;
  difference.functional += difference.square - onTriangles.functional + unsure;
  difference.isAccurate = points() <= kMostPoints;
  return difference;
}

/// Square of a displacement, and minus twice the work of the sources: affine functions of the place. \param loaded  null: no sources
InterpolantDifference QuadrilateralField::inCell(const Nodal& rest, const Stiffness& stiffness, const BoundElement<2>* loaded) const {
  Eigen::Vector2d source = Eigen::Vector2d::Zero(), at = source;
  Eigen::Matrix2d sourceSlope = Eigen::Matrix2d::Zero();
  if (loaded) {
    source = loaded->sources.col(0), at = loaded->places.col(0);
    const Eigen::Matrix2d edges = loaded->places.rightCols<2>().colwise() - at, changes = loaded->sources.rightCols<2>().colwise() - source;
    sourceSlope = changes * edges.inverse();
  }
  InterpolantDifference sums;
  const ReferenceElement& points = tensorRuleOf(block_.cells[element_], std::min(this->points(), kMostPoints));
  ElementMap<2> map(block_, element_, points);
  for (int q = 0; q < points.points; ++q) {
    map.at(q);
    Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
    for (int i = 0; i < int(rest.cols()); ++i) slope += rest.col(i) * Eigen::Map<const Eigen::RowVector2d>(map.gradient(i));
    const Eigen::Vector3d strain = strainOf(slope);
    sums.square += map.measure() * strain.dot(stiffness * strain);
    if (!loaded) continue;
    Eigen::Vector2d value = Eigen::Vector2d::Zero(), place = Eigen::Vector2d::Zero();
    for (int i = 0; i < int(rest.cols()); ++i)
      value += points.valuesAt(q)[i] * rest.col(i), place += points.valuesAt(q)[i] * places_.col(i);
    sums.functional -= 2 * map.measure() * value.dot(source + sourceSlope * (place - at));
  }
  return sums;
}

}  // namespace suture
