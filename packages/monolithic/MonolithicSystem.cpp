#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementForces.hpp>
#include <suture/elasticity/loads/ElasticSupports.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>
#include <suture/pairs/ContactRow.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace suture {

namespace {

constexpr double negligible = 1e-14;  // round-off in a component of a unit normal

Vector inAxes(const NodeRule* rule, const Point& direction, int dimension) {
  const Eigen::Map<const Vector> n(direction.data(), dimension);
  if (rule == nullptr) return n;
  return axesOf(*rule, dimension) * n;
}

}  // namespace

MonolithicSystem::MonolithicSystem(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model)
    : mesh_(mesh),
      constraints_(constraints),
      model_(model),
      forces_(nodalLoads(mesh, model)),
      rigid_(constraints.rigidGroups, mesh.dimension) {
  requireGeometry(mesh, model);
  number();
  assemble();
}

void MonolithicSystem::number() {
  const int dimension = mesh_.dimension, components = mesh_.nodes() * dimension;
  ruleOf_.assign(mesh_.nodes(), -1);
  std::vector<char> fixed(components, 0), inContact(components, 0);
  prescribed_ = Vector::Zero(components);
  for (std::size_t r = 0; r < constraints_.rules.size(); ++r) {
    const NodeRule& rule = constraints_.rules[r];
    ruleOf_[rule.node] = int(r);
    for (int k = 0; k < dimension; ++k) {
      if (!rule.fixed[k]) continue;
      fixed[component(rule.node, k)] = 1;
      prescribed_[component(rule.node, k)] = rule.value[k];
    }
  }
  const auto ruleAt = [&](int node) { return ruleOf_[node] < 0 ? nullptr : &constraints_.rules[ruleOf_[node]]; };

  // First contact rows in node components; unknowns are numbered when all rows are known.
  struct Entry {
    int row, component;
    double coefficient;
  };
  std::vector<Entry> entries;
  rows_.reserve(constraints_.pairs.size());
  const auto addRow = [&](const ContactPair& pair, int place, int along, const Point& towards) {
    const int row = int(rows_.size());
    const auto first = std::ptrdiff_t(entries.size());
    rows_.push_back({{}, {}, along == 0 ? pair.gap : dot(pair.past.slip, towards), place, along});
    for (const PairEnd& end : pair.ends) {
      const int node = end.node;
      const double weight = end.weight;
      const Vector direction = inAxes(ruleAt(node), towards, dimension);
      for (int k = 0; k < dimension; ++k) {
        const int c = component(node, k);
        if (fixed[c]) rows_[row].bound -= weight * direction[k] * prescribed_[c];
        if (std::abs(direction[k]) <= negligible) continue;
        const auto add = [&](int unknown, double coefficient) {
          const auto same =
              std::find_if(entries.begin() + first, entries.end(), [&](const Entry& one) { return one.component == unknown; });
          inContact[unknown] = 1;
          if (same != entries.end())
            same->coefficient += coefficient;
          else
            entries.push_back({row, unknown, coefficient});
        };
        if (!fixed[c])
          add(c, weight * direction[k]);
        else
          rigid_.forEachMaster(
              node, k, [&](int master, int of, double coefficient) { add(component(master, of), weight * direction[k] * coefficient); });
      }
    }
  };
  for (std::size_t p = 0; p < constraints_.pairs.size(); ++p) {
    const ContactPair& pair = constraints_.pairs[p];
    addRow(pair, int(p), 0, pair.normal);
    const int restricted = constraints_.laws.of(pair.line).rows(dimension);
    if (restricted == 1) continue;
    const std::vector<Point> frame = rowDirections(pair, dimension);
    for (int k = 1; k < restricted; ++k) addRow(pair, int(p), k, frame[k]);
  }

  index_.assign(components, -1);
  std::vector<int> last;
  dofs_ = 0;
  for (int c = 0; c < components; ++c) {
    if (fixed[c]) continue;
    if (inContact[c]) {
      last.push_back(c);
    } else {
      index_[c] = dofs_++;
    }
  }
  // The Schur complement couples only dofs of the same body: grouped by body, it has dense blocks with separate factors.
  std::stable_sort(last.begin(), last.end(),
                   [&](int a, int b) { return mesh_.bodyOfNode[a / dimension] < mesh_.bodyOfNode[b / dimension]; });
  const int leading = dofs_;
  for (const int c : last) {
    const int node = c / dimension, k = c % dimension;
    Point direction{0, 0, 0};
    direction[k] = 1;
    if (const NodeRule* rule = ruleAt(node)) direction = rule->axes[k];
    contactDof_.push_back({node, direction});
    index_[c] = dofs_++;
  }
  contactDofs_ = int(last.size());
  for (const Entry& entry : entries) {
    rows_[entry.row].dofs.push_back(index_[entry.component] - leading);
    rows_[entry.row].coefficients.push_back(entry.coefficient);
  }
}

// Columns of the lower triangle from the neighbours of nodes, because a list of triplets would be several times larger than the matrix.
SparseMatrix MonolithicSystem::pattern() const {
  const int dimension = mesh_.dimension, nodes = mesh_.nodes();
  const CoatedBlock coated(mesh_);
  const CellBlock& block = coated.block();
  std::vector<int> offset(nodes + 1, 0), elementsAt;
  for (const int node : block.connectivity) ++offset[node + 1];
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  elementsAt.resize(block.connectivity.size());
  std::vector<int> next(offset.begin(), offset.end() - 1);
  for (int e = 0; e < block.elements(); ++e)
    for (const int node : block.nodesOf(e)) elementsAt[next[node]++] = e;

  std::vector<int> nodeOf(dofs_);
  for (std::size_t c = 0; c < index_.size(); ++c)
    if (index_[c] >= 0) nodeOf[index_[c]] = int(c) / dimension;
  std::vector<int> seen(nodes, -1), rows;
  const auto columnRows = [&](int column) {
    rows.clear();
    for (int at = offset[nodeOf[column]]; at < offset[nodeOf[column] + 1]; ++at)
      for (const int other : block.nodesOf(elementsAt[at])) {
        if (seen[other] == column) continue;
        seen[other] = column;
        for (int k = 0; k < dimension; ++k)
          if (index_[component(other, k)] >= column) rows.push_back(index_[component(other, k)]);
      }
  };
  SparseMatrix matrix(dofs_, dofs_);
  int* outer = matrix.outerIndexPtr();
  outer[0] = 0;
  for (int column = 0; column < dofs_; ++column) {
    columnRows(column);
    outer[column + 1] = outer[column] + int(rows.size());
  }
  matrix.resizeNonZeros(outer[dofs_]);
  std::fill(seen.begin(), seen.end(), -1);
  for (int column = 0; column < dofs_; ++column) {
    columnRows(column);
    std::sort(rows.begin(), rows.end());
    std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr() + outer[column]);
  }
  std::fill_n(matrix.valuePtr(), outer[dofs_], 0.0);
  return matrix;
}

void MonolithicSystem::assemble() {
  const int dimension = mesh_.dimension;
  load_ = onFree(forces_);
  energy_ = -forces_.dot(expand(Vector::Zero(dofs_)));
  if (!constraints_.rigidGroups.empty()) {
    assembleWithRigidGroups();
    return;
  }

  SparseMatrix matrix = pattern();
  const int *outer = matrix.outerIndexPtr(), *inner = matrix.innerIndexPtr();
  double* values = matrix.valuePtr();
  Matrix k;
  const CoatedBlock coated(mesh_);
  const auto take = [&](int element, ConstLocalView stiffness) {
    const Span<const int> nodes = coated.block().nodesOf(element);
    const int size = int(nodes.size()) * dimension;
    k = stiffness;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (ruleOf_[nodes[i]] < 0) continue;
      const Matrix axes = axesOf(constraints_.rules[ruleOf_[nodes[i]]], dimension);
      const Eigen::Index at = Eigen::Index(i) * dimension;
      k.middleRows(at, dimension) = (axes * k.middleRows(at, dimension)).eval();
      k.middleCols(at, dimension) = (k.middleCols(at, dimension) * axes.transpose()).eval();
    }
    for (int s = 0; s < size; ++s) {
      const int columnComponent = component(nodes[s / dimension], s % dimension), column = index_[columnComponent];
      const double value = prescribed_[columnComponent];
      for (int r = 0; r < size; ++r) {
        const int rowComponent = component(nodes[r / dimension], r % dimension), row = index_[rowComponent];
        if (column < 0) {
          if (row >= 0) {
            load_[row] -= k(r, s) * value;
          } else {
            energy_ += 0.5 * prescribed_[rowComponent] * k(r, s) * value;
          }
        } else if (row >= column) {
          values[std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - inner] += k(r, s);
        }
      }
    }
  };
  supportedStiffnesses(
      mesh_, mesh_.sideGroups,
      [&](int element) -> const Material& { return model_.materialOf(mesh_, element, mesh_.bodyOfElement[element]); }, model_, take);
  stiffness_ = SymmetricMatrix(std::move(matrix));
}

void MonolithicSystem::assembleWithRigidGroups() {
  const int dimension = mesh_.dimension;
  std::vector<Eigen::Triplet<double>> entries;
  Matrix k;
  const CoatedBlock coated(mesh_);
  const auto take = [&](int element, ConstLocalView stiffness) {
    const Span<const int> nodes = coated.block().nodesOf(element);
    const auto size = static_cast<int>(nodes.size()) * dimension;
    std::vector<std::vector<std::pair<int, double>>> unknowns(static_cast<std::size_t>(size));
    Vector given(size);
    k = stiffness;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Eigen::Index at = Eigen::Index(i) * dimension;
      for (int c = 0; c < dimension; ++c) {
        given[at + c] = prescribed_[component(nodes[i], c)];
        forEachUnknown(nodes[i], c, [&](int unknown, double coefficient) {
          unknowns[static_cast<std::size_t>(at + c)].emplace_back(unknown, coefficient);
        });
      }
      if (ruleOf_[nodes[i]] < 0) continue;
      const Matrix axes = axesOf(constraints_.rules[ruleOf_[nodes[i]]], dimension);
      k.middleRows(at, dimension) = (axes * k.middleRows(at, dimension)).eval();
      k.middleCols(at, dimension) = (k.middleCols(at, dimension) * axes.transpose()).eval();
    }
    const Vector held = k * given;
    energy_ += 0.5 * given.dot(held);
    for (int r = 0; r < size; ++r)
      for (const auto& [row, left] : unknowns[static_cast<std::size_t>(r)]) {
        load_[row] -= left * held[r];
        for (int s = 0; s < size; ++s)
          for (const auto& [column, right] : unknowns[static_cast<std::size_t>(s)])
            if (row >= column) entries.emplace_back(row, column, left * k(r, s) * right);
      }
  };
  supportedStiffnesses(
      mesh_, mesh_.sideGroups,
      [&](int element) -> const Material& { return model_.materialOf(mesh_, element, mesh_.bodyOfElement[element]); }, model_, take);
  SparseMatrix matrix(dofs_, dofs_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  stiffness_ = SymmetricMatrix(std::move(matrix));
}

Vector MonolithicSystem::onFree(const Vector& nodal) const {
  const int dimension = mesh_.dimension;
  Vector own = Vector::Zero(dofs_);
  for (int node = 0; node < mesh_.nodes(); ++node) {
    Vector force = nodal.segment(component(node, 0), dimension);
    if (ruleOf_[node] >= 0) force = axesOf(constraints_.rules[ruleOf_[node]], dimension) * force;
    for (int k = 0; k < dimension; ++k)
      forEachUnknown(node, k, [&](int unknown, double coefficient) { own[unknown] += coefficient * force[k]; });
  }
  return own;
}

Vector MonolithicSystem::expand(const Vector& x) const {
  const int dimension = mesh_.dimension;
  Vector u = prescribed_;
  for (std::size_t c = 0; c < index_.size(); ++c)
    if (index_[c] >= 0) u[c] = x[index_[c]];
  for (const RigidGroup& group : constraints_.rigidGroups)
    for (const int node : group.nodes)
      for (int k = 0; k < dimension; ++k)
        if (!isFree(component(node, k)))
          forEachUnknown(node, k, [&](int unknown, double coefficient) { u[component(node, k)] += coefficient * x[unknown]; });
  for (const NodeRule& rule : constraints_.rules) {
    auto local = u.segment(component(rule.node, 0), dimension);
    local = (axesOf(rule, dimension).transpose() * local).eval();
  }
  return u;
}

Vector MonolithicSystem::internalForces(const Vector& displacement) const {
  const auto materialOf = [&](int element) -> const Material& { return model_.materialOf(mesh_, element, mesh_.bodyOfElement[element]); };
  Vector forces = elementForces(mesh_, materialOf, model_.plane, displacement).internal;
  const ElasticSupports supports(mesh_, mesh_.sideGroups, model_);
  if (!supports.empty()) forces += supports.forces(displacement).nodal;
  return forces;
}

void MonolithicSystem::addParts(const Vector& displacement, Balance& balance) const {
  const ElasticSupports supports(mesh_, mesh_.sideGroups, model_);
  if (!supports.empty()) balance.addSupports(-supports.forces(displacement).nodal, mesh_.dimension);
  const Vector initial = initialForces(mesh_, model_);
  Point sum{0, 0, 0};
  for (Eigen::Index i = 0; i < initial.size(); ++i) sum[i % mesh_.dimension] += initial[i];
  balance.leaveOut(sum);
}

}  // namespace suture
