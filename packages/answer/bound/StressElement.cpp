#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <suture/answer/bound/SmallProducts.hpp>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/base/Errors.hpp>

namespace suture {

namespace {

template <int D>
constexpr double referenceVolume = D == 2 ? 0.5 : 1.0 / 6;

/// Outward unit normals of a simplex times the areas of its sides, as columns. The gradient of the barycentric coordinate of vertex a is
/// -(normal of side a) / (height above it), whatever the orientation.
template <int D>
Eigen::Matrix<double, D, D + 1> sideNormals(const Eigen::Matrix<double, D, D + 1>& vertices) {
  const Eigen::Matrix<double, D, D> map = vertices.template rightCols<D>().colwise() - vertices.col(0);
  Eigen::Matrix<double, D, D + 1> normals;
  normals.template rightCols<D>() = -std::abs(map.determinant()) * (D == 2 ? 1.0 : 0.5) * map.inverse().transpose();
  normals.col(0) = -normals.template rightCols<D>().rowwise().sum();
  return normals;
}

template <int D>
double simplexVolume(const Eigen::Matrix<double, D, D + 1>& vertices) {
  const Eigen::Matrix<double, D, D> map = vertices.template rightCols<D>().colwise() - vertices.col(0);
  return referenceVolume<D> * std::abs(map.determinant());
}

/// Product of a symmetric tensor, given by components, with a direction.
template <int D>
Eigen::Matrix<double, D, 1> times(const Eigen::Matrix<double, StressElement<D>::components, 1>& s, const Eigen::Matrix<double, D, 1>& n) {
  Eigen::Matrix<double, D, 1> result = Eigen::Matrix<double, D, 1>::Zero();
  for (int q = 0; q < s.size(); ++q) {
    const auto [i, j] = tensorAxes<D>()[q];
    result(i) += s(q) * n(j);
    if (i != j) result(j) += s(q) * n(i);
  }
  return result;
}

}  // namespace

/// The Piola map s = F r F^T / |det F| of reference stresses r, which preserves symmetry, equilibrium and continuity of tractions. Outward
/// tractions t with areas |e| map by t |e| = F (r n) |e_ref|, sources f by f |det F| = F f_ref.
template <int D>
struct StressElement<D>::Piola {
  Map inverse;
  double volume;                           // volume of the simplex, over that of the reference simplex
  Eigen::Matrix<double, D + 1, 1> areas;   // areas of the sides, likewise
  Compliance stresses;                     // physical components of a reference stress
  Eigen::Matrix<double, pairs, 1> energy;  // energies of pairs of components of reference stresses, times `volume`

  explicit Piola(const Map& map) : inverse(map.inverse()), volume(std::abs(map.determinant())) {
    for (int side = 0; side <= D; ++side) areas(side) = volume * (inverse.transpose() * referenceNormal<D>(side)).norm();
    for (int q = 0; q < components; ++q)
      for (int p = 0; p < components; ++p) {
        const auto [i, j] = tensorAxes<D>()[q];
        const auto [k, l] = tensorAxes<D>()[p];
        stresses(q, p) = (map(i, k) * map(j, l) + (k == l ? 0.0 : map(i, l) * map(j, k))) / volume;
      }
  }
  Piola(const Map& map, const Compliance& compliance) : Piola(map) {
    const Compliance all = volume * (stresses.transpose() * compliance * stresses);
    int pair = 0;
    for (int b = 0; b < components; ++b)
      for (int a = 0; a <= b; ++a) energy(pair++) = 0.5 * (all(a, b) + all(b, a));
  }
  /// Factor from physical to reference data, apart from `inverse`. \param block  D data each
  double factor(int block, int sideNodes) const { return block < (D + 1) * sideNodes ? areas(block / sideNodes) : volume; }
};

/// The free part of the Gram matrix, factorised by a symmetric elimination with pivoting. Free stresses whose energy is lost in round-off
/// (in very flat simplices) remain zero, which keeps the result the energy of a stress with the given data.
template <int D>
struct StressElement<D>::FreePart {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostFree, mostFree>;
  using Coupling = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostFree, mostData>;
  using Amplitudes = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, mostFree, 1>;

  Eigen::LDLT<Square> factor;
  Amplitudes scale, pivots;  // pivots: inverse roots, or zero

  explicit FreePart(const Eigen::Map<const Matrix>& energies) {
    constexpr double kRoundOff = 1e-13;
    scale = energies.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
    factor.compute(scale.asDiagonal() * energies * scale.asDiagonal());
    pivots = factor.vectorD();
    for (double& pivot : pivots) pivot = pivot > kRoundOff ? 1.0 / std::sqrt(pivot) : 0.0;
  }
  /// L^-1 of rows: their Gram matrix is subtracted from that of the particular stresses.
  void halfSolve(Coupling& rows) const {
    rows = factor.transpositionsP() * (scale.asDiagonal() * rows);
    factor.matrixL().solveInPlace(rows);
    rows = pivots.asDiagonal() * rows;
  }
  /// Amplitudes of least energy for their products with the particular stress.
  Amplitudes amplitudes(const Amplitudes& products) const {
    Amplitudes a = factor.transpositionsP() * (scale.asDiagonal() * products);
    factor.matrixL().solveInPlace(a);
    a = pivots.cwiseAbs2().asDiagonal() * a;
    factor.matrixU().solveInPlace(a);
    return -(scale.asDiagonal() * (factor.transpositionsP().transpose() * a));
  }
};

template <int D>
const StressElement<D>& StressElement<D>::of(int degree) {
  if (degree == 1) {
    static const StressElement linear(1);
    return linear;
  }
  if (degree != 2) throw InternalError("StressElement: degree " + std::to_string(degree) + ", expected 1 or 2");
  static const StressElement quadratic(2);
  return quadratic;
}

template <int D>
StressElement<D>::StressElement(int degree)
    : degree_(degree), sideNodes_(SimplexBasis<D - 1>::nodes(degree)), sourceNodes_(degree == 1 ? 1 : D + 1) {
  AlfeldStresses<D> reference(degree);
  particular_ = std::move(reference.particular);
  free_ = std::move(reference.free);
  massRoot_ = Matrix(SimplexBasis<D>(degree).mass() * (referenceVolume<D> / (D + 1))).llt().matrixL();
  const SimplexBasis<D - 1> side(degree);
  sidePlaces_.resize(D, sideNodes_);
  for (int node = 0; node < sideNodes_; ++node) sidePlaces_.col(node) = side.place(node);
  sideMeans_ = side.means();
  sideArms_ = sidePlaces_ * side.mass();
  tabulate();
}

template <int D>
void StressElement<D>::tabulate() {
  const int nodes = int(massRoot_.rows()), count = (D + 1) * nodes;
  Matrix all(unknowns(), data() + free());
  all << particular_, free_;
  // One component of the stresses, in combinations of the basis functions that are orthonormal on the parts.
  const auto component = [&](int q) {
    Matrix rows(count, all.cols());
    for (int i = 0; i < count; ++i) rows.row(i) = all.row(i * components + q);
    for (int part = 0; part <= D; ++part)
      rows.middleRows(part * nodes, nodes) = (massRoot_.transpose() * rows.middleRows(part * nodes, nodes)).eval();
    return rows;
  };
  int length = data() * free() + free() * free();
  for (int j = 0; j < data(); j += D) length += D * (data() - j);
  moments_.resize(length, pairs);
  int pair = 0;
  for (int b = 0; b < components; ++b)
    for (int a = 0; a <= b; ++a, ++pair) {
      Matrix products = component(a).transpose() * component(b);
      if (a != b) products = (products + products.transpose()).eval();
      double* column = moments_.col(pair).data();
      const auto append = [&](int row, int first, int rows, int columns) {
        Eigen::Map<Matrix>(column, rows, columns) = products.block(row, first, rows, columns);
        column += rows * columns;
      };
      for (int j = 0; j < data(); j += D) append(j, j, data() - j, D);
      append(data(), 0, free(), data());
      append(data(), data(), free(), free());
    }
}

template <int D>
void StressElement<D>::gram(const Map& map, const Compliance& compliance, Matrix& result) const {
  constexpr int most = D * D * (mostData / D) * (mostData / D + 1) / 2 + mostFree * (mostData + mostFree);
  const Piola piola(map, compliance);
  const int size = data();
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1> blocks(packed());
  combineColumns(int(packed()), pairs, moments_.data(), piola.energy.data(), blocks.data());
  const double* next = blocks.data();
  result.resize(size, size);
  for (int j = 0; j < size; j += D) {
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, D>> column(next, size - j, D);
    result.block(j, j, size - j, D) = column;
    next += (size - j) * D;
  }
  if (free() > 0) {
    typename FreePart::Coupling rows = Eigen::Map<const Matrix>(next, free(), size);
    const FreePart factorised(Eigen::Map<const Matrix>(next + free() * size, free(), free()));
    factorised.halfSolve(rows);
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostData, mostFree> turned = rows.transpose();
    Eigen::Matrix<double, mostData, 12> product;  // some columns from the diagonal downwards
    for (int j = 0; j < size; j += 12) {
      multiplySmall(size - j, free(), std::min(12, size - j), turned.data() + j, size, &rows(0, j), free(), product.data(), mostData);
      result.block(j, j, size - j, std::min(12, size - j)) -= product.topLeftCorner(size - j, std::min(12, size - j));
    }
  }
  for (int j = 0; j < size; j += D)
    for (int i = j; i < size; i += D) {
      const double factor = piola.factor(i / D, sideNodes_) * piola.factor(j / D, sideNodes_);
      const Map block = factor * (piola.inverse.transpose() * Map(result.template block<D, D>(i, j)) * piola.inverse);
      if (i == j) {
        result.template block<D, D>(i, j) = 0.5 * (block + block.transpose());
      } else {
        result.template block<D, D>(i, j) = block;
        result.template block<D, D>(j, i) = block.transpose();
      }
    }
}

template <int D>
Vector StressElement<D>::coefficients(const Piola& piola, const Vector& data) const {
  Vector reference(data.size());
  for (int j = 0; j < data.size(); j += D)
    reference.template segment<D>(j) = piola.factor(j / D, sideNodes_) * (piola.inverse * data.template segment<D>(j));
  Vector result = particular_ * reference;
  if (free() == 0) return result;
  const Eigen::Index size = free() * (data.size() + free());
  const Vector blocks = moments_.bottomRows(size) * piola.energy;
  const FreePart factorised(Eigen::Map<const Matrix>(blocks.data() + free() * data.size(), free(), free()));
  result += free_ * factorised.amplitudes(Eigen::Map<const Matrix>(blocks.data(), free(), data.size()) * reference);
  return result;
}

template <int D>
double StressElement<D>::energy(const Map& map, const Compliance& compliance, const Vector& data) const {
  const Piola piola(map, compliance);
  const Vector all = coefficients(piola, data);
  const int nodes = int(massRoot_.rows());
  double sum = 0.0;
  for (int part = 0; part <= D; ++part) {
    // Columns: orthogonal combinations of the values at the nodes.
    const Eigen::Map<const Matrix> values(all.data() + part * nodes * components, components, nodes);
    const Eigen::Matrix<double, components, Eigen::Dynamic> stresses = piola.stresses * (values * massRoot_);
    sum += stresses.cwiseProduct(compliance * stresses).sum();
  }
  return piola.volume * sum;
}

template <int D>
typename StressElement<D>::Stress StressElement<D>::stress(const Map& map, const Compliance& compliance, const Vector& data, int part,
                                                           const Barycentric& point) const {
  const Piola piola(map, compliance);
  const Vector all = coefficients(piola, data);
  const int nodes = int(massRoot_.rows());
  const Eigen::Map<const Matrix> values(all.data() + part * nodes * components, components, nodes);
  return piola.stresses * (values * SimplexBasis<D>(degree_).values(point));
}

template <int D>
void StressElement<D>::resultants(const Vertices& vertices, Matrix& result) const {
  using Direction = Eigen::Matrix<double, D, 1>;
  const Direction centre = vertices.rowwise().mean();
  const Vertices arms = vertices.colwise() - centre;
  const double length = std::sqrt(arms.squaredNorm() / (D + 1));
  const Vertices normals = sideNormals<D>(vertices);
  result.setZero(rigidModes, data());
  // Force with the given weight and moment of a unit stress: columns D block .. D block + D - 1.
  const auto add = [&](int block, double weight, const Direction& moment) {
    const int at = D * block;
    for (int c = 0; c < D; ++c) result(c, at + c) = weight;
    if constexpr (D == 2) {
      result(2, at) = -moment(1) / length, result(2, at + 1) = moment(0) / length;
    } else {
      for (int c = 0; c < 3; ++c) {
        const int next = (c + 1) % 3, last = (c + 2) % 3;
        result(3 + c, at + last) = moment(next) / length, result(3 + c, at + next) = -moment(last) / length;
      }
    }
  };
  int block = 0;
  for (int side = 0; side <= D; ++side) {
    const double area = normals.col(side).norm();
    Eigen::Matrix<double, D, D> corners;
    for (int i = 0; i < D; ++i) corners.col(i) = arms.col(verticesOfSide<D>(side)[i]);
    const Eigen::Matrix<double, D, Eigen::Dynamic> moments = area * corners * sideArms_;
    for (int node = 0; node < sideNodes_; ++node) add(block++, area * sideMeans_(node), moments.col(node));
  }
  const double volume = simplexVolume<D>(vertices);
  const Matrix linear = SimplexBasis<D>(1).mass();
  for (int node = 0; node < sourceNodes_; ++node) {
    const Direction moment = sourceNodes_ == 1 ? Direction(Direction::Zero()) : Direction(volume * arms * linear.col(node));
    add(block++, volume / sourceNodes_, moment);
  }
}

template <int D>
void StressElement<D>::dataOf(const Vertices& vertices, const Eigen::Matrix<double, components, D + 1>& stresses, Vector& result) const {
  using Direction = Eigen::Matrix<double, D, 1>;
  const Vertices normals = sideNormals<D>(vertices);
  result.resize(data());
  Direction divergence = Direction::Zero();
  for (int side = 0, at = 0; side <= D; ++side) {
    const Direction normal = normals.col(side).normalized();
    divergence -= times<D>(stresses.col(side), normals.col(side)) / (D * simplexVolume<D>(vertices));
    Eigen::Matrix<double, components, D> corners;
    for (int i = 0; i < D; ++i) corners.col(i) = stresses.col(verticesOfSide<D>(side)[i]);
    for (int node = 0; node < sideNodes_; ++node, at += D)
      result.template segment<D>(at) = times<D>(corners * sidePlaces_.col(node), normal);
  }
  for (int node = 0; node < sourceNodes_; ++node) result.template segment<D>(tractions() + node * D) = -divergence;
}

template class StressElement<2>;
template class StressElement<3>;

}  // namespace suture
