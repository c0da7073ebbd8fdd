#include <precond/DensePair.hpp>

namespace suture::blocks {

DensePair::DensePair(const InterfaceOperator& matrix, const Preconditioner& preconditioner) {
  const DenseSpace all(*matrix.space());
  s = all.dense(static_cast<const Operator&>(matrix));
  m = all.dense(static_cast<const Operator&>(preconditioner));
  std::vector<int> used;
  for (int i = 0; i < s.rows(); ++i)
    if (s(i, i) > 0.0) used.push_back(i);
  idle = m.norm() - rowsAt(rowsAt(m, used).transpose(), used).norm();
  s = rowsAt(rowsAt(s, used).transpose(), used);
  m = rowsAt(rowsAt(m, used).transpose(), used);
}

Vector DensePair::eigenvalues() const { return eigenvaluesOfProduct(m, s); }

}  // namespace suture::blocks
