#include <Eigen/SparseCholesky>
#include <suture/answer/bound/RestForces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace suture {

namespace {

// Rest of the forces of a patch, relative to the largest, above which it counts as a mechanism.
constexpr double kCarried = 1e-9;

using NodeSet = std::set<GlobalId>;

/// Element of a patch, as sent to rank 0 and back.
struct PatchElement {
  int rest = -1, rank = -1, mesh = -1, element = -1;
  std::vector<GlobalId> nodes;
  std::vector<Point> places;
  std::vector<double> values;  ///< stiffness matrix; on the way back forces

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.rest), each(self.rank), each(self.mesh), each(self.element), each(self.nodes), each(self.places), each(self.values);
  }
};

/// Elements of a mesh with a node of a set.
std::vector<int> elementsAt(const SubdomainMesh& mesh, const NodeSet& nodes) {
  std::vector<char> marked(mesh.nodes(), 0);
  bool any = false;
  for (const GlobalId node : nodes) {
    const auto found = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), node);
    if (found == mesh.globalNodes.end() || *found != node) continue;
    marked[found - mesh.globalNodes.begin()] = 1;
    any = true;
  }
  std::vector<int> elements;
  if (!any) return elements;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> all = mesh.nodesOf(e);
    if (std::any_of(all.begin(), all.end(), [&](int node) { return marked[node] != 0; })) elements.push_back(e);
  }
  return elements;
}

/// All nodes of the elements at each set of nodes, over all ranks; the same on all ranks.
std::vector<NodeSet> nodesAround(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<NodeSet>& sets) {
  std::vector<std::vector<GlobalId>> mine(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (const SubdomainMesh& mesh : meshes)
      for (const int e : elementsAt(mesh, sets[i]))
        for (const int node : mesh.nodesOf(e)) mine[i].push_back(mesh.globalNodes[node]);
  Packer packer;
  for (const auto& nodes : mine) packer.put(nodes);
  std::vector<NodeSet> all(sets.size());
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    Unpacker unpacker(bytes);
    for (NodeSet& nodes : all)
      for (const GlobalId node : unpacker.get<std::vector<GlobalId>>()) nodes.insert(node);
  }
  return all;
}

/// Some elements of a mesh as a separate block.
CellBlock blockOf(const SubdomainMesh& mesh, const std::vector<int>& elements) {
  CellBlock block;
  block.dimension = mesh.dimension;
  block.axisymmetric = mesh.axisymmetric;
  block.coordinates = mesh.coordinates;
  for (const int e : elements) {
    block.cells.push_back(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    block.connectivity.insert(block.connectivity.end(), nodes.begin(), nodes.end());
    block.offsets.push_back(static_cast<int>(block.connectivity.size()));
  }
  return block;
}

std::vector<PatchElement> elementsHere(const Comm& comm, const BoundedSolution& solution, const std::vector<NodeSet>& around) {
  std::vector<PatchElement> all;
  for (std::size_t i = 0; i < around.size(); ++i)
    for (std::size_t m = 0; m < solution.meshes.size(); ++m) {
      const SubdomainMesh& mesh = solution.meshes[m];
      const std::vector<int> elements = elementsAt(mesh, around[i]);
      if (elements.empty()) continue;
      const auto materialOf = [&](int e) -> const Material& { return solution.model.materialOf(mesh, elements[e], mesh.body); };
      elementStiffnesses(blockOf(mesh, elements), materialOf, solution.model.plane, [&](int e, ConstLocalView stiffness) {
        PatchElement own{int(i), comm.getRank(), int(m), elements[e], {}, {}, {}};
        for (const int node : mesh.nodesOf(elements[e])) {
          own.nodes.push_back(mesh.globalNodes[node]);
          own.places.push_back(mesh.point(node));
        }
        const Matrix copy = stiffness;
        own.values.assign(copy.data(), copy.data() + copy.size());
        all.push_back(std::move(own));
      });
    }
  return all;
}

/// A free patch of elements under forces without resultant.
class Patch {
 public:
  Patch(int dimension, std::vector<PatchElement*> elements) : dimension_(dimension), elements_(std::move(elements)) {
    for (const PatchElement* element : elements_)
      for (std::size_t i = 0; i < element->nodes.size(); ++i)
        if (numberOf_.try_emplace(element->nodes[i], int(places_.size())).second) places_.push_back(element->places[i]);
  }

  /// Replaces the matrices of the elements by their forces. Returns false if the patch is a mechanism.
  bool carry(const UnbalancedForces& rest) {
    const int d = dimension_, n = d * int(places_.size());
    Vector load = Vector::Zero(n);
    for (std::size_t i = 0; i < rest.nodes.size(); ++i) {
      const auto found = numberOf_.find(rest.nodes[i]);
      if (found == numberOf_.end()) return false;
      for (int k = 0; k < d; ++k) load[d * found->second + k] += rest.forces[i][k];
    }
    std::vector<char> held(n, 0);
    hold(held);
    std::vector<Eigen::Triplet<double>> entries;
    for (const PatchElement* element : elements_) {
      const std::vector<int> dofs = dofsOf(*element);
      const Eigen::Map<const Matrix> own(element->values.data(), int(dofs.size()), int(dofs.size()));
      for (std::size_t i = 0; i < dofs.size(); ++i)
        for (std::size_t j = 0; j < dofs.size(); ++j)
          if (!held[dofs[i]] && !held[dofs[j]]) entries.emplace_back(dofs[i], dofs[j], own(int(i), int(j)));
    }
    for (int i = 0; i < n; ++i)
      if (held[i]) entries.emplace_back(i, i, 1.0);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return false;
    Vector free = load;
    for (int i = 0; i < n; ++i)
      if (held[i]) free[i] = 0.0;
    Vector u = factor.solve(free);
    u += factor.solve(free - matrix * u);
    Vector rests = load;
    for (PatchElement* element : elements_) {
      const std::vector<int> dofs = dofsOf(*element);
      Vector local(int(dofs.size()));
      for (std::size_t i = 0; i < dofs.size(); ++i) local[int(i)] = u[dofs[i]];
      const Vector forces = Eigen::Map<const Matrix>(element->values.data(), local.size(), local.size()) * local;
      for (std::size_t i = 0; i < dofs.size(); ++i) rests[dofs[i]] -= forces[int(i)];
      element->values.assign(forces.data(), forces.data() + forces.size());
    }
    return rests.cwiseAbs().maxCoeff() <= kCarried * load.cwiseAbs().maxCoeff();
  }

 private:
  std::vector<int> dofsOf(const PatchElement& element) const {
    std::vector<int> dofs;
    for (const GlobalId node : element.nodes)
      for (int k = 0; k < dimension_; ++k) dofs.push_back(dimension_ * numberOf_.at(node) + k);
    return dofs;
  }

  /// Holds as many components as there are rigid motions, at nodes far from each other: the forces there vanish.
  void hold(std::vector<char>& held) const {
    const auto farthest = [&](const auto& distance) {
      int best = 0;
      double most = -1.0;
      for (std::size_t i = 0; i < places_.size(); ++i)
        if (distance(places_[i]) > most) most = distance(places_[i]), best = int(i);
      return best;
    };
    const Point origin = places_.front();
    const int a = farthest([&](const Point& p) { return norm(minus(p, origin)); });
    const int b = farthest([&](const Point& p) { return norm(minus(p, places_[a])); });
    const Point axis = unit(minus(places_[b], places_[a]));
    // Components least along the axis.
    std::vector<int> order(dimension_);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int i, int j) { return std::abs(axis[i]) < std::abs(axis[j]); });
    for (int k = 0; k < dimension_; ++k) held[dimension_ * a + k] = 1;
    for (int k = 0; k + 1 < dimension_; ++k) held[dimension_ * b + order[k]] = 1;
    if (dimension_ == 2) return;
    const auto off = [&](const Point& p) { return norm(cross(axis, minus(p, places_[a]))); };
    const int c = farthest(off);
    const Point turned = cross(axis, minus(places_[c], places_[a]));
    int most = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(turned[k]) > std::abs(turned[most])) most = k;
    held[dimension_ * c + most] = 1;
  }

  int dimension_;
  std::vector<PatchElement*> elements_;
  std::map<GlobalId, int> numberOf_;
  std::vector<Point> places_;
};

/// On rank 0. Returns false if a patch is a mechanism.
bool solvePatches(int dimension, const std::vector<UnbalancedForces>& rests, std::vector<PatchElement>& elements) {
  std::vector<std::vector<PatchElement*>> ofRest(rests.size());
  for (PatchElement& element : elements) ofRest[element.rest].push_back(&element);
  bool all = true;
  for (std::size_t i = 0; i < rests.size(); ++i) all = !ofRest[i].empty() && Patch(dimension, ofRest[i]).carry(rests[i]) && all;
  return all;
}

/// Forces of this rank's elements of the patches; nothing if a patch is a mechanism. Collective.
std::optional<std::vector<PatchElement>> forcesOfPatches(const Comm& comm, const BoundedSolution& solution,
                                                         const std::vector<UnbalancedForces>& rests, int dimension) {
  std::vector<NodeSet> at;
  for (const UnbalancedForces& rest : rests) at.emplace_back(rest.nodes.begin(), rest.nodes.end());
  std::vector<PatchElement> mine;
  const std::vector<NodeSet> around = nodesAround(comm, solution.meshes, at);
  collectively(comm, "finding patches", [&] { mine = elementsHere(comm, solution, around); });
  std::vector<PatchElement> all = joinOnRoot(comm, mine);
  std::vector<int> carried{1};
  collectivelyOnRoot(comm, "solving patches", [&] { carried[0] = solvePatches(dimension, rests, all); });
  broadcast(comm, carried);
  if (carried[0] == 0) return std::nullopt;
  std::vector<std::vector<PatchElement>> ofRanks(comm.getSize());
  for (PatchElement& element : all) ofRanks[element.rank].push_back(std::move(element));
  std::vector<std::string> bytes;
  if (comm.getRank() == 0)
    for (const auto& list : ofRanks) {
      Packer packer;
      packer.put(list);
      bytes.push_back(std::move(packer).bytes());
    }
  return Unpacker(scatterFromRoot(comm, bytes)).get<std::vector<PatchElement>>();
}

}  // namespace

template <int D>
bool carryRestForces(const Comm& comm, const BoundedSolution& solution, const std::vector<UnbalancedForces>& rests, BoundParts<D>& parts) {
  if (rests.empty()) return true;
  const std::optional<std::vector<PatchElement>> mine = forcesOfPatches(comm, solution, rests, D);
  if (!mine) return false;
  for (const PatchElement& own : *mine) {
    const Eigen::Map<const Matrix> forces(own.values.data(), D, int(own.nodes.size()));
    addForcesOf<D>(solution.meshes[own.mesh], own.mesh, own.element, forces, parts);
  }
  return true;
}

template bool carryRestForces(const Comm&, const BoundedSolution&, const std::vector<UnbalancedForces>&, BoundParts<2>&);
template bool carryRestForces(const Comm&, const BoundedSolution&, const std::vector<UnbalancedForces>&, BoundParts<3>&);

}  // namespace suture
