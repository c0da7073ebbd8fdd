#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/answer/bound/TractionSweeps.hpp>
#include <suture/base/Collective.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

// Diagonal of R below which equations of equilibrium of a star depend on the others.
constexpr double kDependentRow = 1e-9;

/// Columns: directions in which the traction of a side may change.
Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> freeDirections(const StarMesh<3>& mesh, int side) {
  const SideCondition<3>* boundary = mesh.boundaryOf(side);
  if (!boundary) return Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> directions(3, 0);
  for (int k = 0; k < 3; ++k)
    if (!((boundary->known | boundary->kept) >> k & 1u)) {
      directions.conservativeResize(3, directions.cols() + 1);
      directions.col(directions.cols() - 1) = boundary->axes.row(k).transpose();
    }
  return directions;
}

}  // namespace

TractionSweeps::TractionSweeps(const StarMesh<3>& mesh, const Matrix& tractions)
    : mesh_(mesh), nodes_(SimplexNodes<3>::sideNodes(mesh.degree())), count_(12 * nodes_) {
  collectively(mesh.comm(), "assembling stresses", [&] {
    assemble(tractions);
    findStars();
  });
  change_ = Vector::Zero(mesh.own());
}

void TractionSweeps::assemble(const Matrix& tractions) {
  const StressElement<3>& stress = StressElement<3>::of(mesh_.degree());
  const int data = stress.data();
  grams_.resize(std::size_t(mesh_.elements()) * count_ * count_);
  loads_.resize(count_, mesh_.elements());
  start_ = Vector::Zero(mesh_.own());
  Matrix gram(data, data), resultants(6, data);
  Vector own(data), computed(data), product(data);
  double force = 0.0, rest = 0.0;
  for (int e = 0; e < mesh_.elements(); ++e) {
    const BoundElement<3>& element = mesh_.element(e);
    for (int a = 0; a < 4; ++a) own.segment(3 * nodes_ * a, 3 * nodes_) = mesh_.sign(e, a) * tractions.col(mesh_.sidesOfElement(e)[a]);
    for (int j = 0; j < stress.sourceNodes(); ++j) own.segment<3>(count_ + 3 * j) = element.sources.col(j);
    if (e < mesh_.own()) {
      stress.resultants(element.places, resultants);
      rest = std::max(rest, (resultants * own).cwiseAbs().maxCoeff());
      force = std::max(force, (resultants.cwiseAbs() * own.cwiseAbs()).maxCoeff());
    }
    stress.dataOf(element.places, element.stresses, computed);
    const Vector given = own;
    own -= computed;
    Eigen::Matrix3d map;
    for (int i = 0; i < 3; ++i) map.col(i) = element.places.col(i + 1) - element.places.col(0);
    stress.gram(map, element.compliance, gram);
    product.noalias() = gram * own;
    const double ofSupports = addSupports(mesh_, e, given, gram, product);
    Eigen::Map<Matrix>(&grams_[std::size_t(e) * count_ * count_], count_, count_) = gram.topLeftCorner(count_, count_);
    loads_.col(e) = product.head(count_);
    if (e < mesh_.own()) start_[e] = stress.energy(map, element.compliance, own) + ofSupports;
  }
  imbalance_ = force > 0.0 ? rest / force : 0.0;
}

void TractionSweeps::findStars() {
  std::map<std::pair<int, int>, Star> all;
  for (int e = 0; e < mesh_.own(); ++e) {
    const auto& vertices = mesh_.verticesOf(e);
    for (int a = 0; a < 4; ++a)
      for (int b = a + 1; b < 4; ++b) all.try_emplace({vertices[a], vertices[b]});
  }
  for (auto& [edge, star] : all) {
    for (const int e : mesh_.star(edge.first)) {
      const auto& vertices = mesh_.verticesOf(e);
      if (std::find(vertices.begin(), vertices.end(), edge.second) == vertices.end()) continue;
      star.elements.push_back(e);
      for (int a = 0; a < 4; ++a) {
        const int s = mesh_.sidesOfElement(e)[a];
        if (vertices[a] == edge.first || vertices[a] == edge.second) continue;
        if (std::find(star.sides.begin(), star.sides.end(), s) == star.sides.end()) star.sides.push_back(s);
      }
    }
    stars_.push_back(std::move(star));
  }
}

Vector TractionSweeps::gather(const Matrix& field, int e) const {
  Vector values(count_);
  for (int a = 0; a < 4; ++a) values.segment(3 * nodes_ * a, 3 * nodes_) = mesh_.sign(e, a) * field.col(mesh_.sidesOfElement(e)[a]);
  return values;
}

void TractionSweeps::scatter(const Vector& values, int e, Matrix& field) const {
  for (int a = 0; a < 4; ++a) field.col(mesh_.sidesOfElement(e)[a]) += mesh_.sign(e, a) * values.segment(3 * nodes_ * a, 3 * nodes_);
}

Matrix TractionSweeps::product(const Matrix& p) const {
  Matrix result = Matrix::Zero(p.rows(), p.cols());
  for (int e = 0; e < mesh_.elements(); ++e) scatter(gram(e) * gather(p, e), e, result);
  return result;
}

Matrix TractionSweeps::precondition(const Matrix& r) const {
  Matrix z = Matrix::Zero(r.rows(), r.cols());
  for (const Star& star : stars_) solveStar(star, r, z);
  return z;
}

void TractionSweeps::solveStar(const Star& star, const Matrix& r, Matrix& z) const {
  const StressElement<3>& stress = StressElement<3>::of(mesh_.degree());
  std::vector<Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>> directions;
  std::vector<int> begin{0};
  for (const int s : star.sides) {
    directions.push_back(freeDirections(mesh_, s));
    begin.push_back(begin.back() + nodes_ * int(directions.back().cols()));
  }
  const int n = begin.back(), equations = 6 * int(star.elements.size());
  if (n == 0) return;
  Matrix energy = Matrix::Zero(n, n), balance = Matrix::Zero(n, equations), resultants;
  for (std::size_t i = 0; i < star.elements.size(); ++i) {
    const int e = star.elements[i];
    const auto own = gram(e);
    stress.resultants(mesh_.element(e).places, resultants);
    int place[4];
    for (int a = 0; a < 4; ++a) {
      const auto found = std::find(star.sides.begin(), star.sides.end(), mesh_.sidesOfElement(e)[a]);
      place[a] = found == star.sides.end() ? -1 : int(found - star.sides.begin());
    }
    for (int a = 0; a < 4; ++a) {
      if (place[a] < 0) continue;
      const auto& da = directions[place[a]];
      for (int j = 0; j < nodes_; ++j) {
        const int row = begin[place[a]] + int(da.cols()) * j, from = 3 * (nodes_ * a + j);
        balance.block(row, 6 * int(i), da.cols(), 6) = mesh_.sign(e, a) * da.transpose() * resultants.block(0, from, 6, 3).transpose();
        for (int b = 0; b < 4; ++b) {
          if (place[b] < 0) continue;
          const auto& db = directions[place[b]];
          for (int k = 0; k < nodes_; ++k)
            energy.block(row, begin[place[b]] + int(db.cols()) * k, da.cols(), db.cols()) +=
                mesh_.sign(e, a) * mesh_.sign(e, b) * da.transpose() * own.block<3, 3>(from, 3 * (nodes_ * b + k)) * db;
        }
      }
    }
  }
  Vector load(n);
  for (std::size_t i = 0; i < star.sides.size(); ++i)
    for (int j = 0; j < nodes_; ++j)
      load.segment(begin[i] + directions[i].cols() * j, directions[i].cols()) =
          directions[i].transpose() * r.col(star.sides[i]).segment<3>(3 * j);
  // Unknowns of equal weight, so that the rank does not depend on the size of the sides.
  const Vector scale = energy.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  balance = scale.asDiagonal() * balance;
  for (int c = 0; c < equations; ++c) {
    const double norm = balance.col(c).norm();
    if (norm > 0.0) balance.col(c) /= norm;
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(balance);
  qr.setThreshold(kDependentRow);
  const int rank = int(qr.rank()), free = n - rank;
  if (free == 0) return;
  Matrix turned = scale.asDiagonal() * energy * scale.asDiagonal();
  const auto q = qr.householderQ();
  turned.applyOnTheRight(q);
  turned.applyOnTheLeft(q.adjoint());
  Vector x = scale.cwiseProduct(load);
  x.applyOnTheLeft(q.adjoint());
  x.head(rank).setZero();
  const Eigen::LDLT<Matrix> factor(turned.bottomRightCorner(free, free));
  x.tail(free) = factor.solve(x.tail(free).eval());
  x.applyOnTheLeft(q);
  x = scale.cwiseProduct(x);
  for (std::size_t i = 0; i < star.sides.size(); ++i)
    for (int j = 0; j < nodes_; ++j)
      z.col(star.sides[i]).segment<3>(3 * j) += directions[i] * x.segment(begin[i] + directions[i].cols() * j, directions[i].cols());
}

double TractionSweeps::dot(const Matrix& a, const Matrix& b) const {
  double mine = 0.0, all = 0.0;
  for (int s = 0; s < mesh_.sides(); ++s)
    if (mesh_.countsSide(s)) mine += a.col(s).dot(b.col(s));
  Teuchos::reduceAll(mesh_.comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

void TractionSweeps::run(int sweeps) {
  Matrix r = Matrix::Zero(3 * nodes_, mesh_.sides()), p = r, x = r;
  for (int e = 0; e < mesh_.elements(); ++e) scatter(-loads_.col(e), e, r);
  double before = 0.0;
  SweepGain gain(mesh_.comm(), start_.sum(), sweeps);
  while (gain.worthAnotherSweep()) {
    const int i = gain.sweeps();
    Matrix z;
    collectively(mesh_.comm(), "improving stresses", [&] { z = precondition(r); });
    const double rz = dot(r, z);
    if (!(rz > 0.0)) break;
    p = (z + (i == 0 ? 0.0 : rz / before) * p).eval();
    before = rz;
    mesh_.exchangeSides(p);
    const Matrix q = product(p);
    const double step = rz / dot(p, q);
    gain.add(step * rz);
    x += step * p;
    r -= step * q;
  }
  for (int e = 0; e < mesh_.own(); ++e) {
    const Vector own = gather(x, e);
    change_[e] = 2 * own.dot(loads_.col(e)) + own.dot(gram(e) * own);
  }
}

}  // namespace suture
