#include <Eigen/Cholesky>
#include <suture/answer/bound/AirySweeps.hpp>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/base/Collective.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Sine of an angle up to which directions count as parallel.
constexpr double kParallel = 1e-9;

/// Direction along which the gradient of the stress function vanishes on a side, if the traction along `axis` must not change.
Eigen::Vector2d restrained(const Eigen::Vector2d& axis) { return {-axis[1], axis[0]}; }

}  // namespace

AirySweeps::AirySweeps(const StarMesh<2>& mesh, const Matrix& tractions) : mesh_(mesh), onSide_(mesh.degree() == 1 ? 1 : 3) {
  collectively(mesh.comm(), "assembling stress functions", [&] {
    findFreedom();
    assemble(tractions);
    factorStars();
  });
  solution_ = zero();
}

void AirySweeps::findFreedom() {
  frames_.assign(mesh_.vertices(), Eigen::Matrix2d::Identity());
  fixedAtVertex_.assign(mesh_.vertices(), 0);
  fixedAtSide_.assign(mesh_.sides(), 0);
  for (int s = 0; s < mesh_.sides(); ++s)
    if (mesh_.boundaryOf(s)) constrain(s);
}

void AirySweeps::constrain(int side) {
  const BoundarySide<2>& boundary = *mesh_.boundaryOf(side);
  const unsigned constrained = boundary.known | boundary.kept;
  if (constrained == 0) return;
  const Eigen::Vector2d normal = mesh_.normal(side), along(-normal[1], normal[0]);
  const unsigned all = (1u << onSide_) - 1;
  bool holdsValue = true, holdsBoth = true;
  Eigen::Vector2d direction = normal;
  fixedAtSide_[side] = all;
  if (constrained != 3) {
    direction = restrained(boundary.axes.row(constrained == 1 ? 0 : 1).transpose());
    if (std::abs(direction.dot(along)) < kParallel) {  // no change of the normal derivative
      holdsValue = holdsBoth = false;
      fixedAtSide_[side] = onSide_ == 1 ? 1u : 6u;
    } else if (std::abs(direction.dot(normal)) < kParallel) {  // the value stays zero
      holdsBoth = false;
      fixedAtSide_[side] = onSide_ == 1 ? 0u : 1u;
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
/// second one, unknowns of the side. 2 nodes x (6 + onSide_)
Matrix AirySweeps::sideTractions(int side) const {
  const double length = mesh_.size(side);
  const Eigen::Vector2d normal = mesh_.normal(side), along(-normal[1], normal[0]);
  const int nodes = mesh_.degree() + 1;
  Matrix all = Matrix::Zero(2 * nodes, 6 + onSide_);
  for (int j = 0; j < nodes; ++j) {
    const double r = j == 2 ? 0.5 : j;
    // Derivatives along the side of the slope along it and of the slope along the normal.
    Vector inSlope = Vector::Zero(6 + onSide_), ofNormal = Vector::Zero(6 + onSide_);
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
    if (onSide_ == 1) {
      ofNormal[6] = 4 * (1 - 2 * r) / length;
    } else {
      inSlope[6] = 16 * (2 - 12 * r + 12 * r * r) / (length * length);
      ofNormal[7] = 4 * (1 - 2 * r) / length;
      ofNormal[8] = (-6 * r * r + 6 * r - 1) / length;
    }
    for (int c = 0; c < all.cols(); ++c) {
      const Eigen::Vector2d change = inSlope[c] * along + ofNormal[c] * normal;
      all(2 * j, c) = change[1];
      all(2 * j + 1, c) = -change[0];
    }
  }
  return all;
}

void AirySweeps::assemble(const Matrix& tractions) {
  const StressElement<2>& stress = StressElement<2>::of(mesh_.degree());
  const int nodes = mesh_.degree() + 1, data = stress.data(), count = dofs(), given = stress.tractions();
  std::vector<Matrix> ofSides(mesh_.sides());
  for (int s = 0; s < mesh_.sides(); ++s) ofSides[s] = sideTractions(s);
  matrices_.resize(std::size_t(mesh_.elements()) * count * count);
  loads_.resize(count, mesh_.elements());
  start_ = Vector::Zero(mesh_.own());
  Matrix gram(data, data), resultants(3, data), change(given, count);
  Vector own(data), difference(data), product(data);
  double force = 0.0, rest = 0.0;
  for (int e = 0; e < mesh_.elements(); ++e) {
    const BoundElement<2>& element = mesh_.element(e);
    change.setZero();
    for (int a = 0; a < 3; ++a) {
      const int s = mesh_.sidesOfElement(e)[a];
      const double sign = mesh_.sign(e, a);
      own.segment(2 * nodes * a, 2 * nodes) = sign * tractions.col(s);
      const int ends[2] = {a == 0 ? 1 : 0, a == 2 ? 1 : 2};
      for (int end = 0; end < 2; ++end) change.block(2 * nodes * a, 3 * ends[end], 2 * nodes, 3) = sign * ofSides[s].middleCols(3 * end, 3);
      change.block(2 * nodes * a, 9 + onSide_ * a, 2 * nodes, onSide_) = sign * ofSides[s].rightCols(onSide_);
    }
    for (int j = 0; j < stress.sourceNodes(); ++j) own.segment<2>(given + 2 * j) = element.sources.col(j);
    if (e < mesh_.own()) {
      stress.resultants(element.places, resultants);
      rest = std::max(rest, (resultants * own).cwiseAbs().maxCoeff());
      force = std::max(force, (resultants.cwiseAbs() * own.cwiseAbs()).maxCoeff());
    }
    Vector computed;
    stress.dataOf(element.places, element.stresses, computed);
    difference = own - computed;
    Eigen::Matrix2d map;
    map << element.places.col(1) - element.places.col(0), element.places.col(2) - element.places.col(0);
    stress.gram(map, element.compliance, gram);
    product.noalias() = gram * difference;
    Eigen::Map<Matrix>(&matrices_[std::size_t(e) * count * count], count, count).noalias() =
        change.transpose() * (gram.topLeftCorner(given, given) * change);
    loads_.col(e).noalias() = change.transpose() * product.head(given);
    if (e < mesh_.own()) start_[e] = stress.energy(map, element.compliance, difference);
  }
  imbalance_ = force > 0.0 ? rest / force : 0.0;
}

void AirySweeps::factorStars() {
  const int count = dofs();
  starBegin_.assign(1, 0);
  factorBegin_.assign(1, 0);
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const std::size_t begin = starSides_.size();
    if (mesh_.isComplete(v))
      for (const int e : mesh_.star(v))
        for (int a = 0; a < 3; ++a)
          if (mesh_.verticesOf(e)[a] != v &&
              std::find(starSides_.begin() + begin, starSides_.end(), mesh_.sidesOfElement(e)[a]) == starSides_.end())
            starSides_.push_back(mesh_.sidesOfElement(e)[a]);
    starBegin_.push_back(int(starSides_.size()));
    const int sides = starBegin_[v + 1] - starBegin_[v], n = sides == 0 ? 0 : 3 + onSide_ * sides;
    factorBegin_.push_back(factorBegin_.back() + std::size_t(n) * n);
  }
  factors_.resize(factorBegin_.back());
  std::vector<int> place;
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const int sides = starBegin_[v + 1] - starBegin_[v], n = 3 + onSide_ * sides;
    if (sides == 0) continue;
    Eigen::Map<Matrix> star(&factors_[factorBegin_[v]], n, n);
    star.setZero();
    std::vector<char> fixed(n, 0);
    for (int i = 0; i < 3; ++i) fixed[i] = fixedAtVertex_[v] >> i & 1u;
    for (int i = 0; i < sides; ++i)
      for (int k = 0; k < onSide_; ++k) fixed[3 + onSide_ * i + k] = fixedAtSide_[starSides_[starBegin_[v] + i]] >> k & 1u;
    for (const int e : mesh_.star(v)) {
      place.assign(count, -1);
      for (int a = 0; a < 3; ++a) {
        if (mesh_.verticesOf(e)[a] == v) {
          for (int i = 0; i < 3; ++i) place[3 * a + i] = i;
          continue;
        }
        const auto first = starSides_.begin() + starBegin_[v];
        const int at = int(std::find(first, first + sides, mesh_.sidesOfElement(e)[a]) - first);
        for (int k = 0; k < onSide_; ++k) place[9 + onSide_ * a + k] = 3 + onSide_ * at + k;
      }
      const Eigen::Map<const Matrix> own(&matrices_[std::size_t(e) * count * count], count, count);
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
          if (place[i] >= 0 && place[j] >= 0) star(place[i], place[j]) += own(i, j);
    }
    for (int i = 0; i < n; ++i)
      if (fixed[i]) {
        star.row(i).setZero(), star.col(i).setZero();
        star(i, i) = 1.0;
      }
    const Eigen::LLT<Matrix> factor(star);
    star = factor.matrixL();
    // A fixed unknown keeps a zero row: its entry marks it.
    for (int i = 0; i < n; ++i)
      if (fixed[i]) star(i, i) = 0.0;
  }
}

AirySweeps::Field AirySweeps::zero() const { return {Matrix::Zero(3, mesh_.vertices()), Matrix::Zero(onSide_, mesh_.sides())}; }

Vector AirySweeps::gather(const Field& field, int e) const {
  Vector values(dofs());
  for (int a = 0; a < 3; ++a) {
    values.segment<3>(3 * a) = field.ofVertices.col(mesh_.verticesOf(e)[a]);
    values.segment(9 + onSide_ * a, onSide_) = field.ofSides.col(mesh_.sidesOfElement(e)[a]);
  }
  return values;
}

void AirySweeps::scatter(const Vector& values, int e, Field& field) const {
  for (int a = 0; a < 3; ++a) {
    field.ofVertices.col(mesh_.verticesOf(e)[a]) += values.segment<3>(3 * a);
    field.ofSides.col(mesh_.sidesOfElement(e)[a]) += values.segment(9 + onSide_ * a, onSide_);
  }
}

AirySweeps::Field AirySweeps::product(const Field& p) const {
  const int count = dofs();
  Field result = zero();
  for (int e = 0; e < mesh_.elements(); ++e)
    scatter(Eigen::Map<const Matrix>(&matrices_[std::size_t(e) * count * count], count, count) * gather(p, e), e, result);
  return result;
}

AirySweeps::Field AirySweeps::precondition(const Field& r) const {
  Field z = zero();
  for (int v = 0; v < mesh_.vertices(); ++v) {
    const int sides = starBegin_[v + 1] - starBegin_[v], n = 3 + onSide_ * sides;
    if (sides == 0) continue;
    const Eigen::Map<const Matrix> factor(&factors_[factorBegin_[v]], n, n);
    Vector x(n);
    x.head<3>() = r.ofVertices.col(v);
    for (int i = 0; i < sides; ++i) x.segment(3 + onSide_ * i, onSide_) = r.ofSides.col(starSides_[starBegin_[v] + i]);
    for (int i = 0; i < n; ++i) {
      if (factor(i, i) == 0.0) {
        x[i] = 0.0;
        continue;
      }
      for (int j = 0; j < i; ++j) x[i] -= factor(i, j) * x[j];
      x[i] /= factor(i, i);
    }
    for (int i = n - 1; i >= 0; --i) {
      if (factor(i, i) == 0.0) continue;
      for (int j = i + 1; j < n; ++j) x[i] -= factor(j, i) * x[j];
      x[i] /= factor(i, i);
    }
    z.ofVertices.col(v) += x.head<3>();
    for (int i = 0; i < sides; ++i) z.ofSides.col(starSides_[starBegin_[v] + i]) += x.segment(3 + onSide_ * i, onSide_);
  }
  return z;
}

void AirySweeps::exchange(Field& field) const {
  mesh_.exchangeVertices(field.ofVertices);
  mesh_.exchangeSides(field.ofSides);
}

double AirySweeps::dot(const Field& a, const Field& b) const {
  double mine = 0.0, all = 0.0;
  for (int v = 0; v < mesh_.vertices(); ++v)
    if (mesh_.counts(v)) mine += a.ofVertices.col(v).dot(b.ofVertices.col(v));
  for (int s = 0; s < mesh_.sides(); ++s)
    if (mesh_.countsSide(s)) mine += a.ofSides.col(s).dot(b.ofSides.col(s));
  Teuchos::reduceAll(mesh_.comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

void AirySweeps::run(int sweeps) {
  Field r = zero();
  for (int e = 0; e < mesh_.elements(); ++e) scatter(-loads_.col(e), e, r);
  Field p = zero();
  double before = 0.0;
  for (int i = 0; i < sweeps; ++i) {
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
    solution_.ofVertices += step * p.ofVertices;
    solution_.ofSides += step * p.ofSides;
    r.ofVertices -= step * q.ofVertices;
    r.ofSides -= step * q.ofSides;
  }
}

Vector AirySweeps::energies() const {
  const int count = dofs();
  Vector all = start_;
  for (int e = 0; e < mesh_.own(); ++e) {
    const Vector x = gather(solution_, e);
    all[e] += 2 * x.dot(loads_.col(e)) + x.dot(Eigen::Map<const Matrix>(&matrices_[std::size_t(e) * count * count], count, count) * x);
  }
  return all;
}

}  // namespace suture
