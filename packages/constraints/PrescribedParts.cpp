#include <suture/constraints/ContactRows.hpp>
#include <suture/constraints/PrescribedParts.hpp>

#include <algorithm>

namespace suture {

PrescribedParts prescribedParts(const Mesh& mesh, const Constraints& constraints) {
  PrescribedParts parts;
  parts.rules = constraints.prescribed;
  if (parts.empty()) return parts;
  Constraints alone = constraints;  // without gaps and slips: each row's gap is then the contribution of one factor alone
  for (ContactPair& pair : alone.pairs) pair.gap = 0.0, pair.past = {};
  for (const std::vector<RuleValue>& values : parts.rules) {
    for (NodeRule& rule : alone.rules) rule.value = {0, 0, 0};
    for (const RuleValue& value : values)
      std::lower_bound(alone.rules.begin(), alone.rules.end(), value.node, [](const NodeRule& rule, int node) {
        return rule.node < node;
      })->value = value.value;
    std::vector<PrescribedParts::Closing>& closings = parts.gaps.emplace_back();
    for (const ContactRow& row : contactRows(mesh, alone))
      for (std::size_t equation = 0; equation < row.equations.size(); ++equation)
        if (const double gap = row.equations[equation].gap; gap != 0.0) closings.push_back({row.pair.id, static_cast<int>(equation), -gap});
  }
  return parts;
}

}  // namespace suture
