#include <suture/condensed/GroupPairs.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

std::vector<PairForces> pairForces(const ContactGroup& group, const ContactGroup::Response& response, const Vector& moved) {
  const ContactRows& rows = group.rows();
  const Vector lift = moved.size() > 0 ? moved : Vector::Zero(rows.rows.rows());
  const Vector reached = rows.rows * response.displacement + lift - rows.gap;
  const Vector digits = rows.rows.cwiseAbs() * response.displacement.cwiseAbs();
  const Vector entries = rows.rows.cwiseAbs() * Vector::Ones(rows.rows.cols());
  std::vector<PairForces> pairs(static_cast<std::size_t>(rows.size()));
  for (int i = 0; i < rows.size(); ++i) {
    PairForces& pair = pairs[static_cast<std::size_t>(i)];
    pair.normal = response.force(i);
    pair.gap = -reached(i);
    pair.digits = std::max({digits(i), std::abs(lift(i)), std::abs(rows.gap(i))});
    for (int component = 1; component <= 2; ++component)
      if (const int row = rows.rowOf(i, component); row >= 0) {
        pair.slip[component] = reached(row);
        pair.held[component] = response.force(row);
        pair.isPrescribed[static_cast<std::size_t>(component)] = entries(row) == 0.0;
      }
  }
  return pairs;
}

Vector rowStiffness(const ContactGroup& group) {
  const SparseMatrix& rows = group.rows().rows;
  const Vector diagonal = group.stiffness().diagonal();
  Vector compliance = Vector::Zero(rows.rows());
  for (int dof = 0; dof < group.dofs(); ++dof)
    for (SparseMatrix::InnerIterator it(rows, dof); it; ++it) compliance(it.row()) += it.value() * it.value() / diagonal(dof);
  return compliance.unaryExpr([](double value) { return value > 0.0 ? 1.0 / value : 0.0; });
}

}  // namespace suture
