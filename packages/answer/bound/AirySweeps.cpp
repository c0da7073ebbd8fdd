#include <suture/answer/bound/AirySweeps.hpp>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/base/Collective.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Sine of an angle up to which directions count as parallel.
constexpr double kParallel = 1e-9;
// Longest edge over height of triangles whose energies are summed as squares, because products with a Gram matrix lose digits.
constexpr double kFlatTriangle = 30.0;
// Diagonal of a star's factor, squared and relative to the matrix, below which an unknown changes no stress.
constexpr double kNoChange = 1e-13;

/// Direction along which the gradient of the stress function vanishes on a side, if the traction along `axis` must not change.
Eigen::Vector2d restrained(const Eigen::Vector2d& axis) { return {-axis[1], axis[0]}; }

bool isFlat(const Eigen::Matrix2d& map) {
  const double longest = std::max({map.col(0).squaredNorm(), map.col(1).squaredNorm(), (map.col(0) - map.col(1)).squaredNorm()});
  return longest > kFlatTriangle * std::abs(map.determinant());
}

/// Cholesky factor of a packed lower triangle in place; fixed unknowns and those without stiffness get a zero diagonal.
void factorPacked(double* packed, int n, const char* fixed) {
  double* row = packed;
  for (int i = 0; i < n; ++i) {
    const double diagonal = row[i];
    const double* other = packed;
    for (int j = 0; j < i; ++j) {
      double value = row[j];
      for (int k = 0; k < j; ++k) value -= row[k] * other[k];
      row[j] = fixed[i] || other[j] == 0.0 ? 0.0 : value / other[j];
      other += j + 1;
    }
    double value = diagonal;
    for (int k = 0; k < i; ++k) value -= row[k] * row[k];
    row[i] = fixed[i] || !(value > kNoChange * diagonal) ? 0.0 : std::sqrt(value);
    row += i + 1;
  }
}

void solvePacked(const double* packed, int n, double* x) {
  const double* row = packed;
  for (int i = 0; i < n; ++i) {
    double value = x[i];
    for (int k = 0; k < i; ++k) value -= row[k] * x[k];
    x[i] = row[i] == 0.0 ? 0.0 : value / row[i];
    row += i + 1;
  }
  for (int i = n - 1; i >= 0; --i) {
    row -= i + 1;
    if (row[i] == 0.0) continue;
    x[i] /= row[i];
    for (int k = 0; k < i; ++k) x[k] -= row[k] * x[i];
  }
}

}  // namespace

template <int K>
AirySweeps<K>::AirySweeps(const StarMesh<2>& mesh, const Matrix& given) : mesh_(mesh) {
  collectively(mesh.comm(), "assembling stress functions", [&] {
    findFreedom();
    assemble(given);
    factorStars();
  });
  solution_ = zero();
}

template <int K>
void AirySweeps<K>::findFreedom() {
  frames_.assign(mesh_.vertices(), Eigen::Matrix2d::Identity());
  fixedAtVertex_.assign(mesh_.vertices(), 0);
  fixedAtSide_.assign(mesh_.sides(), 0);
  for (int s = 0; s < mesh_.sides(); ++s)
    if (mesh_.boundaryOf(s)) constrain(s);
}

template <int K>
void AirySweeps<K>::constrain(int side) {
  const SideCondition<2>& boundary = *mesh_.boundaryOf(side);
  const unsigned constrained = boundary.known | boundary.kept;
  if (constrained == 0) return;
  const Eigen::Vector2d normal = mesh_.normal(side), along(-normal[1], normal[0]);
  bool holdsValue = true, holdsBoth = true;
  Eigen::Vector2d direction = normal;
  fixedAtSide_[side] = (1u << onSide) - 1;
  if (constrained != 3) {
    direction = restrained(boundary.axes.row(constrained == 1 ? 0 : 1).transpose());
    if (std::abs(direction.dot(along)) < kParallel) {  // no change of the normal derivative
      holdsValue = holdsBoth = false;
      fixedAtSide_[side] = K == 1 ? 1u : 6u;
    } else if (std::abs(direction.dot(normal)) < kParallel) {  // the value stays zero
      holdsBoth = false;
      fixedAtSide_[side] = K == 1 ? 0u : 1u;
    }
  }
  for (const int v : mesh_.verticesOfSide(side)) {
    unsigned& fixed = fixedAtVertex_[v];
    if (holdsValue) fixed |= 1;
    if (holdsBoth) {
      fixed |= 6;
    } else if ((fixed & 6) == 0) {
      frames_[v].col(0) = direction;
      frames_[v].col(1) << -direction[1], direction[0];
      fixed |= 2;
    } else if (std::abs(frames_[v].col(1).dot(direction)) > kParallel) {
      fixed |= 6;
    }
  }
}

/// Tractions at the nodes of a side, in the direction of its normal, due to unit values of: value and gradient at its first vertex, at its
/// second one, unknowns of the side.
template <int K>
typename AirySweeps<K>::OfSide AirySweeps<K>::sideTractions(int side) const {
  const double length = mesh_.size(side);
  const Eigen::Vector2d normal = mesh_.normal(side), along(-normal[1], normal[0]);
  OfSide all;
  for (int j = 0; j <= K; ++j) {
    const double r = j == 2 ? 0.5 : j;
    // Derivatives along the side of the slope along it and of the slope along the normal.
    Eigen::Matrix<double, 6 + onSide, 1> inSlope, ofNormal;
    inSlope.setZero(), ofNormal.setZero();
    inSlope[0] = (12 * r - 6) / (length * length);
    inSlope[3] = -inSlope[0];
    for (int end = 0; end < 2; ++end) {
      const auto& frame = frames_[mesh_.verticesOfSide(side)[end]];
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

template <int K>
void AirySweeps<K>::assemble(const Matrix& given) {
  const StressElement<2>& stress = StressElement<2>::of(K);
  const int data = stress.data();
  std::vector<OfSide> ofSides(mesh_.sides());
  for (int s = 0; s < mesh_.sides(); ++s) ofSides[s] = sideTractions(s);
  matrices_.resize(std::size_t(mesh_.elements()) * dofs * dofs);
  loads_.resize(dofs, mesh_.elements());
  start_ = Vector::Zero(mesh_.own());
  Matrix gram(data, data), resultants(3, data);
  Eigen::Matrix<double, tractions, dofs> change, weighted;
  Vector own(data), computed(data), difference(data), product(data);
  double force = 0.0, rest = 0.0;
  for (int e = 0; e < mesh_.elements(); ++e) {
    const BoundElement<2>& element = mesh_.element(e);
    change.setZero();
    for (int a = 0; a < 3; ++a) {
      const int s = mesh_.sidesOfElement(e)[a];
      const double sign = mesh_.sign(e, a);
      own.template segment<sideData>(sideData * a) = sign * given.col(s);
      const int ends[2] = {a == 0 ? 1 : 0, a == 2 ? 1 : 2};
      for (int end = 0; end < 2; ++end)
        change.template block<sideData, 3>(sideData * a, 3 * ends[end]) = sign * ofSides[s].template middleCols<3>(3 * end);
      change.template block<sideData, onSide>(sideData * a, 9 + onSide * a) = sign * ofSides[s].template rightCols<onSide>();
    }
    for (int j = 0; j < stress.sourceNodes(); ++j) own.segment<2>(tractions + 2 * j) = element.sources.col(j);
    if (e < mesh_.own()) {
      stress.resultants(element.places, resultants);
      for (int i = 0; i < 3; ++i) {
        double sum = 0.0, size = 0.0;
        for (int j = 0; j < data; ++j) sum += resultants(i, j) * own[j], size += std::abs(resultants(i, j) * own[j]);
        rest = std::max(rest, std::abs(sum)), force = std::max(force, size);
      }
    }
    stress.dataOf(element.places, element.stresses, computed);
    difference = own - computed;
    Eigen::Matrix2d map;
    map << element.places.col(1) - element.places.col(0), element.places.col(2) - element.places.col(0);
    stress.gram(map, element.compliance, gram);
    product.noalias() = gram.template selfadjointView<Eigen::Lower>() * difference;
    const double energy = isFlat(map) ? stress.energy(map, element.compliance, difference) : difference.dot(product);
    const double ofSupports = addSupports(mesh_, e, own, gram, product);
    weighted.noalias() = gram.topLeftCorner<tractions, tractions>().lazyProduct(change);
    Eigen::Map<LocalMatrix>(&matrices_[std::size_t(e) * dofs * dofs]).noalias() = change.transpose().lazyProduct(weighted);
    loads_.col(e).noalias() = change.transpose() * product.template head<tractions>();
    if (e < mesh_.own()) start_[e] = energy + ofSupports;
  }
  imbalance_ = force > 0.0 ? rest / force : 0.0;
}

template <int K>
void AirySweeps<K>::listStars() {
  starBegin_.assign(1, 0);
  factorBegin_.assign(1, 0);
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const std::size_t begin = starSides_.size();
    if (mesh_.isComplete(v))
      for (const int e : mesh_.star(v))
        for (int a = 0; a < 3; ++a) {
          const int s = mesh_.sidesOfElement(e)[a];
          if (mesh_.verticesOf(e)[a] != v && std::find(starSides_.begin() + begin, starSides_.end(), s) == starSides_.end())
            starSides_.push_back(s);
        }
    starBegin_.push_back(int(starSides_.size()));
    const int sides = starBegin_[v + 1] - starBegin_[v], n = sides == 0 ? 0 : 3 + onSide * sides;
    factorBegin_.push_back(factorBegin_.back() + std::size_t(n) * (n + 1) / 2);
  }
  factors_.assign(factorBegin_.back(), 0.0);
}

template <int K>
void AirySweeps<K>::factorStars() {
  listStars();
  std::vector<char> fixed;
  int place[dofs];
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const int sides = starBegin_[v + 1] - starBegin_[v], n = 3 + onSide * sides;
    if (sides == 0) continue;
    const int* first = &starSides_[starBegin_[v]];
    double* packed = &factors_[factorBegin_[v]];
    fixed.assign(n, 0);
    for (int i = 0; i < 3; ++i) fixed[i] = fixedAtVertex_[v] >> i & 1u;
    for (int i = 0; i < sides; ++i)
      for (int k = 0; k < onSide; ++k) fixed[3 + onSide * i + k] = fixedAtSide_[first[i]] >> k & 1u;
    for (const int e : mesh_.star(v)) {
      std::fill(place, place + dofs, -1);
      for (int a = 0; a < 3; ++a) {
        if (mesh_.verticesOf(e)[a] == v) {
          for (int i = 0; i < 3; ++i) place[3 * a + i] = i;
          continue;
        }
        const int at = int(std::find(first, first + sides, mesh_.sidesOfElement(e)[a]) - first);
        for (int k = 0; k < onSide; ++k) place[9 + onSide * a + k] = 3 + onSide * at + k;
      }
      const auto own = matrix(e);
      for (int j = 0; j < dofs; ++j) {
        if (place[j] < 0) continue;
        for (int i = 0; i < dofs; ++i)
          if (place[i] >= place[j]) packed[place[i] * (place[i] + 1) / 2 + place[j]] += own(i, j);
      }
    }
    factorPacked(packed, n, fixed.data());
  }
}

template <int K>
typename AirySweeps<K>::Field AirySweeps<K>::zero() const {
  return {Matrix::Zero(3, mesh_.vertices()), Matrix::Zero(onSide, mesh_.sides())};
}

template <int K>
typename AirySweeps<K>::Local AirySweeps<K>::gather(const Field& field, int e) const {
  Local values;
  for (int a = 0; a < 3; ++a) {
    values.template segment<3>(3 * a) = field.ofVertices.col(mesh_.verticesOf(e)[a]);
    values.template segment<onSide>(9 + onSide * a) = field.ofSides.col(mesh_.sidesOfElement(e)[a]);
  }
  return values;
}

template <int K>
void AirySweeps<K>::scatter(const Local& values, int e, Field& field) const {
  for (int a = 0; a < 3; ++a) {
    field.ofVertices.col(mesh_.verticesOf(e)[a]) += values.template segment<3>(3 * a);
    field.ofSides.col(mesh_.sidesOfElement(e)[a]) += values.template segment<onSide>(9 + onSide * a);
  }
}

template <int K>
typename AirySweeps<K>::Field AirySweeps<K>::product(const Field& p) const {
  Field result = zero();
  for (int e = 0; e < mesh_.elements(); ++e) scatter(matrix(e) * gather(p, e), e, result);
  return result;
}

template <int K>
typename AirySweeps<K>::Field AirySweeps<K>::precondition(const Field& r) const {
  Field z = zero();
  std::vector<double> x;
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const int sides = starBegin_[v + 1] - starBegin_[v], n = 3 + onSide * sides;
    if (sides == 0) continue;
    const int* first = &starSides_[starBegin_[v]];
    x.resize(n);
    std::copy_n(r.ofVertices.col(v).data(), 3, x.data());
    for (int i = 0; i < sides; ++i) std::copy_n(r.ofSides.col(first[i]).data(), onSide, &x[3 + onSide * i]);
    solvePacked(&factors_[factorBegin_[v]], n, x.data());
    for (int i = 0; i < 3; ++i) z.ofVertices(i, v) += x[i];
    for (int i = 0; i < sides; ++i)
      for (int k = 0; k < onSide; ++k) z.ofSides(k, first[i]) += x[3 + onSide * i + k];
  }
  return z;
}

template <int K>
void AirySweeps<K>::exchange(Field& field) const {
  mesh_.exchangeVertices(field.ofVertices);
  mesh_.exchangeSides(field.ofSides);
}

template <int K>
double AirySweeps<K>::dot(const Field& a, const Field& b) const {
  double mine = 0.0, all = 0.0;
  for (int v = 0; v < mesh_.vertices(); ++v)
    if (mesh_.counts(v)) mine += a.ofVertices.col(v).dot(b.ofVertices.col(v));
  for (int s = 0; s < mesh_.sides(); ++s)
    if (mesh_.countsSide(s)) mine += a.ofSides.col(s).dot(b.ofSides.col(s));
  Teuchos::reduceAll(mesh_.comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

template <int K>
void AirySweeps<K>::run(int sweeps) {
  Field r = zero();
  for (int e = 0; e < mesh_.elements(); ++e) scatter(-loads_.col(e), e, r);
  Field p = zero();
  double before = 0.0;
  SweepGain gain(mesh_.comm(), start_.sum(), sweeps);
  while (gain.worthAnotherSweep()) {
    const int i = gain.sweeps();
    const Field z = precondition(r);
    const double rz = dot(r, z);
    if (!(rz > 0.0)) return;
    const double beta = i == 0 ? 0.0 : rz / before;
    p.ofVertices = z.ofVertices + beta * p.ofVertices;
    p.ofSides = z.ofSides + beta * p.ofSides;
    before = rz;
    exchange(p);
    const Field q = product(p);
    const double step = rz / dot(p, q);
    gain.add(step * rz);
    solution_.ofVertices += step * p.ofVertices;
    solution_.ofSides += step * p.ofSides;
    r.ofVertices -= step * q.ofVertices;
    r.ofSides -= step * q.ofSides;
  }
}

template <int K>
Vector AirySweeps<K>::energies() const {
  Vector all = start_;
  for (int e = 0; e < mesh_.own(); ++e) {
    const Local x = gather(solution_, e);
    all[e] += 2 * x.dot(loads_.col(e)) + x.dot(matrix(e) * x);
  }
  return all;
}

template class AirySweeps<1>;
template class AirySweeps<2>;

}  // namespace suture
