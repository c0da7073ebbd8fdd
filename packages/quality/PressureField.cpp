#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/quality/ErrorNorms.hpp>
#include <suture/quality/PressureField.hpp>

#include <Eigen/SparseLU>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

bool carries(const std::vector<ContactSide>& sides, const std::set<GlobalId>& nodes) {
  return std::any_of(sides.begin(), sides.end(), [&](const ContactSide& side) {
    return std::any_of(side.nodes.begin(), side.nodes.end(), [&](GlobalId node) { return nodes.count(node) > 0; });
  });
}

std::vector<int> heldPairs(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  std::vector<int> mine;
  for (const SubdomainMesh& mesh : meshes)
    for (const ContactRow& row : mesh.contactRows)
      if (!row.able()) mine.push_back(row.pair.id);
  return unionOverRanks(comm, mine);
}

/// p_h at a held node from another side's nodes: weights of the other two, or of the other one.
struct Continuation {
  GlobalId held;
  std::vector<std::pair<GlobalId, double>> from;
};

std::vector<Continuation> continuationsOf(const ContactSide& side, const std::set<GlobalId>& held) {
  const auto count = std::count_if(side.nodes.begin(), side.nodes.end(), [&](GlobalId node) { return held.count(node) > 0; });
  if (count != 1) return {};
  const GlobalId a = side.nodes[0], b = side.nodes[1];
  if (side.nodes.size() == 2) return {held.count(a) ? Continuation{a, {{b, 1.0}}} : Continuation{b, {{a, 1.0}}}};
  const GlobalId middle = side.nodes[2];
  if (held.count(middle)) return {{middle, {{a, 0.5}, {b, 0.5}}}};
  return {held.count(a) ? Continuation{a, {{middle, 2.0}, {b, -1.0}}} : Continuation{b, {{middle, 2.0}, {a, -1.0}}}};
}

}  // namespace

std::vector<ContactSide> contactSidesHere(const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& groups) {
  std::vector<ContactSide> all;
  for (const SubdomainMesh& mesh : meshes)
    for (const Side& side : sidesOf(mesh.sideGroups, groups)) {
      all.emplace_back();
      for (const int node : mesh.nodesOf(side)) {
        all.back().nodes.push_back(mesh.globalNodes[node]);
        all.back().points.push_back(mesh.point(node));
      }
    }
  return all;
}

ContactSides contactSides(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Parameters& contact,
                          const std::vector<PairResult>& pairs) {
  ContactSides result;
  const std::vector<std::string> lines = sublistNames(contact);
  for (int line = 0; line < static_cast<int>(lines.size()); ++line) {
    std::set<GlobalId> carriers;  // on rank 0
    for (const PairResult& pair : pairs)
      if (pair.line == line) carriers.insert(pair.node);
    for (const char* name : {"Side A", "Side B"}) {
      const std::vector<std::string> groups = groupNames(contact.sublist(lines[line]), name);
      if (groups.empty()) continue;
      std::vector<ContactSide> sides = joinOnRoot(comm, contactSidesHere(meshes, groups));
      if (carries(sides, carriers)) result.ofLine[line] = std::move(sides);
    }
  }
  result.heldPairs = heldPairs(comm, meshes);
  return result;
}

std::map<GlobalId, double> pressureField(const std::vector<ContactSide>& sides, int line, const std::vector<PairResult>& pairs,
                                         const std::vector<int>& heldPairs) {
  std::map<GlobalId, int> number;  // unknowns
  std::set<GlobalId> held;
  std::vector<double> forces;
  for (const PairResult& pair : pairs) {
    if (pair.line != line) continue;
    if (std::binary_search(heldPairs.begin(), heldPairs.end(), pair.id)) {
      held.insert(pair.node);
    } else if (pair.state.closed() && number.emplace(pair.node, static_cast<int>(forces.size())).second) {
      forces.push_back(pair.force);
    }
  }
  const int unknowns = static_cast<int>(forces.size());
  if (unknowns == 0) return {};

  // p_h at each node as a combination of unknowns; where two sides go on into a held node, their mean.
  std::map<GlobalId, std::vector<std::pair<int, double>>> combination;
  for (const auto& [node, unknown] : number) combination[node] = {{unknown, 1.0}};
  std::map<GlobalId, std::vector<Continuation>> continued;
  for (const ContactSide& side : sides)
    for (const Continuation& one : continuationsOf(side, held)) continued[one.held].push_back(one);
  for (const auto& [node, ways] : continued)
    for (const Continuation& way : ways)
      for (const auto& [from, weight] : way.from)
        if (const auto unknown = number.find(from); unknown != number.end())
          combination[node].push_back({unknown->second, weight / static_cast<double>(ways.size())});

  std::vector<Eigen::Triplet<double>> entries;
  for (const ContactSide& side : sides) {
    const Matrix mass = sideMass(side.points, side.axisymmetric);
    for (std::size_t i = 0; i < side.nodes.size(); ++i) {
      const auto row = number.find(side.nodes[i]);
      if (row == number.end()) continue;
      for (std::size_t j = 0; j < side.nodes.size(); ++j)
        if (const auto column = combination.find(side.nodes[j]); column != combination.end())
          for (const auto& [unknown, weight] : column->second)
            entries.emplace_back(row->second, unknown, weight * mass(Eigen::Index(i), Eigen::Index(j)));
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) throw InternalError("the mass matrix of contact line " + std::to_string(line + 1) + " is singular");
  const Vector values = factor.solve(Eigen::Map<const Vector>(forces.data(), unknowns));

  std::map<GlobalId, double> field;
  for (const auto& [node, from] : combination)
    for (const auto& [unknown, weight] : from) field[node] += weight * values[unknown];
  return field;
}

}  // namespace suture
