#include <suture/contact/PairRow.hpp>

#include <cmath>

namespace suture {

void PairRow::add(const Subdomain& subdomain, const SubdomainMesh::ContactEnd& end, const std::vector<int>& positions) {
  bool& has = end.side > 0 ? hasA_ : hasB_;
  if (has) return;
  has = true;
  NodeRule rule;  // Cartesian and free, unless the node has one
  for (const NodeRule& own : subdomain.mesh().rules)
    if (own.node == end.node) rule = own;
  for (int k = 0; k < subdomain.components(); ++k) {
    double along = 0.0;
    for (int c = 0; c < subdomain.components(); ++c) along += rule.axes[k][c] * pair_.normal[c];
    along *= end.side;
    if (rule.fixed[k])
      gap_ -= along * rule.value[k];
    else if (std::abs(along) > 1e-12)  // the row of a unit normal: this is rounding of the axes
      coefficients_[positions[subdomain.dof(end.node, k)]] += along;
  }
}

}  // namespace suture
