#include <suture/algebra/DisjointSets.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/ContactRows.hpp>
#include <suture/mesh/Mesh.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace suture {

namespace {

struct Term {
  GlobalId dof;
  double coefficient;
  int node;
};

// Adds the terms of one end. A node without a rule is Cartesian and free.
void addEnd(const PairEnd& end, const NodeRule& rule, const RigidGroupNodes& rigid, const Point& direction, int dimension, double& gap,
            std::vector<Term>& entries) {
  for (int k = 0; k < dimension; ++k) {
    double along = 0.0;
    for (int c = 0; c < dimension; ++c) along += rule.axes[k][c] * direction[c];
    if (rule.fixed[k]) gap -= end.weight * along * rule.value[k];
    if (std::abs(along) <= 1e-12) continue;  // smaller components of a unit vector are round-off
    if (!rule.fixed[k] && !rigid.contains(end.node))
      entries.push_back({static_cast<GlobalId>(end.node) * dimension + k, end.weight * along, end.node});
    rigid.forEachMaster(end.node, k, [&](int node, int component, double coefficient) {
      entries.push_back({static_cast<GlobalId>(node) * dimension + component, end.weight * along * coefficient, node});
    });
  }
}

// Several nodes of a rigid group follow the same masters.
void join(std::vector<Term>& sorted) {
  std::vector<Term> joined;
  for (const Term& term : sorted)
    if (!joined.empty() && joined.back().dof == term.dof)
      joined.back().coefficient += term.coefficient;
    else
      joined.push_back(term);
  sorted = std::move(joined);
}

// Rows with a common unknown are in one cluster, identified by its lowest pair.
void findClusters(std::vector<ContactRow>& rows) {
  DisjointSets clusters(static_cast<int>(rows.size()));
  std::unordered_map<GlobalId, int> firstWith;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (const ContactRow::Equation& equation : rows[row].equations)
      for (GlobalId dof : equation.dofs) clusters.join(static_cast<int>(row), firstWith.emplace(dof, static_cast<int>(row)).first->second);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row].cluster = rows[clusters.lowest(static_cast<int>(row))].pair.id;
}

}  // namespace

std::vector<ContactRow> contactRows(const Mesh& mesh, const Constraints& constraints) {
  std::vector<int> ruleOf(mesh.nodes(), -1);
  for (std::size_t r = 0; r < constraints.rules.size(); ++r) ruleOf[constraints.rules[r].node] = static_cast<int>(r);
  const NodeRule free;
  const RigidGroupNodes rigid(constraints.rigidGroups, mesh.dimension);
  std::vector<ContactRow> rows;
  rows.reserve(constraints.pairs.size());
  for (const ContactPair& pair : constraints.pairs) {
    rows.emplace_back();
    ContactRow& row = rows.back();
    row.pair = pair;
    const std::vector<Point> frame = rowDirections(pair, mesh.dimension);
    const ContactLaw& law = constraints.laws.of(pair.line);
    row.equations.resize(law.rows(mesh.dimension));
    row.separates = law.separates();
    for (std::size_t component = 0; component < row.equations.size(); ++component) {
      ContactRow::Equation& equation = row.equations[component];
      equation.gap = component == 0 ? pair.gap : dot(pair.past.slip, frame[component]);
      std::vector<Term> entries;
      for (const PairEnd& end : pair.ends)
        addEnd(end, ruleOf[end.node] < 0 ? free : constraints.rules[ruleOf[end.node]], rigid, frame[component], mesh.dimension,
               equation.gap, entries);
      std::sort(entries.begin(), entries.end(), [](const Term& a, const Term& b) { return a.dof < b.dof; });
      if (!rigid.empty()) join(entries);
      for (const Term& entry : entries) {
        equation.dofs.push_back(entry.dof);
        equation.coefficients.push_back(entry.coefficient);
        equation.points.push_back(mesh.point(entry.node));
      }
    }
  }
  findClusters(rows);
  return rows;
}

}  // namespace suture
