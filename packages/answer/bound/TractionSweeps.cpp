#include <suture/algebra/Lanes.hpp>
#include <suture/answer/bound/SmallProducts.hpp>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/answer/bound/SupportedSides.hpp>
#include <suture/answer/bound/TractionSweeps.hpp>
#include <suture/base/Collective.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Longest edge over height of tetrahedra whose energies are summed as squares, because products with a Gram matrix lose digits.
constexpr double kFlatTetrahedron = 30.0;

bool isFlatTetrahedron(const Eigen::Matrix3d& map) {
  double longest = 0.0;
  for (int i = 0; i < 3; ++i) longest = std::max({longest, map.col(i).norm(), (map.col(i) - map.col((i + 1) % 3)).norm()});
  return longest * longest * longest > kFlatTetrahedron * std::abs(map.determinant());
}

/// y <- A x. \param packed  rows of the lower triangle
SUTURE_FOR_EACH_PROCESSOR
void multiplyRows(const double* packed, int n, const double* x, double* y) {
  using Many = Register<double>;
  for (int i = 0; i < n; packed += ++i) {
    const double own = x[i];
    Many::Type sum = {};
    double value = packed[i] * own;
    int k = 0;
    for (; k + Many::count <= i; k += Many::count) {
      const Many::Type entries = Many::at(packed + k);
      sum += entries * Many::at(x + k);
      Many::at(y + k) += entries * own;
    }
    for (; k < i; ++k) value += packed[k] * x[k], y[k] += packed[k] * own;
    y[i] = value + ((sum[0] + sum[1]) + (sum[2] + sum[3]));
  }
}

}  // namespace

template <int K>
TractionSweeps<K>::TractionSweeps(const StarMesh<3>& mesh, const Matrix& tractions) : mesh_(mesh) {
  collectively(mesh.comm(), "assembling stresses", [&] {
    faces_.reserve(std::size_t(mesh.sides()));
    for (int s = 0; s < mesh.sides(); ++s) faces_.emplace_back(mesh, s);
    assemble(tractions);
    stars_.emplace(mesh, faces_);
    stars_->factor(grams_);
  });
  change_ = Vector::Zero(mesh.own());
}

template <int K>
void TractionSweeps<K>::assemble(const Matrix& tractions) {
  const StressElement<3>& stress = StressElement<3>::of(K);
  const int data = stress.data();
  grams_.resize(std::size_t(mesh_.elements()) * packed);
  loads_.resize(dofs, mesh_.elements());
  start_ = Vector::Zero(mesh_.own());
  Matrix gram(data, data), resultants(6, data);
  Vector own(data), computed(data), product(data);
  double force = 0.0, rest = 0.0;
  for (int e = 0; e < mesh_.elements(); ++e) {
    const BoundElement<3>& element = mesh_.element(e);
    for (int a = 0; a < 4; ++a) own.segment<count>(count * a) = mesh_.sign(e, a) * tractions.col(mesh_.sidesOfElement(e)[a]);
    for (int j = 0; j < stress.sourceNodes(); ++j) own.segment<3>(dofs + 3 * j) = element.sources.col(j);
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
    double energy = isFlatTetrahedron(map) ? stress.energy(map, element.compliance, own) : own.dot(product);
    energy += addSupports(mesh_, e, given, gram, product);
    if (e < mesh_.own()) start_[e] = energy;
    for (int a = 0; a < 4; ++a)
      loads_.col(e).template segment<count>(count * a) =
          faces_[mesh_.sidesOfElement(e)[a]].basis.transpose() * product.segment<count>(count * a);
    toBases(e, gram);
  }
  imbalance_ = force > 0.0 ? rest / force : 0.0;
}

/// Stores a Gram matrix of nodal tractions in the bases of the faces.
template <int K>
void TractionSweeps<K>::toBases(int e, Matrix& gram) {
  Eigen::Matrix<double, dofs, dofs> once, turned;
  const int stride = int(gram.rows());
  const auto basis = [&](int a) -> const auto& { return faces_[mesh_.sidesOfElement(e)[a]].basis; };
  for (int a = 0; a < 4; ++a)
    multiplySmall(dofs, count, count, gram.data() + count * a * stride, stride, basis(a).data(), count, once.data() + count * a * dofs,
                  dofs);
  turned = once.transpose();
  for (int a = 0; a < 4; ++a)  // the lower triangle
    multiplySmall(dofs - count * a, count, count, turned.data() + (count * dofs + count) * a, dofs, basis(a).data(), count,
                  once.data() + (count * dofs + count) * a, dofs);
  double* next = &grams_[std::size_t(e) * packed];
  for (int i = 0; i < dofs; ++i)
    for (int j = 0; j <= i; ++j) *next++ = once(i, j);
}

template <int K>
typename TractionSweeps<K>::Local TractionSweeps<K>::gather(const Matrix& field, int e) const {
  Local values;
  for (int a = 0; a < 4; ++a)
    values.template segment<count>(count * a) = mesh_.sign(e, a) * field.col(mesh_.sidesOfElement(e)[a]).template head<count>();
  return values;
}

template <int K>
void TractionSweeps<K>::scatter(const Local& values, int e, Matrix& field) const {
  for (int a = 0; a < 4; ++a)
    field.col(mesh_.sidesOfElement(e)[a]).template head<count>() += mesh_.sign(e, a) * values.template segment<count>(count * a);
}

template <int K>
typename TractionSweeps<K>::Local TractionSweeps<K>::product(int e, const Local& x) const {
  Local result;
  multiplyRows(&grams_[std::size_t(e) * packed], dofs, x.data(), result.data());
  return result;
}

template <int K>
double TractionSweeps<K>::dot(const Matrix& a, const Matrix& b) const {
  double mine = 0.0, all = 0.0;
  for (int s = 0; s < mesh_.sides(); ++s)
    if (mesh_.countsSide(s)) mine += a.col(s).dot(b.col(s));
  Teuchos::reduceAll(mesh_.comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

template <int K>
void TractionSweeps<K>::run(int sweeps) {
  Matrix r = Matrix::Zero(count, mesh_.sides()), p = r, x = r, z = r, q = r;
  for (int e = 0; e < mesh_.elements(); ++e) scatter(-loads_.col(e), e, r);
  double before = 0.0;
  SweepGain gain(mesh_.comm(), start_.sum(), sweeps);
  while (gain.worthAnotherSweep()) {
    stars_->apply(r, z);
    const double rz = dot(r, z);
    if (!(rz > 0.0)) break;
    p = z + (gain.sweeps() == 0 ? 0.0 : rz / before) * p;
    before = rz;
    mesh_.exchangeSides(p);
    q.setZero();
    for (int e = 0; e < mesh_.elements(); ++e) scatter(product(e, gather(p, e)), e, q);
    const double step = rz / dot(p, q);
    gain.add(step * rz);
    x += step * p;
    r -= step * q;
  }
  for (int e = 0; e < mesh_.own(); ++e) {
    const Local own = gather(x, e);
    change_[e] = 2 * own.dot(loads_.col(e)) + own.dot(product(e, own));
  }
}

template class TractionSweeps<1>;
template class TractionSweeps<2>;

}  // namespace suture
