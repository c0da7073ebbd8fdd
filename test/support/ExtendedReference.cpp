#include <support/ExtendedReference.hpp>

#include <Eigen/SparseLU>

namespace suture::scenes {

ExtendedReference::ExtendedReference(const Scene& scene, std::vector<char> start, const Motion& motion) {
  if (Teuchos::DefaultComm<int>::getComm()->getRank() != 0) return;
  const int unknowns = 2 * scene.mesh.nodes(), pairs = int(scene.constraints.pairs.size());
  std::vector<Entry> stiffness;
  Column diagonal = Column::Zero(unknowns);
  elementStiffnesses(
      scene.mesh, [&](int e) -> const Material& { return scene.model.materialOf(scene.mesh, e, scene.mesh.bodyOfElement[e]); },
      scene.model.plane,
      [&](int element, ConstLocalView k) {
        const Span<const int> nodes = scene.mesh.nodesOf(element);
        for (Eigen::Index j = 0; j < k.cols(); ++j)
          for (Eigen::Index i = 0; i < k.rows(); ++i) {
            const int row = 2 * nodes[i / 2] + int(i % 2), column = 2 * nodes[j / 2] + int(j % 2);
            const Real value = k(std::max(i, j), std::min(i, j));
            stiffness.emplace_back(row, column, value);
            if (row == column) diagonal[row] += value;
          }
      });
  const Column load = nodalLoads(scene.mesh, scene.model).cast<Real>();
  std::vector<std::vector<Entry>> rows(pairs);
  Column initial(pairs);
  for (const ContactPair& pair : scene.constraints.pairs) {
    initial[pair.id] = pair.gap;
    for (const PairEnd& end : pair.ends)
      for (int k = 0; k < 2; ++k) {
        rows[pair.id].emplace_back(0, 2 * end.node + k, Real(end.weight) * pair.normal[k]);
        if (motion)
          initial[pair.id] -= Real(end.weight) * pair.normal[k] * motion(scene.mesh.bodyOfNode[end.node], scene.mesh.point(end.node))[k];
      }
  }
  std::vector<std::pair<std::vector<Entry>, Real>> held;  // prescribed components
  for (const NodeRule& rule : scene.constraints.rules)
    for (int k = 0; k < 2; ++k)
      if (rule.fixed[k]) {
        std::vector<Entry> row;
        Real value = rule.value[k];
        for (int c = 0; c < 2; ++c) {
          row.emplace_back(0, 2 * rule.node + c, rule.axes[k][c]);
          if (motion) value -= rule.axes[k][c] * motion(scene.mesh.bodyOfNode[rule.node], scene.mesh.point(rule.node))[c];
        }
        held.emplace_back(row, value);
      }
  const Real unit = diagonal.maxCoeff();
  closed = start.empty() ? std::vector<char>(pairs, 1) : start;
  for (int step = 0; step < 100; ++step) {
    std::vector<int> active;
    for (int i = 0; i < pairs; ++i)
      if (closed[i]) active.push_back(i);
    const int size = unknowns + int(held.size() + active.size());
    std::vector<Entry> entries = stiffness;
    Column right = Column::Zero(size);
    right.head(unknowns) = load;
    int at = unknowns;
    const auto add = [&](const std::vector<Entry>& row, Real value) {
      for (const Entry& entry : row) {
        entries.emplace_back(at, entry.col(), unit * entry.value());
        entries.emplace_back(entry.col(), at, unit * entry.value());
      }
      right[at++] = unit * value;
    };
    for (const auto& [row, value] : held) add(row, value);
    for (const int i : active) add(rows[i], initial[i]);
    Sparse system(size, size);
    system.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SparseLU<Sparse> factor(system);
    if (factor.info() != Eigen::Success) throw std::runtime_error("the reference is singular");
    Column found = factor.solve(right);
    for (int k = 0; k < 3; ++k) found += factor.solve(right - system * found).eval();
    displacement = found.head(unknowns);
    force = Column::Zero(pairs);
    gap = initial;
    for (int i = 0; i < pairs; ++i)
      for (const Entry& entry : rows[i]) gap[i] -= entry.value() * displacement[entry.col()];
    for (std::size_t k = 0; k < active.size(); ++k) {
      force[active[k]] = unit * found[unknowns + int(held.size() + k)];
      gap[active[k]] = 0;
    }
    if (!found.allFinite()) throw std::runtime_error("the reference is singular");
    bool changed = false;
    const Real size1 = force.cwiseAbs().maxCoeff(), size2 = gap.cwiseAbs().maxCoeff();
    for (int i = 0; i < pairs; ++i) {
      const bool flips = closed[i] ? force[i] < -Real(1e-16) * size1 : gap[i] < -Real(1e-16) * size2;
      if (flips) closed[i] = !closed[i], changed = true;
    }
    if (!changed) return;
  }
  throw std::runtime_error("the reference finds no set of closed pairs");
}

}  // namespace suture::scenes
