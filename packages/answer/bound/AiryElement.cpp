#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <suture/answer/bound/AiryElement.hpp>
#include <suture/answer/bound/AlfeldStresses.hpp>
#include <suture/answer/bound/SmallProducts.hpp>
#include <suture/answer/bound/StressElement.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Part of the energy of a free stress that is independent of the others, below which it is lost in round-off.
constexpr double kLostFreeStress = 1e-13;

// Longest edge over height of triangles whose energies are summed as squares, because products with a Gram matrix lose digits.
constexpr double kFlatTriangle = 30.0;

bool isFlatTriangle(const Eigen::Matrix2d& map) {
  const double longest = std::max({map.col(0).squaredNorm(), map.col(1).squaredNorm(), (map.col(0) - map.col(1)).squaredNorm()});
  return longest > kFlatTriangle * std::abs(map.determinant());
}

const double kReferenceLengths[3] = {std::sqrt(2.0), 1.0, 1.0};

/// Sides of the reference triangle: origin and unit vectors.
AirySide referenceSide(int a) {
  const Eigen::Vector2d vertices[3] = {{0, 0}, {1, 0}, {0, 1}};
  const Eigen::Vector2d from = vertices[a == 0 ? 1 : 0], to = vertices[a == 2 ? 1 : 2], difference = to - from;
  AirySide side;
  side.length = difference.norm();
  side.normal = Eigen::Vector2d(difference[1], -difference[0]) / side.length;
  side.sign = side.normal.dot(from - vertices[a]) > 0 ? 1.0 : -1.0;
  return side;
}

}  // namespace

template <int K>
const AiryElement<K>& AiryElement<K>::reference() {
  static const AiryElement element;
  return element;
}

template <int K>
AiryElement<K>::AiryElement() {
  const AlfeldStresses<2> stresses(K);
  constexpr int nodes = K == 1 ? 3 : 6, tractions = 3 * sideData;
  const Matrix root = Matrix(SimplexBasis<2>(K).mass() / 6).llt().matrixL();  // parts of a third of the reference triangle
  Matrix change = Matrix::Zero(tractions, dofs);
  for (int a = 0; a < 3; ++a) {
    const AirySide side = referenceSide(a);
    const SideTractions own = side.sign * tractionsOf(side, Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity());
    const int ends[2] = {a == 0 ? 1 : 0, a == 2 ? 1 : 2};
    for (int end = 0; end < 2; ++end) change.block(sideData * a, 3 * ends[end], sideData, 3) = own.middleCols(3 * end, 3);
    change.block(sideData * a, 9 + onSide * a, sideData, onSide) = own.rightCols(onSide);
  }
  Matrix all(stresses.unknowns, data + columns);
  all << stresses.particular, stresses.free, stresses.particular.leftCols(tractions) * change;
  Matrix sorted(rows, all.cols());  // component by component
  for (int q = 0; q < 3; ++q)
    for (int part = 0; part < 3; ++part) {
      Matrix own(nodes, all.cols());
      for (int node = 0; node < nodes; ++node) own.row(node) = all.row((part * nodes + node) * 3 + q);
      sorted.middleRows(values * q + nodes * part, nodes) = root.transpose() * own;
    }
  ofData_.setZero();
  ofData_.template topRows<rows>() = sorted.leftCols(data);
  ofUnknowns_.setZero();
  ofUnknowns_.template topRows<columns>() = sorted.rightCols(columns).transpose();
  tables_.setZero();
  int pair = 0;
  for (int b = 0; b < 3; ++b)
    for (int a = 0; a <= b; ++a, ++pair) {
      Matrix products = sorted.block(values * a, data, values, columns).transpose() * sorted.block(values * b, data, values, columns);
      if (a != b) products = (products + products.transpose()).eval();
      for (int i = 0, at = 0; i < columns; ++i)
        for (int j = 0; j <= i; ++j) tables_(at++, pair) = products(i, j);
    }
}

template <int K>
typename AiryElement<K>::SideTractions AiryElement<K>::tractionsOf(const AirySide& side, const Eigen::Matrix2d& first,
                                                                   const Eigen::Matrix2d& second) {
  const double length = side.length;
  const Eigen::Vector2d normal = side.normal, along = side.along();
  SideTractions all;
  for (int j = 0; j <= K; ++j) {
    const double r = j == 2 ? 0.5 : j;
    // Derivatives along the side of the slope along it and of the slope along the normal.
    Eigen::Matrix<double, 6 + onSide, 1> inSlope, ofNormal;
    inSlope.setZero(), ofNormal.setZero();
    inSlope[0] = (12 * r - 6) / (length * length);
    inSlope[3] = -inSlope[0];
    for (int end = 0; end < 2; ++end) {
      const Eigen::Matrix2d& frame = end == 0 ? first : second;
      const double slope = (end == 0 ? 6 * r - 4 : 6 * r - 2) / length, turn = (end == 0 ? -1 : 1) / length;
      for (int k = 0; k < 2; ++k) {
        inSlope[3 * end + 1 + k] = slope * frame.col(k).dot(along);
        ofNormal[3 * end + 1 + k] = turn * frame.col(k).dot(normal);
      }
    }
    if constexpr (K == 1) {
      ofNormal[6] = 4 * (1 - 2 * r) / length;
    } else {
      inSlope[6] = 16 * (2 - 12 * r + 12 * r * r) / (length * length);
      ofNormal[7] = 4 * (1 - 2 * r) / length;
      ofNormal[8] = (-6 * r * r + 6 * r - 1) / length;
    }
    // The traction is the derivative along the side of the gradient, turned by a right angle.
    all.row(2 * j) = (along[1] * inSlope + normal[1] * ofNormal).transpose();
    all.row(2 * j + 1) = -(along[0] * inSlope + normal[0] * ofNormal).transpose();
  }
  return all;
}

/// Data of the difference from the stress of the displacement, on the reference triangle: outward tractions t |e| = F t_ref |e_ref|,
/// sources f |det F| = F f_ref.
template <int K>
typename AiryElement<K>::Data AiryElement<K>::referenceData(const BoundElement<2>& element, const Sides& sides, const Map& inverse,
                                                            double volume, const Eigen::Matrix<double, sideData, 3>& tractions) const {
  Data all;
  const auto& s = element.stresses;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector2d& n = sides[a].normal;
    const int ends[2] = {a == 0 ? 1 : 0, a == 2 ? 1 : 2};
    Eigen::Matrix<double, 2, K + 1> difference = Eigen::Map<const Eigen::Matrix<double, 2, K + 1>>(tractions.col(a).data());
    Eigen::Matrix<double, 2, 2> computed;
    for (int end = 0; end < 2; ++end) {
      const auto at = s.col(ends[end]);
      computed.col(end) << at[0] * n[0] + at[2] * n[1], at[2] * n[0] + at[1] * n[1];
    }
    difference.template leftCols<2>() -= computed;
    if constexpr (K == 2) difference.col(2) -= 0.5 * (computed.col(0) + computed.col(1));
    const Eigen::Matrix<double, 2, K + 1> own = (sides[a].sign * sides[a].length / kReferenceLengths[a] * inverse) * difference;
    all.template segment<sideData>(sideData * a) = Eigen::Map<const Eigen::Matrix<double, sideData, 1>>(own.data());
  }
  Eigen::Vector2d divergence = Eigen::Vector2d::Zero();
  for (int i = 1; i < 3; ++i) {  // the gradient of coordinate i is a row of the inverse
    const Eigen::Vector3d d = s.col(i) - s.col(0);
    const double x = inverse(i - 1, 0), y = inverse(i - 1, 1);
    divergence += Eigen::Vector2d(d[0] * x + d[2] * y, d[2] * x + d[1] * y);
  }
  for (int j = 0; j < (K == 1 ? 1 : 3); ++j)
    all.template segment<2>(3 * sideData + 2 * j) = volume * (inverse * (element.sources.col(j) + divergence));
  return all;
}

template <int K>
double AiryElement<K>::energyOfFlat(const BoundElement<2>& element, const Sides& sides, const Map& map, const Data& given) {
  Vector physical(data);
  for (int block = 0; block < data / 2; ++block) {
    const int a = block / (K + 1);
    const double scale = a < 3 ? kReferenceLengths[a] / sides[a].length : 1.0 / std::abs(map.determinant());
    physical.segment<2>(2 * block) = scale * (map * given.template segment<2>(2 * block));
  }
  return StressElement<2>::of(K).energy(map, element.compliance, physical);
}

/// From functions of the unknowns on the reference triangle to those of the unknowns on a triangle: the unknowns there are the same value,
/// the gradient F^T g, and of a side the slope along F n, n the normal of the reference side. \param scale  of the stresses
template <int K>
template <int Rows>
void AiryElement<K>::toUnknowns(const Map& map, double scale, const Sides& sides, const Frames& frames,
                                const Eigen::Matrix<double, Rows, dofs>& of, Eigen::Matrix<double, Rows, dofs>& result) {
  using Column = Eigen::Matrix<double, Rows, 1>;
  Column gradients[3][2];  // functions of the Cartesian gradient at the vertices
  for (int i = 0; i < 3; ++i) {
    result.col(3 * i) = scale * of.col(3 * i);
    for (int k = 0; k < 2; ++k) gradients[i][k] = scale * (map(k, 0) * of.col(3 * i + 1) + map(k, 1) * of.col(3 * i + 2));
  }
  for (int a = 0; a < 3; ++a) {
    static const AirySide ofReference[3] = {referenceSide(0), referenceSide(1), referenceSide(2)};
    const Eigen::Vector2d slope = map * ofReference[a].normal, along = sides[a].along();
    const double alongNormal = scale * slope.dot(sides[a].normal), alongSide = scale * slope.dot(along), length = sides[a].length;
    const int first = a == 0 ? 1 : 0, second = a == 2 ? 1 : 2, at = 9 + onSide * a;
    const Column bubble = alongSide * of.col(K == 1 ? at : at + 1);
    result.col(3 * first) -= 1.5 / length * bubble;
    result.col(3 * second) += 1.5 / length * bubble;
    for (int k = 0; k < 2; ++k) {
      gradients[first][k] -= 0.75 * along[k] * bubble;
      gradients[second][k] -= 0.75 * along[k] * bubble;
    }
    if constexpr (K == 1) {
      result.col(at) = alongNormal * of.col(at);
    } else {
      result.col(at) = scale * of.col(at) - 32 / length * alongSide * of.col(at + 2);
      result.col(at + 1) = alongNormal * of.col(at + 1);
      result.col(at + 2) = alongNormal * of.col(at + 2);
    }
  }
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) result.col(3 * i + 1 + k) = frames[i](0, k) * gradients[i][0] + frames[i](1, k) * gradients[i][1];
}

template <int K>
typename AiryElement<K>::Energy AiryElement<K>::energy(const BoundElement<2>& element, const Sides& sides, const Frames& frames,
                                                       const Eigen::Matrix<double, sideData, 3>& tractions) const {
  Map map;
  map << element.places.col(1) - element.places.col(0), element.places.col(2) - element.places.col(0);
  const double volume = std::abs(map.determinant());
  const Map inverse = map.inverse();
  // Stresses s = F r F^T / |det F| of reference stresses r.
  Eigen::Matrix3d stresses;
  stresses << map(0, 0) * map(0, 0), map(0, 1) * map(0, 1), 2 * map(0, 0) * map(0, 1),  //
      map(1, 0) * map(1, 0), map(1, 1) * map(1, 1), 2 * map(1, 0) * map(1, 1),          //
      map(0, 0) * map(1, 0), map(0, 1) * map(1, 1), map(0, 0) * map(1, 1) + map(0, 1) * map(1, 0);
  const Eigen::Matrix3d product = stresses.transpose() * element.compliance * stresses / volume;
  const Eigen::Matrix3d compliance = 0.5 * (product + product.transpose());
  const Data given = referenceData(element, sides, inverse, volume, tractions);
  Eigen::Matrix<double, paddedRows, 1> stress;
  combineColumns(paddedRows, data, ofData_.data(), given.data(), stress.data());
  Eigen::Matrix<double, values, 3> strain;
  const Eigen::Map<const Eigen::Matrix<double, values, 3>> components(stress.data());
  strain.noalias() = components.lazyProduct(compliance);
  Eigen::Matrix<double, paddedColumns, 1> loads;
  combineColumns(paddedColumns, rows, ofUnknowns_.data(), strain.data(), loads.data());
  Eigen::Matrix<double, table, 1> packedEnergies;
  const double pairs[6] = {compliance(0, 0), compliance(0, 1), compliance(1, 1), compliance(0, 2), compliance(1, 2), compliance(2, 2)};
  combineColumns(table, 6, tables_.data(), pairs, packedEnergies.data());
  Energy result;
  result.start = components.cwiseProduct(strain).sum();
  LocalMatrix onReference, once;
  if constexpr (free > 0) {
    // Symmetric elimination of the free stresses, the first rows and columns.
    const auto row = [&](int i) { return &packedEnergies[i * (i + 1) / 2]; };
    for (int f = 0; f < free; ++f) {
      const double pivot = row(f)[f];
      if (!(pivot > kLostFreeStress * tables_.row(f * (f + 3) / 2).dot(Eigen::Map<const Eigen::Matrix<double, 1, 6>>(pairs)))) continue;
      double column[columns];
      for (int i = f + 1; i < columns; ++i) column[i] = row(i)[f];
      for (int i = f + 1; i < columns; ++i) {
        const double factor = column[i] / pivot;
        for (int j = f + 1; j <= i; ++j) row(i)[j] -= factor * column[j];
        loads[i] -= factor * loads[f];
      }
      result.start -= loads[f] * loads[f] / pivot;
    }
  }
  if (isFlatTriangle(map)) result.start = energyOfFlat(element, sides, map, given);
  for (int i = 0; i < dofs; ++i) {
    const double* row = &packedEnergies[(free + i) * (free + i + 1) / 2 + free];
    for (int j = 0; j <= i; ++j) onReference(i, j) = onReference(j, i) = row[j];
  }
  const double scale = 1.0 / volume;
  toUnknowns<dofs>(map, scale, sides, frames, onReference, once);
  onReference = once.transpose();
  toUnknowns<dofs>(map, scale, sides, frames, onReference, result.matrix);
  const Eigen::Matrix<double, 1, dofs> row = loads.template segment<dofs>(free).transpose();
  Eigen::Matrix<double, 1, dofs> turned;
  toUnknowns<1>(map, scale, sides, frames, row, turned);
  result.loads = turned.transpose();
  return result;
}

template class AiryElement<1>;
template class AiryElement<2>;

}  // namespace suture
