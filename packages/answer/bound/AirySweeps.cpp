#include <suture/algebra/Lanes.hpp>
#include <suture/answer/bound/AirySweeps.hpp>
#include <suture/answer/bound/PressedSides.hpp>
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
// Diagonal of a star's factor, squared and relative to the matrix, below which an unknown changes no stress.
constexpr double kNoChange = 1e-13;

/// Direction along which the gradient of the stress function vanishes on a side, if the traction along `axis` must not change.
Eigen::Vector2d restrained(const Eigen::Vector2d& axis) { return {-axis[1], axis[0]}; }

/// Cholesky factor of a lower triangle, by rows, in place; the diagonal is inverted. Unknowns with a zero diagonal, and those without
/// stiffness beside the others, get zeros.
void factorStar(double* packed, int n) {
  double* row = packed;
  for (int i = 0; i < n; ++i) {
    const double diagonal = row[i];
    const double* other = packed;
    for (int j = 0; j < i; ++j) {
      double value = row[j];
      for (int k = 0; k < j; ++k) value -= row[k] * other[k];
      row[j] = value * other[j];
      other += j + 1;
    }
    double value = diagonal;
    for (int k = 0; k < i; ++k) value -= row[k] * row[k];
    row[i] = value > kNoChange * diagonal ? 1.0 / std::sqrt(value) : 0.0;
    row += i + 1;
  }
}

void solveStar(const double* packed, int n, double* x) {
  const double* row = packed;
  for (int i = 0; i < n; ++i) {
    double value = x[i];
    for (int k = 0; k < i; ++k) value -= row[k] * x[k];
    x[i] = value * row[i];
    row += i + 1;
  }
  for (int i = n - 1; i >= 0; --i) {
    row -= i + 1;
    x[i] *= row[i];
    for (int k = 0; k < i; ++k) x[k] -= row[k] * x[i];
  }
}

/// Products of the matrices of four triangles. \param packed  rows of the lower triangles, all numbers for the four triangles together
template <int dofs>
__attribute__((always_inline)) inline void multiplyLanes(const double* packed, const double* x, double* y) {
  using Many = Register<double>;
  typename Many::Type own[dofs], result[dofs];
  for (int i = 0; i < dofs; ++i) own[i] = Many::at(x + 4 * i);
  for (int i = 0; i < dofs; ++i) {
    typename Many::Type sum = {};
    for (int j = 0; j < i; ++j, packed += 4) {
      const typename Many::Type entry = Many::at(packed);
      sum += entry * own[j];
      result[j] += entry * own[i];
    }
    result[i] = sum + Many::at(packed) * own[i];
    packed += 4;
  }
  for (int i = 0; i < dofs; ++i) Many::at(y + 4 * i) = result[i];
}

SUTURE_FOR_EACH_PROCESSOR
void multiplyLanes12(const double* packed, const double* x, double* y) { multiplyLanes<12>(packed, x, y); }
SUTURE_FOR_EACH_PROCESSOR
void multiplyLanes18(const double* packed, const double* x, double* y) { multiplyLanes<18>(packed, x, y); }

}  // namespace

template <int K>
AirySweeps<K>::AirySweeps(const StarMesh<2>& mesh, const Matrix& given) : mesh_(mesh) {
  collectively(mesh.comm(), "assembling stress functions", [&] {
    findFreedom();
    listStars();
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

template <int K>
typename AirySweeps<K>::Element::Sides AirySweeps<K>::sidesOf(int e) const {
  typename Element::Sides sides;
  for (int a = 0; a < 3; ++a) {
    const int s = mesh_.sidesOfElement(e)[a];
    sides[a] = {mesh_.size(s), mesh_.normal(s), mesh_.sign(e, a)};
  }
  return sides;
}

template <int K>
void AirySweeps<K>::assemble(const Matrix& given) {
  const Element& reference = Element::reference();
  const std::size_t groups = std::size_t((mesh_.elements() + lanes - 1) / lanes), size = packed * lanes;
  matrices_.reset(new double[groups * size]);
  if (groups > 0) std::fill_n(&matrices_[(groups - 1) * size], size, 0.0);
  loads_.resize(dofs, mesh_.elements());
  start_ = Vector::Zero(mesh_.own());
  Eigen::Matrix<double, sideData, 3> tractions;
  typename Element::Frames frames;
  for (int e = 0; e < mesh_.elements(); ++e) {
    for (int a = 0; a < 3; ++a) {
      tractions.col(a) = given.col(mesh_.sidesOfElement(e)[a]);
      frames[a] = frames_[mesh_.verticesOf(e)[a]];
    }
    typename Element::Energy energy = reference.energy(mesh_.element(e), sidesOf(e), frames, tractions);
    for (int a = 0; a < 3; ++a) addSupport(e, a, frames, tractions.col(a), energy);
    double* entry = &matrices_[std::size_t(e / lanes) * packed * lanes + e % lanes];
    for (int i = 0; i < dofs; ++i)
      for (int j = 0; j <= i; ++j, entry += lanes) *entry = energy.matrix(j, i);
    addToStars(e, energy.matrix);
    loads_.col(e) = energy.loads;
    if (e < mesh_.own()) start_[e] = energy.start;
  }
  measureImbalance(given);
}

/// Energy of the elastic support of a side. \param traction  in the direction of the side's normal
template <int K>
void AirySweeps<K>::addSupport(int e, int a, const typename Element::Frames& frames, const Eigen::Matrix<double, sideData, 1>& traction,
                               typename Element::Energy& energy) const {
  const int s = mesh_.sidesOfElement(e)[a], ends[2] = {a == 0 ? 1 : 0, a == 2 ? 1 : 2};
  const std::optional<SupportForm> form = supportForm(mesh_, s, mesh_.sign(e, a) * traction);
  if (!form) return;
  const AirySide side{mesh_.size(s), mesh_.normal(s), mesh_.sign(e, a)};
  const typename Element::SideTractions ofUnknowns = side.sign * Element::tractionsOf(side, frames[ends[0]], frames[ends[1]]);
  Eigen::Matrix<double, sideData, dofs> change = Eigen::Matrix<double, sideData, dofs>::Zero();
  for (int end = 0; end < 2; ++end) change.template middleCols<3>(3 * ends[end]) = ofUnknowns.template middleCols<3>(3 * end);
  change.template middleCols<onSide>(9 + onSide * a) = ofUnknowns.template rightCols<onSide>();
  energy.matrix += change.transpose() * form->gram * change;
  energy.loads += change.transpose() * form->product;
  energy.start += form->energy;
}

/// Largest resultant of forces, and of moments over the size of the triangle.
template <int K>
void AirySweeps<K>::measureImbalance(const Matrix& given) {
  using Weights = Eigen::Matrix<double, K + 1, 1>;
  const Eigen::Matrix<double, K + 1, K + 1> mass = sideMass(2, K);
  const Weights means = mass.colwise().sum().transpose();
  Weights ahead;  // moments about the first vertex of forces across the side, over its length
  for (int j = 0; j <= K; ++j) ahead[j] = mass(1, j) + (K == 2 ? 0.5 * mass(K, j) : 0.0);
  double force = 0.0, rest = 0.0;
  for (int e = 0; e < mesh_.own(); ++e) {
    const BoundElement<2>& element = mesh_.element(e);
    const Eigen::Vector2d centre = element.places.rowwise().mean();
    const Eigen::Matrix<double, 2, 3> arms = element.places.colwise() - centre;
    const double size = std::sqrt(arms.squaredNorm() / 3);
    Eigen::Array3d sum = Eigen::Array3d::Zero(), all = sum;
    const auto add = [&](const Eigen::Vector2d& arm, double weight, const Eigen::Vector2d& f) {
      const Eigen::Array3d own(weight * f[0], weight * f[1], 0.0);
      const double first = arm[0] * f[1] / size, second = arm[1] * f[0] / size;
      sum += own + Eigen::Array3d(0, 0, first - second);
      all += own.abs() + Eigen::Array3d(0, 0, std::abs(first) + std::abs(second));
    };
    for (int a = 0; a < 3; ++a) {
      const int s = mesh_.sidesOfElement(e)[a];
      const Eigen::Vector2d from = arms.col(a == 0 ? 1 : 0), along = arms.col(a == 2 ? 1 : 2) - from;
      const double size = mesh_.sign(e, a) * mesh_.size(s);
      for (int j = 0; j <= K; ++j)
        add(size * (means[j] * from + ahead[j] * along), size * means[j], given.col(s).template segment<2>(2 * j));
    }
    const Eigen::Vector2d first = arms.col(1) - arms.col(0), second = arms.col(2) - arms.col(0);
    const double volume = std::abs(first[0] * second[1] - first[1] * second[0]) / 2;
    if constexpr (K == 1)
      add(Eigen::Vector2d::Zero(), volume, element.sources.col(0));
    else
      for (int j = 0; j < 3; ++j) add(volume / 12 * arms.col(j), volume / 3, element.sources.col(j));
    rest = std::max(rest, sum.abs().maxCoeff());
    force = std::max(force, all.maxCoeff());
  }
  imbalance_ = force > 0.0 ? rest / force : 0.0;
}

template <int K>
void AirySweeps<K>::listStars() {
  starBegin_.assign(1, 0);
  factorBegin_.assign(1, 0);
  starBegin_.reserve(mesh_.vertices() + 1);
  factorBegin_.reserve(mesh_.vertices() + 1);
  starSides_.reserve(2 * std::size_t(mesh_.sides()));
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

/// Adds the stiffness of a triangle to the matrices of its vertices' stars: rows of the lower triangles, the vertex, then the sides.
template <int K>
void AirySweeps<K>::addToStars(int e, const typename Element::LocalMatrix& matrix) {
  const auto& vertices = mesh_.verticesOf(e);
  for (int at = 0; at < 3; ++at) {
    const int v = vertices[at];
    if (starBegin_[v + 1] == starBegin_[v]) continue;
    const int* first = &starSides_[starBegin_[v]];
    double* star = &factors_[factorBegin_[v]];
    const auto row = [star](int i) { return star + i * (i + 1) / 2; };
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) row(i)[j] += matrix(3 * at + j, 3 * at + i);
    int place[2], own[2];
    for (int k = 0; k < 2; ++k) {
      const int a = k == 0 ? (at == 0 ? 1 : 0) : (at == 2 ? 1 : 2), s = mesh_.sidesOfElement(e)[a];
      int number = 0;
      while (first[number] != s) ++number;
      place[k] = 3 + onSide * number, own[k] = 9 + onSide * a;
      for (int i = 0; i < onSide; ++i) {
        for (int j = 0; j < 3; ++j) row(place[k] + i)[j] += matrix(3 * at + j, own[k] + i);
        for (int j = 0; j <= i; ++j) row(place[k] + i)[place[k] + j] += matrix(own[k] + j, own[k] + i);
      }
    }
    const int low = place[0] < place[1] ? 0 : 1, high = 1 - low;
    for (int i = 0; i < onSide; ++i)
      for (int j = 0; j < onSide; ++j) row(place[high] + i)[place[low] + j] += matrix(own[low] + j, own[high] + i);
  }
}

/// Rows and columns of fixed unknowns become zero.
template <int K>
void AirySweeps<K>::fixInStar(int v) {
  const int sides = starBegin_[v + 1] - starBegin_[v], n = 3 + onSide * sides;
  const auto fix = [&](int i) {
    double* star = &factors_[factorBegin_[v]];
    for (int j = 0; j < n; ++j) star[std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j)] = 0.0;
  };
  for (int i = 0; i < 3; ++i)
    if (fixedAtVertex_[v] >> i & 1u) fix(i);
  for (int side = 0; side < sides; ++side)
    for (int k = 0; k < onSide; ++k)
      if (fixedAtSide_[starSides_[starBegin_[v] + side]] >> k & 1u) fix(3 + onSide * side + k);
}

template <int K>
void AirySweeps<K>::factorStars() {
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const int sides = starBegin_[v + 1] - starBegin_[v];
    if (sides == 0) continue;
    fixInStar(v);
    factorStar(&factors_[factorBegin_[v]], 3 + onSide * sides);
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
void AirySweeps<K>::product(const Field& p, Field& result) const {
  result.ofVertices.setZero();
  result.ofSides.setZero();
  Eigen::Matrix<double, lanes, dofs> x, y;
  x.setZero();
  for (int begin = 0; begin < mesh_.elements(); begin += lanes) {
    const int count = std::min(lanes, mesh_.elements() - begin);
    for (int k = 0; k < count; ++k)
      for (int a = 0; a < 3; ++a) {
        x.template block<1, 3>(k, 3 * a) = p.ofVertices.template block<3, 1>(0, mesh_.verticesOf(begin + k)[a]).transpose();
        x.template block<1, onSide>(k, 9 + onSide * a) =
            p.ofSides.template block<onSide, 1>(0, mesh_.sidesOfElement(begin + k)[a]).transpose();
      }
    const double* matrices = &matrices_[std::size_t(begin / lanes) * packed * lanes];
    if constexpr (K == 1)
      multiplyLanes12(matrices, x.data(), y.data());
    else
      multiplyLanes18(matrices, x.data(), y.data());
    for (int k = 0; k < count; ++k)
      for (int a = 0; a < 3; ++a) {
        result.ofVertices.template block<3, 1>(0, mesh_.verticesOf(begin + k)[a]) += y.template block<1, 3>(k, 3 * a).transpose();
        result.ofSides.template block<onSide, 1>(0, mesh_.sidesOfElement(begin + k)[a]) +=
            y.template block<1, onSide>(k, 9 + onSide * a).transpose();
      }
  }
}

template <int K>
void AirySweeps<K>::precondition(const Field& r, Field& z) const {
  z.ofVertices.setZero();
  z.ofSides.setZero();
  std::vector<double> x;
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const int sides = starBegin_[v + 1] - starBegin_[v], n = 3 + onSide * sides;
    if (sides == 0) continue;
    const int* first = &starSides_[starBegin_[v]];
    x.resize(n);
    std::copy_n(r.ofVertices.col(v).data(), 3, x.data());
    for (int i = 0; i < sides; ++i) std::copy_n(r.ofSides.col(first[i]).data(), onSide, &x[3 + onSide * i]);
    solveStar(&factors_[factorBegin_[v]], n, x.data());
    for (int i = 0; i < 3; ++i) z.ofVertices(i, v) += x[i];
    for (int i = 0; i < sides; ++i)
      for (int k = 0; k < onSide; ++k) z.ofSides(k, first[i]) += x[3 + onSide * i + k];
  }
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
  Field r = zero(), z = zero(), p = zero(), q = zero();
  for (int e = 0; e < mesh_.elements(); ++e)
    for (int a = 0; a < 3; ++a) {
      r.ofVertices.col(mesh_.verticesOf(e)[a]) -= loads_.col(e).template segment<3>(3 * a);
      r.ofSides.col(mesh_.sidesOfElement(e)[a]) -= loads_.col(e).template segment<onSide>(9 + onSide * a);
    }
  double before = 0.0;
  SweepGain gain(mesh_.comm(), start_.sum(), sweeps);
  while (gain.worthAnotherSweep()) {
    precondition(r, z);
    const double rz = dot(r, z);
    if (!(rz > 0.0)) return;
    const double beta = gain.sweeps() == 0 ? 0.0 : rz / before;
    p.ofVertices = z.ofVertices + beta * p.ofVertices;
    p.ofSides = z.ofSides + beta * p.ofSides;
    before = rz;
    exchange(p);
    product(p, q);
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
    double squares = 0.0;
    for (int i = 0; i < dofs; ++i) {
      double row = 0.5 * entry(e, i, i) * x[i];
      for (int j = 0; j < i; ++j) row += entry(e, i, j) * x[j];
      squares += row * x[i];
    }
    all[e] += 2 * (x.dot(loads_.col(e)) + squares);
  }
  return all;
}

template class AirySweeps<1>;
template class AirySweeps<2>;

}  // namespace suture
