#include <Eigen/LU>
#include <Eigen/QR>
#include <suture/answer/bound/AlfeldStresses.hpp>

namespace suture {

namespace {

constexpr double kNoEquation = 1e-9;  // pivots below this fraction of the largest are zero

/// The linear equations A (stress) = H (data) of the reference simplex, row by row.
template <int D>
class AlfeldEquations {
 public:
  explicit AlfeldEquations(int degree) : basis_(degree), sides_(degree), sources_(degree == 1 ? 1 : D + 1) {
    for (int part = 0; part <= D; ++part) {
      Corners corners;
      int n = 0;
      for (const int vertex : verticesOfSide<D>(part)) corners.col(n++) << 1.0, vertexAt(vertex);
      corners.col(D) << 1.0, centroid();
      toBarycentric_[part] = corners.inverse();
    }
    unknowns_ = (D + 1) * basis_.nodes() * components;
    tractions_ = (D + 1) * sides_.nodes() * D;
    addInnerSides();
    addEquilibrium();
    addOuterSides();
  }

  /// Coefficients of unknowns, and of data on the right-hand side.
  Matrix unknowns() const { return gathered(left_, unknowns_); }
  Matrix data() const { return gathered(right_, tractions_ + sources_ * D); }

 private:
  using Place = Eigen::Matrix<double, D, 1>;
  using Corners = Eigen::Matrix<double, D + 1, D + 1>;
  using Barycentric = Eigen::Matrix<double, D + 1, 1>;
  static constexpr int components = AlfeldStresses<D>::components;

  static Place vertexAt(int i) { return i == 0 ? Place(Place::Zero()) : Place(Place::Unit(i - 1)); }
  static Place centroid() { return Place::Constant(1.0 / (D + 1)); }

  Barycentric barycentric(int part, const Place& place) const {
    Barycentric one;
    one << 1.0, place;
    return toBarycentric_[part] * one;
  }
  static Matrix gathered(const std::vector<Vector>& rows, int columns) {
    Matrix matrix(Eigen::Index(rows.size()), columns);
    for (std::size_t i = 0; i < rows.size(); ++i) matrix.row(Eigen::Index(i)) = rows[i];
    return matrix;
  }
  /// Adds `factor` times row `i` of (stress n) at a point of a part.
  void addTraction(int part, const Place& place, const Place& normal, int i, double factor, Vector& row) const {
    const Vector values = basis_.values(barycentric(part, place));
    for (int node = 0; node < basis_.nodes(); ++node)
      for (int q = 0; q < components; ++q) {
        const auto [a, b] = tensorAxes<D>()[q];
        double& entry = row((part * basis_.nodes() + node) * components + q);
        if (a == i) entry += factor * values(node) * normal(b);
        if (b == i && a != b) entry += factor * values(node) * normal(a);
      }
  }
  void addInnerSides() {
    for (int a = 0; a <= D; ++a)
      for (int b = a + 1; b <= D; ++b) {
        // The side has the centroid and the vertices but a and b. Its normal vanishes on the plane of these: barycentric coordinate of b.
        const Place normal = toBarycentric_[a].row(positionIn(a, b)).template tail<D>().transpose().normalized();
        Eigen::Matrix<double, D, D> corners;
        int n = 0;
        for (int i = 0; i <= D; ++i)
          if (i != a && i != b) corners.col(n++) = vertexAt(i);
        corners.col(n) = centroid();
        for (int node = 0; node < sides_.nodes(); ++node)
          for (int i = 0; i < D; ++i) {
            const Place place = corners * sides_.place(node);
            Vector row = Vector::Zero(unknowns_);
            addTraction(a, place, normal, i, 1.0, row);
            addTraction(b, place, normal, i, -1.0, row);
            add(row, Vector::Zero(tractions_ + sources_ * D));
          }
      }
  }
  static int positionIn(int part, int vertex) { return vertex < part ? vertex : vertex - 1; }

  /// The divergence of each part at as many points as determine it.
  void addEquilibrium() {
    const int points = sources_ == 1 ? 1 : D + 1;
    for (int part = 0; part <= D; ++part)
      for (int point = 0; point < points; ++point) {
        const Barycentric at = points == 1 ? Barycentric(Barycentric::Constant(1.0 / (D + 1))) : Barycentric(Barycentric::Unit(point));
        const Matrix gradients = basis_.derivatives(at) * toBarycentric_[part].template rightCols<D>();
        const Place place =
            point == D || points == 1 ? Place(points == 1 ? meanPlace(part) : centroid()) : vertexAt(verticesOfSide<D>(part)[point]);
        for (int i = 0; i < D; ++i) {
          Vector row = Vector::Zero(unknowns_), data = Vector::Zero(tractions_ + sources_ * D);
          for (int node = 0; node < basis_.nodes(); ++node)
            for (int q = 0; q < components; ++q) {
              const auto [a, b] = tensorAxes<D>()[q];
              double& entry = row((part * basis_.nodes() + node) * components + q);
              if (a == i) entry += gradients(node, b);
              if (b == i && a != b) entry += gradients(node, a);
            }
          if (sources_ == 1)
            data(tractions_ + i) = -1.0;
          else
            for (int vertex = 0; vertex <= D; ++vertex)
              data(tractions_ + vertex * D + i) = vertex == 0 ? place.sum() - 1.0 : -place(vertex - 1);
          add(row, data);
        }
      }
  }
  static Place meanPlace(int part) {
    Place sum = centroid();
    for (const int vertex : verticesOfSide<D>(part)) sum += vertexAt(vertex);
    return sum / (D + 1);
  }
  void addOuterSides() {
    for (int side = 0; side <= D; ++side) {
      Eigen::Matrix<double, D, D> corners;
      int n = 0;
      for (const int vertex : verticesOfSide<D>(side)) corners.col(n++) = vertexAt(vertex);
      for (int node = 0; node < sides_.nodes(); ++node)
        for (int i = 0; i < D; ++i) {
          Vector row = Vector::Zero(unknowns_), data = Vector::Zero(tractions_ + sources_ * D);
          addTraction(side, corners * sides_.place(node), referenceNormal<D>(side), i, 1.0, row);
          data((side * sides_.nodes() + node) * D + i) = 1.0;
          add(row, data);
        }
    }
  }
  void add(const Vector& row, const Vector& data) {
    left_.push_back(row);
    right_.push_back(data);
  }

  SimplexBasis<D> basis_;
  SimplexBasis<D - 1> sides_;
  int sources_, unknowns_ = 0, tractions_ = 0;
  std::array<Corners, D + 1> toBarycentric_;  // acts on (1, place)
  std::vector<Vector> left_, right_;
};

}  // namespace

template <int D>
AlfeldStresses<D>::AlfeldStresses(int degree) {
  const AlfeldEquations<D> equations(degree);
  const Matrix left = equations.unknowns();
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition;
  decomposition.setThreshold(kNoEquation);
  decomposition.compute(left);
  unknowns = int(left.cols());
  rank = int(decomposition.rank());
  // For balanced data the equations have solutions; for others this is the least-squares solution.
  particular = decomposition.solve(equations.data());
  const Matrix directions = decomposition.matrixZ().transpose();
  free = decomposition.colsPermutation() * directions.rightCols(unknowns - rank);
}

template struct AlfeldStresses<2>;
template struct AlfeldStresses<3>;

}  // namespace suture
