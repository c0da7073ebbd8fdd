#include <Eigen/QR>
#include <suture/answer/bound/EquilibratedTractions.hpp>
#include <suture/answer/bound/PressedSides.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Unbalanced force at a node, relative to the largest force, above which it is not round-off of the solution: coarser than the balance that
// solvers reach (1e-10 after balanceForces), far below any effect on a bound.
constexpr double kUnbalanced = 1e-8;
// Pivot, relative to the largest, below which equations of a star depend on the others; the coefficients are of order one.
constexpr double kDependentMoment = 1e-9;

/// The simplices and sides at a node, and the equations of their moments.
template <int D>
class NodeStar {
 public:
  NodeStar(const StarMesh<D>& mesh, Matrix& moments) : mesh_(mesh), moments_(moments), side_(sideNodes()) {}

  void clear() { elements_.clear(), sides_.clear(); }
  /// Adds a simplex that has the node. \param node  its number there
  void add(int e, int node) {
    elements_.push_back({e, node});
    for (int a = 0; a <= D; ++a)
      for (int j = 0; j < side_; ++j)
        if (SimplexNodes<D>::ofSide(a, j) == node) addSide(int(elements_.size()) - 1, mesh_.sidesOfElement(e)[a], j, mesh_.sign(e, a));
  }
  /// Changes the moments of the node. Returns the largest rest of force.
  double balance() {
    const int n = int(elements_.size());
    if (rest_.cols() < n) rest_.resize(D, n);
    rest_.setZero();
    for (int i = 0; i < n; ++i) rest_.col(i) = mesh_.element(elements_[i].element).forces.col(elements_[i].node);
    bool turned = false;
    for (const OfSide& side : sides_) {
      const auto moment = moments_.col(side.side).template segment<D>(D * side.node);
      for (int k = 0; k < 2; ++k)
        if (side.element[k] >= 0) rest_.col(side.element[k]) -= side.sign[k] * moment;
      turned = turned || (side.unknown != all && side.unknown != 0 && !mesh_.boundaryOf(side.side)->axes.isIdentity(0.0));
    }
    if (turned) return balanceTogether();
    double largest = 0.0;
    for (int k = 0; k < D; ++k) largest = std::max(largest, balanceComponent(k));
    return largest;
  }

 private:
  static constexpr unsigned all = (1u << D) - 1;
  struct OfElement {
    int element, node;
  };
  struct OfSide {
    int side, node;             // node: number on the side
    int element[2] = {-1, -1};  // places in elements_
    double sign[2] = {0, 0};
    unsigned unknown = all;
  };

  int sideNodes() const { return SimplexNodes<D>::sideNodes(mesh_.degree()); }
  void addSide(int place, int s, int j, double sign) {
    for (OfSide& side : sides_)
      if (side.side == s) {
        side.element[1] = place, side.sign[1] = sign;
        return;
      }
    OfSide side{s, j};
    side.element[0] = place, side.sign[0] = sign;
    if (const SideCondition<D>* boundary = mesh_.boundaryOf(s)) side.unknown = all & ~boundary->known;
    sides_.push_back(side);
  }

  /// The least change of the moments' component k. The matrix of the normal equations is the Laplacian of the graph of simplices and
  /// sides. Its factor serves further components with the same unknowns.
  double balanceComponent(int k) {
    const int n = int(elements_.size());
    bool same = k > 0;
    for (const OfSide& side : sides_) same = same && (side.unknown >> k & 1u) == (side.unknown >> (k - 1) & 1u);
    if (!same) factorLaplacian(k);
    y_.resize(n);
    for (int i = 0; i < n; ++i) {
      double value = rest_(k, i);
      for (int j = 0; j < i; ++j) value -= factor_[std::size_t(i) * n + j] * y_[j];
      y_[i] = value / factor_[std::size_t(i) * n + i];
    }
    for (int i = n - 1; i >= 0; --i) {
      for (int j = i + 1; j < n; ++j) y_[i] -= factor_[std::size_t(j) * n + i] * y_[j];
      y_[i] /= factor_[std::size_t(i) * n + i];
    }
    for (const OfSide& side : sides_) {
      if (!(side.unknown >> k & 1u)) continue;
      double change = 0.0;
      for (int i = 0; i < 2; ++i)
        if (side.element[i] >= 0) change += side.sign[i] * y_[side.element[i]];
      moments_(D * side.node + k, side.side) += change;
      for (int i = 0; i < 2; ++i)
        if (side.element[i] >= 0) rest_(k, side.element[i]) -= side.sign[i] * change;
    }
    return rest_.row(k).cwiseAbs().maxCoeff();
  }

  /// Each connected set of simplices without a side at the boundary whose traction is unknown gets one more entry on the diagonal: the
  /// solution does not depend on it, because the forces of such a set sum to zero.
  void factorLaplacian(int k) {
    const int n = int(elements_.size());
    factor_.assign(std::size_t(n) * n, 0.0);
    root_.resize(n);
    for (int i = 0; i < n; ++i) root_[i] = i;
    const auto rootOf = [&](int i) {
      while (root_[i] != i) i = root_[i];
      return i;
    };
    for (const OfSide& side : sides_) {
      if (!(side.unknown >> k & 1u)) continue;
      const int i = side.element[0], j = side.element[1];
      factor_[std::size_t(i) * n + i] += 1;
      if (j < 0) continue;
      factor_[std::size_t(j) * n + j] += 1;
      factor_[std::size_t(std::max(i, j)) * n + std::min(i, j)] += side.sign[0] * side.sign[1];
      root_[rootOf(std::max(rootOf(i), rootOf(j)))] = std::min(rootOf(i), rootOf(j));
    }
    std::vector<char>& grounded = grounded_;
    grounded.assign(n, 0);
    for (const OfSide& side : sides_)
      if ((side.unknown >> k & 1u) && side.element[1] < 0) grounded[rootOf(side.element[0])] = 1;
    for (int i = 0; i < n; ++i)
      if (rootOf(i) == i && !grounded[i]) factor_[std::size_t(i) * n + i] += 1;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        double value = factor_[std::size_t(i) * n + j];
        for (int l = 0; l < j; ++l) value -= factor_[std::size_t(i) * n + l] * factor_[std::size_t(j) * n + l];
        factor_[std::size_t(i) * n + j] = i == j ? std::sqrt(value) : value / factor_[std::size_t(j) * n + j];
      }
  }

  /// The same for all components, where those of boundary conditions are not along the coordinate axes.
  double balanceTogether() {
    const int n = int(elements_.size());
    struct Unknown {
      const OfSide* side;
      Eigen::Matrix<double, D, 1> along;
    };
    std::vector<Unknown> unknowns;
    for (const OfSide& side : sides_)
      for (int k = 0; k < D; ++k) {
        if (!(side.unknown >> k & 1u)) continue;
        const SideCondition<D>* boundary = mesh_.boundaryOf(side.side);
        unknowns.push_back({&side, boundary ? Eigen::Matrix<double, D, 1>(boundary->axes.row(k).transpose())
                                            : Eigen::Matrix<double, D, 1>(Eigen::Matrix<double, D, 1>::Unit(k))});
      }
    Matrix equations = Matrix::Zero(D * n, int(unknowns.size()));
    for (std::size_t c = 0; c < unknowns.size(); ++c)
      for (int i = 0; i < 2; ++i)
        if (unknowns[c].side->element[i] >= 0)
          equations.col(int(c)).template segment<D>(D * unknowns[c].side->element[i]) = unknowns[c].side->sign[i] * unknowns[c].along;
    const Vector rest = Eigen::Map<const Vector>(rest_.data(), D * n);
    Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition;
    decomposition.setThreshold(kDependentMoment);
    decomposition.compute(equations);
    const Vector change = decomposition.solve(rest);
    for (std::size_t c = 0; c < unknowns.size(); ++c)
      moments_.col(unknowns[c].side->side).template segment<D>(D * unknowns[c].side->node) += change[int(c)] * unknowns[c].along;
    return (equations * change - rest).cwiseAbs().maxCoeff();
  }

  const StarMesh<D>& mesh_;
  Matrix& moments_;
  int side_;
  std::vector<OfElement> elements_;
  std::vector<OfSide> sides_;
  Eigen::Matrix<double, D, Eigen::Dynamic> rest_;
  std::vector<double> factor_, y_;
  std::vector<int> root_;
  std::vector<char> grounded_;
};

template <int D>
Eigen::Matrix<double, D, D> tensor(const Eigen::Matrix<double, BoundElement<D>::stress, 1>& s) {
  Eigen::Matrix<double, D, D> t;
  if constexpr (D == 2)
    t << s[0], s[2], s[2], s[1];
  else
    t << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return t;
}

/// Tractions of the elements' stresses, averaged over the simplices of a side; the given ones at the boundary.
template <int D>
Matrix averagedTractions(const StarMesh<D>& mesh) {
  const int count = SimplexNodes<D>::sideNodes(mesh.degree());
  Matrix values = Matrix::Zero(D * count, mesh.sides());
  std::vector<int> adds(mesh.sides(), 0);
  for (int e = 0; e < mesh.elements(); ++e)
    for (int a = 0; a <= D; ++a) {
      const int s = mesh.sidesOfElement(e)[a];
      ++adds[s];
      const auto at = [&](int vertex) -> Eigen::Matrix<double, D, 1> {
        return tensor<D>(mesh.element(e).stresses.col(vertex)) * mesh.normal(s);
      };
      for (int j = 0; j < count; ++j) {
        Eigen::Matrix<double, D, 1> traction;
        const int node = SimplexNodes<D>::ofSide(a, j);
        if (node <= D) {
          traction = at(node);
        } else {
          const auto& ends = SimplexNodes<D>::ends[node - D - 1];
          traction = 0.5 * (at(ends[0]) + at(ends[1]));
        }
        values.col(s).template segment<D>(D * j) += traction;
      }
    }
  for (int s = 0; s < mesh.sides(); ++s) {
    values.col(s) /= adds[s];
    const SideCondition<D>* boundary = mesh.boundaryOf(s);
    if (!boundary) continue;
    const int e = mesh.elementsOfSide(s)[0];
    double sign = 1.0;
    for (int a = 0; a <= D; ++a)
      if (mesh.sidesOfElement(e)[a] == s) sign = mesh.sign(e, a);
    for (int j = 0; j < count; ++j)
      for (int k = 0; k < D; ++k)
        if (boundary->known >> k & 1u) {
          const Eigen::Matrix<double, D, 1> axis = boundary->axes.row(k).transpose();
          auto value = values.col(s).template segment<D>(D * j);
          value += axis * (sign * axis.dot(boundary->traction.col(j)) - axis.dot(value));
        }
  }
  return values;
}

}  // namespace

template <int D>
EquilibratedTractions<D> equilibratedTractions(const StarMesh<D>& mesh) {
  using Nodes = SimplexNodes<D>;
  const int degree = mesh.degree(), count = Nodes::sideNodes(degree);
  const Matrix& mass = sideMass(D, degree);
  EquilibratedTractions<D> result;
  Matrix moments = averagedTractions(mesh);
  const auto multiply = [&](Matrix& values, const Matrix& factor, bool divides) {
    for (int s = 0; s < mesh.sides(); ++s) {
      Eigen::Map<Eigen::Matrix<double, D, Eigen::Dynamic>> own(values.col(s).data(), D, count);
      own = (own * factor * (divides ? 1.0 / mesh.size(s) : mesh.size(s))).eval();
    }
  };
  multiply(moments, mass, false);
  double worst = 0.0, largest = 0.0;
  std::vector<std::pair<double, Point>> rests;
  const auto finish = [&](NodeStar<D>& star, const Point& place, bool isCounted) {
    const double rest = star.balance();
    if (isCounted && rest > 0.0) rests.push_back({rest, place});
  };
  collectively(mesh.comm(), "balancing tractions", [&] {
    for (int e = 0; e < mesh.own(); ++e)
      largest = std::max(largest, mesh.element(e).forces.leftCols(Nodes::nodes(degree)).cwiseAbs().maxCoeff());
    NodeStar<D> star(mesh, moments);
    const auto placeOf = [&](int v) {
      Point p{0, 0, 0};
      for (int k = 0; k < D; ++k) p[k] = mesh.place(v)[k];
      return p;
    };
    for (int v = 0; v < mesh.vertices(); ++v) {
      if (!mesh.isComplete(v)) continue;
      star.clear();
      for (const int e : mesh.star(v))
        star.add(e, int(std::find(mesh.verticesOf(e).begin(), mesh.verticesOf(e).end(), v) - mesh.verticesOf(e).begin()));
      finish(star, placeOf(v), mesh.counts(v));
    }
    if (degree == 1) return;
    for (int v = 0; v < mesh.vertices(); ++v) {  // edges from v to higher vertices
      if (!mesh.isComplete(v)) continue;
      std::vector<std::pair<int, int>> edges;  // other end, simplex
      for (const int e : mesh.star(v))
        for (const int w : mesh.verticesOf(e))
          if (w > v) edges.push_back({w, e});
      std::sort(edges.begin(), edges.end());
      for (std::size_t i = 0; i < edges.size();) {
        star.clear();
        const int w = edges[i].first;
        bool own = false;
        for (; i < edges.size() && edges[i].first == w; ++i) {
          const int e = edges[i].second;
          own = own || e < mesh.own();
          const auto& all = mesh.verticesOf(e);
          const int a = int(std::find(all.begin(), all.end(), v) - all.begin()),
                    b = int(std::find(all.begin(), all.end(), w) - all.begin());
          star.add(e, D + 1 + Nodes::edge(a, b));
        }
        if (own) finish(star, placeOf(v), mesh.counts(v));
      }
    }
  });
  const double mine = largest;
  Teuchos::reduceAll(mesh.comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  int unbalanced = 0;
  Point place{0, 0, 0};
  for (const auto& [rest, at] : rests) {
    if (rest > kUnbalanced * largest) ++unbalanced;
    if (rest > worst) worst = rest, place = at;
  }
  std::vector<double> all = joinEverywhere(mesh.comm(), std::vector<double>{worst, double(unbalanced), place[0], place[1], place[2]});
  for (std::size_t i = 0; i < all.size(); i += 5) {
    result.unbalanced += int(all[i + 1]);
    if (largest > 0.0 && all[i] / largest > result.rest)
      result.rest = all[i] / largest, result.worst = {all[i + 2], all[i + 3], all[i + 4]};
  }
  multiply(moments, mass.inverse(), true);
  result.values = std::move(moments);
  mesh.exchangeSides(result.values);
  return result;
}

template struct EquilibratedTractions<2>;
template struct EquilibratedTractions<3>;
template EquilibratedTractions<2> equilibratedTractions(const StarMesh<2>&);
template EquilibratedTractions<3> equilibratedTractions(const StarMesh<3>&);

}  // namespace suture
