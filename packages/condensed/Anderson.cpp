#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/condensed/Anderson.hpp>

#include <Tpetra_MultiVector.hpp>

namespace suture {

namespace {
MultiVectorPtr copy(const MultiVector& x) { return Teuchos::rcp(new MultiVector(x, Teuchos::Copy)); }

MultiVectorPtr difference(const MultiVector& a, const MultiVector& b) {
  const MultiVectorPtr d = copy(a);
  d->update(-1.0, b, 1.0);
  return d;
}
}  // namespace

void Anderson::restart() {
  while (history_.size() > 1) history_.pop_front();
}

MultiVectorPtr Anderson::accelerate(const MultiVector& u, const MultiVector& correction, const MultiVector& residual) {
  if (depth_ == 0) return Teuchos::null;
  history_.push_back({copy(u), copy(correction), copy(residual)});
  while (static_cast<int>(history_.size()) > depth_ + 1) history_.pop_front();
  const int m = static_cast<int>(history_.size()) - 1;
  if (m == 0) return Teuchos::null;

  std::vector<MultiVectorPtr> du, df, dr;
  for (int i = 0; i < m; ++i) {
    du.push_back(difference(*history_[i + 1].u, *history_[i].u));
    df.push_back(difference(*history_[i + 1].correction, *history_[i].correction));
    dr.push_back(difference(*history_[i + 1].residual, *history_[i].residual));
  }
  Matrix gram(m, m);
  Vector right(m);
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) gram(i, j) = dot(*df[i], *dr[j]);
    right(i) = dot(*df[i], residual);
  }
  gram = (0.5 * (gram + gram.transpose())).eval();  // inner solves are inexact
  // Drop directions that the inner solves do not resolve.
  const Eigenpairs eigen = symmetricEigenpairs(gram);
  const double least = 1e-6 * eigen.values.maxCoeff();
  if (!(least > 0.0)) return Teuchos::null;
  Vector gamma = eigen.vectors.transpose() * right;
  for (int i = 0; i < m; ++i) gamma(i) = eigen.values(i) > least ? gamma(i) / eigen.values(i) : 0.0;
  gamma = (eigen.vectors * gamma).eval();

  const MultiVectorPtr step = copy(correction);
  for (int i = 0; i < m; ++i) {
    step->update(-gamma(i), *du[i], 1.0);
    step->update(-gamma(i), *df[i], 1.0);
  }
  return step;
}

}  // namespace suture
