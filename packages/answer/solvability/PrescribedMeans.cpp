#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/solvability/PrescribedMeans.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace suture {

namespace {

constexpr double kHeld = 1e-10;       // free part of a mean's weights, relative to all, that is round-off
constexpr double kDependent = 1e-10;  // eigenvalue of the products of normalised rows that counts as zero
constexpr double kConcerned = 1e-6;   // coefficient of a mean in a dependence, relative to the largest
constexpr double kSameValues = 1e-9;  // relative difference of values that agree

/// The row of a mean in the components that no condition prescribes, by node x dimension + axis, and the mean of the prescribed ones.
struct FreeRow {
  std::map<int, double> entries;
  double size = 0.0;        ///< norm of the whole row
  double prescribed = 0.0;  ///< contribution of prescribed components [length]
  std::set<std::string> conditions{};
};

FreeRow freeRowOf(const Mesh& mesh, const Constraints& constraints, const std::vector<int>& ruleOf, const PrescribedMean& mean) {
  const RigidGroupNodes rigid(constraints.rigidGroups, mesh.dimension);
  FreeRow row;
  const NodeRule none;
  for (const auto& [node, weight] : mean.nodes) {
    const int number = ruleOf[std::size_t(node)];
    const NodeRule& rule = number < 0 ? none : constraints.rules[std::size_t(number)];
    row.size += weight * weight;
    for (int k = 0; k < mesh.dimension; ++k) {
      const double along = weight * rule.axes[std::size_t(k)][std::size_t(mean.component)];
      if (along == 0.0) continue;
      if (rule.fixed[std::size_t(k)])
        row.prescribed += along * rule.value[std::size_t(k)];
      else if (!rigid.contains(node))
        row.entries[node * mesh.dimension + k] = along;
      rigid.forEachMaster(node, k, [&](int master, int component, double coefficient) {
        row.entries[master * mesh.dimension + component] += along * coefficient;
      });
    }
  }
  row.size = std::sqrt(row.size);
  for (const Support& support : constraints.supports)
    if (support.direction[std::size_t(mean.component)] != 0.0 &&
        std::binary_search(mean.nodes.begin(), mean.nodes.end(), std::make_pair(support.node, 0.0),
                           [](const auto& a, const auto& b) { return a.first < b.first; }))
      row.conditions.insert(constraints.conditions[std::size_t(support.condition)]);
  return row;
}

double product(const FreeRow& a, const FreeRow& b) {
  double sum = 0.0;
  for (const auto& [dof, value] : a.entries)
    if (const auto other = b.entries.find(dof); other != b.entries.end()) sum += value * other->second;
  return sum / (a.size * b.size);
}

std::string wordsOf(const PrescribedMean& mean) { return std::string("the mean displacement along ") + "xyz"[mean.component]; }

std::string text(double value) {
  std::ostringstream all;
  all << value;
  return all.str();
}

bool agree(double a, double b, double size) { return std::abs(a - b) <= kSameValues * std::max({std::abs(a), std::abs(b), size}); }

/// Reports one linear dependence between means. \param coefficients  of the normalised free rows
void reportDependence(const std::vector<const PrescribedMean*>& means, const std::vector<const FreeRow*>& rows, const Vector& coefficients,
                      const ElasticModel& model, Problems& problems) {
  const double most = coefficients.cwiseAbs().maxCoeff();
  double sum = 0.0, size = 0.0;
  std::string others;
  int first = -1;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double factor = coefficients[Eigen::Index(i)] / rows[i]->size;
    if (std::abs(coefficients[Eigen::Index(i)]) <= kConcerned * most) continue;
    sum += factor * (means[i]->target - rows[i]->prescribed);
    size = std::max(size, std::abs(factor * means[i]->target));
    if (first < 0)
      first = int(i);
    else
      others += (others.empty() ? "" : ", ") + model.loads[std::size_t(means[i]->load)].path;
  }
  problems.add(model.loads[std::size_t(means[std::size_t(first)]->load)].path,
               wordsOf(*means[std::size_t(first)]) + " follows from that of " + others +
                   (std::abs(sum) <= kSameValues * size ? ": the values agree, but the forces would be undetermined. Remove one of them"
                                                        : ", and the values contradict each other. Remove one of them"));
}

}  // namespace

std::vector<PrescribedMean> prescribedMeans(const Mesh& mesh, const ElasticModel& model) {
  std::vector<PrescribedMean> all;
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    if (model.loads[l].control != Load::Control::MeanDisplacement) continue;
    ElasticModel alone = model;
    alone.loads = {model.loads[l]};
    alone.loads[0].factor = 1.0;
    alone.loads[0].setAmount(1.0);
    const Vector forces = nodalLoads(mesh, alone);
    PrescribedMean mean{int(l), 0, {}, model.loads[l].target};
    while (mean.component + 1 < mesh.dimension && model.loads[l].axis[std::size_t(mean.component)] == 0.0) ++mean.component;
    for (int node = 0; node < mesh.nodes(); ++node)
      if (const double weight = forces[Eigen::Index(node) * mesh.dimension + mean.component]; weight != 0.0)
        mean.nodes.emplace_back(node, weight);
    all.push_back(std::move(mean));
  }
  return all;
}

void checkMeans(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, const std::vector<PrescribedMean>& means,
                Problems& problems) {
  if (means.empty()) return;
  std::vector<int> ruleOf(std::size_t(mesh.nodes()), -1);
  for (std::size_t r = 0; r < constraints.rules.size(); ++r) ruleOf[std::size_t(constraints.rules[r].node)] = int(r);
  std::vector<FreeRow> rows;
  for (const PrescribedMean& mean : means) rows.push_back(freeRowOf(mesh, constraints, ruleOf, mean));
  std::vector<const PrescribedMean*> free;
  std::vector<const FreeRow*> rowsOfFree;
  for (std::size_t i = 0; i < means.size(); ++i) {
    double square = 0.0;
    for (const auto& [dof, value] : rows[i].entries) square += value * value;
    if (std::sqrt(square) > kHeld * rows[i].size) {
      free.push_back(&means[i]);
      rowsOfFree.push_back(&rows[i]);
      continue;
    }
    const bool same = agree(rows[i].prescribed, means[i].target, 0.0);
    problems.add(model.loads[std::size_t(means[i].load)].path,
                 wordsOf(means[i]) + " is already prescribed, by " +
                     joinNames(std::vector<std::string>(rows[i].conditions.begin(), rows[i].conditions.end())) + ": it is " +
                     text(rows[i].prescribed) +
                     (same ? ", and the force of this condition would be undetermined" : ", which contradicts " + text(means[i].target)) +
                     ". Remove one of the two, or prescribe other components");
  }
  const auto count = Eigen::Index(free.size());
  Matrix gram(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) gram(i, j) = product(*rowsOfFree[std::size_t(i)], *rowsOfFree[std::size_t(j)]);
  if (count < 2) return;
  const Eigenpairs pairs = symmetricEigenpairs(gram);
  for (Eigen::Index i = 0; i < count; ++i)
    if (pairs.values[i] <= kDependent * pairs.values[count - 1]) reportDependence(free, rowsOfFree, pairs.vectors.col(i), model, problems);
}

}  // namespace suture
