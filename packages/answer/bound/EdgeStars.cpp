#include <Eigen/QR>
#include <Eigen/SVD>
#include <suture/algebra/Blas.hpp>
#include <suture/algebra/Lanes.hpp>
#include <suture/answer/bound/EdgeStars.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Relative size of resultants that a restricted face cannot transmit, below which it is round-off.
constexpr double kTransmitted = 1e-9;
// Diagonal of a factor, squared and relative to the matrix, below which an unknown changes no stress.
constexpr double kNoStarStress = 1e-12;

/// Solves with a factor: rows of the lower triangle, diagonals inverted.
SUTURE_FOR_EACH_PROCESSOR
void solveRows(const float* factor, int n, double* x) {
  using Many = Register<double>;
  using Stored = Lanes<float, Many::count * sizeof(float)>;
  const float* row = factor;
  for (int i = 0; i < n; row += ++i) {
    Many::Type sum = {};
    int k = 0;
    for (; k + Many::count <= i; k += Many::count) sum += __builtin_convertvector(Stored::at(row + k), Many::Type) * Many::at(x + k);
    double value = x[i] - ((sum[0] + sum[1]) + (sum[2] + sum[3]));
    for (; k < i; ++k) value -= double(row[k]) * x[k];
    x[i] = value * double(row[i]);
  }
  for (int i = n - 1; i >= 0; --i) {
    row -= i + 1;
    const double value = x[i] * double(row[i]);
    x[i] = value;
    int k = 0;
    for (; k + Many::count <= i; k += Many::count) Many::at(x + k) -= value * __builtin_convertvector(Stored::at(row + k), Many::Type);
    for (; k < i; ++k) x[k] -= value * double(row[k]);
  }
}

/// Cholesky factor of the lower triangle that leaves out unknowns whose stress is that of others.
void factorWithout(Matrix& a) {
  const int n = int(a.rows());
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) a(i, j) = a(j, j) == 0.0 ? 0.0 : (a(i, j) - a.row(i).head(j).dot(a.row(j).head(j))) / a(j, j);
    const double value = a(i, i) - a.row(i).head(i).squaredNorm();
    a(i, i) = value > kNoStarStress * a(i, i) ? std::sqrt(value) : 0.0;
  }
}

}  // namespace

template <int K>
EdgeStars<K>::EdgeStars(const StarMesh<3>& mesh, const std::vector<Face>& faces) : mesh_(mesh), faces_(faces) {
  mesh.forEachEdge([&](int v, int w, const std::vector<int>& elements, bool isOwn) {
    if (isOwn) walk(v, w, elements);
  });
  Star end;
  end.faces = int(sides_.size()), end.betweens = int(betweens_.size());
  stars_.push_back(end);
}

/// Orders the tetrahedra and faces at an edge; where these form several fans, each is a star.
template <int K>
void EdgeStars<K>::walk(int v, int w, std::vector<int> elements) {
  const auto sidesAt = [&](int e) {
    std::array<int, 2> both{};
    for (int a = 0, n = 0; a < 4; ++a)
      if (mesh_.verticesOf(e)[a] != v && mesh_.verticesOf(e)[a] != w) both[n++] = mesh_.sidesOfElement(e)[a];
    return both;
  };
  std::vector<int> order, sides;
  while (!elements.empty()) {
    int element = elements.front(), side = sidesAt(element)[0];
    for (const int e : elements)
      for (const int s : sidesAt(e))
        if (mesh_.elementsOfSide(s)[1] < 0) element = e, side = s;
    order.clear();
    sides.assign(1, side);
    while (true) {
      const auto found = std::find(elements.begin(), elements.end(), element);
      if (found == elements.end()) break;  // around
      elements.erase(found);
      order.push_back(element);
      const auto both = sidesAt(element);
      side = both[0] == side ? both[1] : both[0];
      const auto& next = mesh_.elementsOfSide(side);
      sides.push_back(side);
      if (next[1] < 0) break;
      element = next[0] == element ? next[1] : next[0];
    }
    addFan(order, sides, v, w);
  }
}

/// \param sides  before each tetrahedron and behind the last one: the first one again if the fan is closed
template <int K>
void EdgeStars<K>::addFan(const std::vector<int>& elements, const std::vector<int>& sides, int v, int w) {
  Star star;
  star.faces = int(sides_.size()), star.betweens = int(betweens_.size());
  star.centre = 0.5 * (mesh_.place(v) + mesh_.place(w));
  const bool closed = sides.size() > 1 && sides.front() == sides.back();
  std::vector<int> places(sides.size(), -1);
  const auto numberIn = [&](int e, int s) {
    const auto& all = mesh_.sidesOfElement(e);
    return int(std::find(all.begin(), all.end(), s) - all.begin());
  };
  double sign = 1.0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0) {
      const int e = elements[i - 1];
      sign *= -mesh_.sign(e, numberIn(e, sides[i - 1])) * mesh_.sign(e, numberIn(e, sides[i]));
    }
    if (closed && i + 1 == sides.size()) {
      places[i] = places[0];
      continue;
    }
    if (!faces_[sides[i]].isFree) continue;
    places[i] = int(sides_.size()) - star.faces;
    sides_.push_back(sides[i]);
    signs_.push_back(sign);
    star.area += faces_[sides[i]].area, star.size += faces_[sides[i]].size;
  }
  const int free = int(sides_.size()) - star.faces;
  if (free == 0) return;
  star.area /= free, star.size /= free;
  for (std::size_t i = 0; i < elements.size(); ++i)
    betweens_.push_back({elements[i], {numberIn(elements[i], sides[i]), numberIn(elements[i], sides[i + 1])}, {places[i], places[i + 1]}});
  for (const int end : {sides.front(), sides.back()}) restrict(star, end);
  stars_.push_back(star);
}

/// Force and moment over area and size of the face, about its centroid, from those of the star about its centre.
template <int K>
typename EdgeStars<K>::Transfer EdgeStars<K>::transfer(const Star& star, int side) const {
  const Face& face = faces_[side];
  const Eigen::Vector3d arm = (star.centre - face.centre) / face.size;
  Transfer t = Transfer::Identity();
  t.template bottomRightCorner<3, 3>() *= star.size / face.size;
  t.template bottomLeftCorner<3, 3>() << 0, -arm[2], arm[1], arm[2], 0, -arm[0], -arm[1], arm[0], 0;
  t *= star.area / face.area;
  return star.restricted < 0 ? t : Transfer(t * restricted_[star.restricted]);
}

/// Leaves what a face at the boundary can transmit.
template <int K>
void EdgeStars<K>::restrict(Star& star, int end) {
  if (star.wrenches == 0) return;
  const Face& face = faces_[end];
  if (!face.isFree) {
    star.wrenches = 0;
    return;
  }
  if (!face.isRestricted) return;
  const Transfer impossible = (Transfer::Identity() - face.possible) * transfer(star, end);
  const Eigen::JacobiSVD<Matrix> svd(Matrix(impossible.leftCols(star.wrenches)), Eigen::ComputeFullV);
  const double scale = transfer(star, end).norm();
  const int lost = int((svd.singularValues().array() > kTransmitted * scale).count()), left = star.wrenches - lost;
  Transfer basis = Transfer::Zero();
  const Transfer before = star.restricted < 0 ? Transfer(Transfer::Identity()) : restricted_[star.restricted];
  basis.leftCols(left) = before.leftCols(star.wrenches) * svd.matrixV().rightCols(left);
  star.wrenches = left;
  star.restricted = int(restricted_.size());
  restricted_.push_back(basis);
}

template <int K>
Matrix EdgeStars<K>::matrixOf(std::size_t number, const std::vector<double>& grams) const {
  const Star& star = stars_[number];
  const int n = unknowns(number), w = star.wrenches;
  Matrix a = Matrix::Zero(n, n);
  Eigen::Matrix<double, count, count> own;
  Eigen::Matrix<double, count, 6> column;
  for (int b = star.betweens; b < stars_[number + 1].betweens; ++b) {
    const Between& between = betweens_[b];
    const double* gram = &grams[std::size_t(between.element) * (ofElement * (ofElement + 1) / 2)];
    Transfer transfers[2];
    double signs[2];
    for (int i = 0; i < 2; ++i) {
      if (between.places[i] < 0) continue;
      const int at = star.faces + between.places[i];
      signs[i] = mesh_.sign(between.element, between.sides[i]);
      transfers[i] = signs_[at] * signs[i] * transfer(star, sides_[at]);
    }
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        if (between.places[i] < 0 || between.places[j] < 0) continue;
        for (int p = 0; p < count; ++p)
          for (int q = 0; q < count; ++q) {
            const int row = count * between.sides[i] + p, col = count * between.sides[j] + q;
            own(p, q) = row >= col ? gram[row * (row + 1) / 2 + col] : gram[col * (col + 1) / 2 + row];
          }
        const int at = w + balanced * between.places[i], to = w + balanced * between.places[j];
        if (at >= to) a.template block<balanced, balanced>(at, to) += signs[i] * signs[j] * own.template block<balanced, balanced>(6, 6);
        if (w == 0) continue;
        column.noalias() = own.template leftCols<6>() * transfers[j];
        a.block(at, 0, balanced, w) += signs[i] * column.template bottomRows<balanced>().leftCols(w);
        a.topLeftCorner(w, w) += (transfers[i].transpose() * column.template topRows<6>()).topLeftCorner(w, w);
      }
  }
  return a;
}

template <int K>
void EdgeStars<K>::factor(const std::vector<double>& grams) {
  std::size_t size = 0;
  for (std::size_t s = 0; s + 1 < stars_.size(); ++s) {
    stars_[s].factor = size;
    size += std::size_t(unknowns(s)) * (unknowns(s) + 1) / 2;
  }
  factors_.resize(size);
  for (std::size_t s = 0; s + 1 < stars_.size(); ++s) {
    const int n = unknowns(s);
    Matrix a = matrixOf(s, grams);
    for (int i = 0; i < n; ++i)
      if (a(i, i) == 0.0) a(i, i) = 1.0;  // no such traction: its loads are zero
    const Matrix copy = a;
    bool isSafe = potrf(n, a.data());
    for (int i = 0; i < n && isSafe; ++i) isSafe = a(i, i) * a(i, i) > kNoStarStress * copy(i, i);
    if (!isSafe) {
      a = copy;
      factorWithout(a);
    }
    float* next = &factors_[stars_[s].factor];
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) *next++ = float(a(i, j));
      *next++ = a(i, i) == 0.0 ? 0.0F : float(1.0 / a(i, i));
    }
  }
}

template <int K>
void EdgeStars<K>::apply(const Matrix& r, Matrix& z) const {
  z.setZero();
  std::vector<double> x;
  std::vector<Transfer> transfers;
  for (std::size_t s = 0; s + 1 < stars_.size(); ++s) {
    const Star& star = stars_[s];
    const int n = unknowns(s), w = star.wrenches, faces = stars_[s + 1].faces - star.faces;
    x.assign(std::size_t(n), 0.0);
    transfers.resize(std::size_t(faces));
    Eigen::Map<Vector> own(x.data(), n);
    for (int i = 0; i < faces; ++i) {
      const int side = sides_[star.faces + i];
      own.segment<balanced>(w + balanced * i) = r.col(side).template tail<balanced>();
      if (w == 0) continue;
      transfers[i] = signs_[star.faces + i] * transfer(star, side);
      own.head(w) += (transfers[i].transpose() * r.col(side).template head<6>()).head(w);
    }
    solveRows(&factors_[star.factor], n, x.data());
    for (int i = 0; i < faces; ++i) {
      auto to = z.col(sides_[star.faces + i]);
      to.template tail<balanced>() += own.segment<balanced>(w + balanced * i);
      if (w > 0) to.template head<6>() += transfers[i].leftCols(w) * own.head(w);
    }
  }
}

template class EdgeStars<1>;
template class EdgeStars<2>;

}  // namespace suture
