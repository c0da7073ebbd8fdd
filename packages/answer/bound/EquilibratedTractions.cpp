#include <Eigen/QR>
#include <suture/answer/bound/EquilibratedTractions.hpp>
#include <suture/answer/bound/PlanarStar.hpp>
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

  int sideNodes() const { return SimplexNodes<D>::sideNodes(mesh_.order()); }
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

/// Replaces the given components of the tractions at the boundary. \param sign  +1 if the side's normal is the outward one, else -1
template <int D, int count>
void setGiven(const SideCondition<D>& boundary, double sign, Eigen::Matrix<double, D, count>& values) {
  for (int j = 0; j < count; ++j)
    for (int k = 0; k < D; ++k)
      if (boundary.known >> k & 1u) {
        const Eigen::Matrix<double, D, 1> axis = boundary.axes.row(k).transpose();
        values.col(j) += axis * (sign * axis.dot(boundary.traction.col(j)) - axis.dot(values.col(j)));
      }
}

/// Moments, with the functions of the sides' nodes, of the tractions of the elements' stresses, averaged over the simplices of a side;
/// those of the given tractions at the boundary. \tparam count  nodes of a side
template <int D, int count>
Matrix averagedMoments(const StarMesh<D>& mesh) {
  using Tractions = Eigen::Matrix<double, D, count>;
  const Eigen::Matrix<double, count, count> mass = sideMass(D, mesh.order());
  Matrix moments(D * count, mesh.sides());
  for (int s = 0; s < mesh.sides(); ++s) {
    const auto& both = mesh.elementsOfSide(s);
    Tractions values = Tractions::Zero();
    double sign = 1.0;
    for (int i = 0; i < 2 && both[i] >= 0; ++i) {
      const BoundElement<D>& element = mesh.element(both[i]);
      const auto& sides = mesh.sidesOfElement(both[i]);
      const int a = int(std::find(sides.begin(), sides.end(), s) - sides.begin());
      if (i == 0) sign = mesh.sign(both[i], a);
      Eigen::Matrix<double, D, D + 1> at;
      for (int v = 0; v <= D; ++v) at.col(v) = tensorOf<D>(element.stresses.col(v)) * mesh.normal(s);
      for (int j = 0; j < count; ++j) {
        const int node = SimplexNodes<D>::ofSide(a, j);
        if (node <= D) {
          values.col(j) += at.col(node);
        } else {
          const auto& ends = SimplexNodes<D>::ends[node - D - 1];
          values.col(j) += 0.5 * (at.col(ends[0]) + at.col(ends[1]));
        }
      }
    }
    if (both[1] >= 0) values *= 0.5;
    if (const SideCondition<D>* boundary = mesh.boundaryOf(s)) setGiven<D, count>(*boundary, sign, values);
    Eigen::Map<Tractions>(moments.col(s).data()).noalias() = mesh.size(s) * (values * mass);
  }
  return moments;
}

template <int D, int count>
void toTractions(const StarMesh<D>& mesh, Matrix& moments) {
  using Tractions = Eigen::Matrix<double, D, count>;
  const Eigen::Matrix<double, count, count> inverse = sideMass(D, mesh.order()).inverse();
  for (int s = 0; s < mesh.sides(); ++s) {
    Eigen::Map<Tractions> own(moments.col(s).data());
    own = (own * inverse / mesh.size(s)).eval();
  }
}

/// Linear tractions on the sides of triangles by their values at the nodes of degree 2.
Matrix ofDegree2(const Matrix& linear) {
  Matrix values(6, linear.cols());
  values.topRows<4>() = linear;
  values.bottomRows<2>() = 0.5 * (linear.topRows<2>() + linear.bottomRows<2>());
  return values;
}

/// Force at a node that no tractions balance.
struct RestAtNode {
  double size;
  int vertex;
};

/// Balances the moments of all nodes of own simplices. Returns the rests of those that count on this rank.
template <int D>
std::vector<RestAtNode> balance(const StarMesh<D>& mesh, Matrix& moments) {
  std::vector<RestAtNode> rests;
  const auto note = [&](double rest, int vertex, bool counts) {
    if (counts && rest > 0.0) rests.push_back({rest, vertex});
  };
  NodeStar<D> star(mesh, moments);
  const auto balanceVertex = [&](int v) {
    star.clear();
    for (const int e : mesh.star(v))
      star.add(e, int(std::find(mesh.verticesOf(e).begin(), mesh.verticesOf(e).end(), v) - mesh.verticesOf(e).begin()));
    return star.balance();
  };
  if constexpr (D == 2) {
    PlanarStar planar(mesh, moments);
    for (int v = 0; v < mesh.vertices(); ++v) {
      if (!mesh.isComplete(v)) continue;
      const double rest = planar.balanceVertex(v);
      note(rest < 0.0 ? balanceVertex(v) : rest, v, mesh.counts(v));
    }
    if (mesh.order() == 1) return rests;
    for (int s = 0; s < mesh.sides(); ++s)
      if (mesh.elementsOfSide(s)[0] < mesh.own()) note(planar.balanceMiddle(s), mesh.verticesOfSide(s)[0], mesh.countsSide(s));
  } else {
    for (int v = 0; v < mesh.vertices(); ++v)
      if (mesh.isComplete(v)) note(balanceVertex(v), v, mesh.counts(v));
    if (mesh.order() == 1) return rests;
    mesh.forEachEdge([&](int v, int w, const std::vector<int>& simplices, bool isOwn) {
      star.clear();
      for (const int e : simplices) {
        const auto& all = mesh.verticesOf(e);
        const int a = int(std::find(all.begin(), all.end(), v) - all.begin()), b = int(std::find(all.begin(), all.end(), w) - all.begin());
        star.add(e, D + 1 + SimplexNodes<D>::edge(a, b));
      }
      if (isOwn) note(star.balance(), v, mesh.counts(v));
    });
  }
  return rests;
}

}  // namespace

template <int D>
EquilibratedTractions<D> equilibratedTractions(const StarMesh<D>& mesh) {
  constexpr int linear = SimplexNodes<D>::sideNodes(1), quadratic = SimplexNodes<D>::sideNodes(2);
  const int nodes = SimplexNodes<D>::nodes(mesh.order());
  EquilibratedTractions<D> result;
  double largest = 0.0;
  std::vector<RestAtNode> rests;
  collectively(mesh.comm(), "balancing tractions", [&] {
    for (int e = 0; e < mesh.own(); ++e) largest = std::max(largest, mesh.element(e).forces.leftCols(nodes).cwiseAbs().maxCoeff());
    result.values = mesh.order() == 1 ? averagedMoments<D, linear>(mesh) : averagedMoments<D, quadratic>(mesh);
    rests = balance(mesh, result.values);
  });
  const double mine = largest;
  Teuchos::reduceAll(mesh.comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(largest));
  double worst = 0.0;
  int unbalanced = 0;
  Point place{0, 0, 0};
  for (const RestAtNode& rest : rests) {
    if (rest.size > kUnbalanced * largest) ++unbalanced;
    if (rest.size <= worst) continue;
    worst = rest.size;
    for (int k = 0; k < D; ++k) place[k] = mesh.place(rest.vertex)[k];
  }
  std::vector<double> all = joinEverywhere(mesh.comm(), std::vector<double>{worst, double(unbalanced), place[0], place[1], place[2]});
  for (std::size_t i = 0; i < all.size(); i += 5) {
    result.unbalanced += int(all[i + 1]);
    if (largest > 0.0 && all[i] / largest > result.rest)
      result.rest = all[i] / largest, result.worst = {all[i + 2], all[i + 3], all[i + 4]};
  }
  if (mesh.order() == 1)
    toTractions<D, linear>(mesh, result.values);
  else
    toTractions<D, quadratic>(mesh, result.values);
  if (mesh.order() < mesh.degree()) result.values = ofDegree2(result.values);
  mesh.exchangeSides(result.values);
  return result;
}

template struct EquilibratedTractions<2>;
template struct EquilibratedTractions<3>;
template EquilibratedTractions<2> equilibratedTractions(const StarMesh<2>&);
template EquilibratedTractions<3> equilibratedTractions(const StarMesh<3>&);

}  // namespace suture
