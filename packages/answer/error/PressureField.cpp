#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/error/ErrorNorms.hpp>
#include <suture/answer/error/PressureField.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/pairs/mortar/ShapeValues.hpp>

#include <Eigen/SparseLU>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
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
      if (!row.canChange()) mine.push_back(row.pair.id);
  return unionOverRanks(comm, mine);
}

/// A nodal value as a combination of others.
using Combination = std::vector<std::pair<GlobalId, double>>;

/// p_h at a fixed node of a line, extrapolated from the nodes of a side: weights of the other two nodes, or of the other one.
struct Continuation {
  GlobalId held;
  Combination from;
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

/// Extrapolation to fixed nodes; the mean if two sides of a line meet there.
std::map<GlobalId, Combination> continuedAlongLines(const std::vector<ContactSide>& sides, const std::set<GlobalId>& held) {
  std::map<GlobalId, std::vector<Continuation>> continued;
  for (const ContactSide& side : sides)
    for (const Continuation& one : continuationsOf(side, held)) continued[one.held].push_back(one);
  std::map<GlobalId, Combination> all;
  for (const auto& [node, ways] : continued)
    for (const Continuation& way : ways)
      for (const auto& [from, weight] : way.from) all[node].push_back({from, weight / static_cast<double>(ways.size())});
  return all;
}

/// Extrapolation on a surface: a polynomial fitted to the pressures at the nearest nodes.
class SurfaceFit {
 public:
  /// \param nodes  nodes with pressures
  SurfaceFit(const std::vector<ContactSide>& sides, const std::set<GlobalId>& nodes) : sides_(sides), nodes_(nodes) {
    for (std::size_t s = 0; s < sides.size(); ++s)
      for (std::size_t i = 0; i < sides[s].nodes.size(); ++i) {
        around_[sides[s].nodes[i]].push_back(s);
        points_[sides[s].nodes[i]] = sides[s].points[i];
      }
  }

  Combination at(GlobalId node) const {
    if (!around_.count(node)) return {};
    std::set<GlobalId> reached{node};
    Combination constant;
    for (int ring = 0; ring < kRings; ++ring) {
      reached = grown(reached);
      const std::vector<GlobalId> from = withPressures(reached);
      if (constant.empty())
        for (const GlobalId one : from) constant.push_back({one, 1.0 / static_cast<double>(from.size())});
      const bool isFirstOrder = sides_.front().nodes.size() <= kMostSideVertices;
      if (isFirstOrder && constant.empty()) continue;  // a corner with sides that are entirely fixed
      if (isFirstOrder) return constant;
      if (const Combination straight = fitted(node, from); !straight.empty()) return straight;
    }
    return constant;
  }

 private:
  static constexpr int kRings = 3;             // rings of sides around the node
  static constexpr double kDetermined = 1e-3;  // ratio of the extents of the nodes from which a slope is determined

  std::set<GlobalId> grown(const std::set<GlobalId>& nodes) const {
    std::set<GlobalId> all;
    for (const GlobalId node : nodes)
      for (const std::size_t s : around_.at(node)) all.insert(sides_[s].nodes.begin(), sides_[s].nodes.end());
    return all;
  }
  std::vector<GlobalId> withPressures(const std::set<GlobalId>& reached) const {
    std::vector<GlobalId> both;
    std::set_intersection(reached.begin(), reached.end(), nodes_.begin(), nodes_.end(), std::back_inserter(both));
    return both;
  }
  /// Value at a node of the linear function that fits others best; none if they do not determine it.
  Combination fitted(GlobalId node, const std::vector<GlobalId>& from) const {
    if (from.size() < 3) return {};
    Matrix arms(static_cast<int>(from.size()), 3);
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Point arm = minus(points_.at(from[i]), points_.at(node));
      arms.row(Eigen::Index(i)) << arm[0], arm[1], arm[2];
    }
    const SingularValues axes = singularValues(arms);  // the third axis is normal to the surface
    Matrix terms(arms.rows(), 3);
    terms.col(0).setConstant(axes.values[0] / std::sqrt(double(from.size())));
    terms.rightCols(2) = arms * axes.v.leftCols(2);
    const SingularValues fit = singularValues(terms);
    if (fit.values[2] < kDetermined * fit.values[0]) return {};
    const Vector weights = terms(0, 0) * fit.u * fit.values.cwiseInverse().asDiagonal() * fit.v.row(0).transpose();
    Combination all;
    for (std::size_t i = 0; i < from.size(); ++i) all.push_back({from[i], weights[Eigen::Index(i)]});
    return all;
  }

  const std::vector<ContactSide>& sides_;
  const std::set<GlobalId>& nodes_;
  std::map<GlobalId, std::vector<std::size_t>> around_;
  std::map<GlobalId, Point> points_;
};

/// p_h at the fixed nodes as combinations of the values at other nodes.
std::map<GlobalId, Combination> continuedValues(const std::vector<ContactSide>& sides, const std::set<GlobalId>& carriers,
                                                const std::set<GlobalId>& held) {
  if (held.empty() || sides.empty()) return {};
  if (sides.front().dimension == 2) return continuedAlongLines(sides, held);
  std::set<GlobalId> others;
  std::set_difference(carriers.begin(), carriers.end(), held.begin(), held.end(), std::inserter(others, others.end()));
  const SurfaceFit fit(sides, others);
  std::map<GlobalId, Combination> all;
  for (const GlobalId node : held) all[node] = fit.at(node);
  return all;
}

/// Mid-side and central nodes of 3D sides with pressures interpolated linearly from the vertices. None if one of these nodes carries a
/// pair.
std::map<GlobalId, Combination> interpolatedNodes(const std::vector<ContactSide>& sides, const std::set<GlobalId>& carriers) {
  std::map<GlobalId, Combination> all;
  for (const ContactSide& side : sides) {
    if (side.dimension == 2) continue;
    const std::size_t vertices = std::size_t(sideVertices(int(side.nodes.size()), side.dimension));
    for (std::size_t i = vertices; i < side.nodes.size(); ++i) {
      if (carriers.count(side.nodes[i])) return {};
      Combination& from = all[side.nodes[i]];
      from.clear();
      if (i < 2 * vertices)
        from = {{side.nodes[i - vertices], 0.5}, {side.nodes[(i + 1) % vertices], 0.5}};
      else
        for (std::size_t v = 0; v < vertices; ++v) from.push_back({side.nodes[v], 1.0 / double(vertices)});
    }
  }
  return all;
}

/// The functions of a side's nodes, by their values at the nodes (functions x nodes): those of the multiplier if mid-side nodes carry
/// pairs, else the shape functions.
Matrix functionsOf(const ContactSide& side, bool haveMiddlePairs) {
  const int nodes = static_cast<int>(side.nodes.size());
  Matrix values = Matrix::Identity(nodes, nodes);
  if (side.dimension == 2 || !haveMiddlePairs) return values;
  for (int i = 0; i < nodes; ++i)
    values.col(i) = Eigen::Map<const Vector>(multiplierValues(nodes, 3, referencePoint(sideCell(nodes), i)).data(), nodes);
  return values;
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
      all.back().dimension = mesh.dimension;
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
  std::set<GlobalId> held, carriers;
  std::vector<double> forces;
  for (const PairResult& pair : pairs) {
    if (pair.line != line) continue;
    carriers.insert(pair.node);
    if (std::binary_search(heldPairs.begin(), heldPairs.end(), pair.id)) {
      held.insert(pair.node);
    } else if (pair.state.closed() && number.emplace(pair.node, static_cast<int>(forces.size())).second) {
      forces.push_back(pair.force);
    }
  }
  const int unknowns = static_cast<int>(forces.size());
  if (unknowns == 0) return {};
  const std::map<GlobalId, Combination> interpolated = interpolatedNodes(sides, carriers),
                                        continued = continuedValues(sides, carriers, held);

  // The factor of each node's function in p_h, and the function of each unknown, as combinations of unknowns. Factors of a linear p_h are
  // its values at the nodes.
  using Unknowns = std::vector<std::pair<int, double>>;
  std::map<GlobalId, Unknowns> combination, functions;
  const auto addTo = [](Unknowns& sum, const Unknowns& more, double weight) {
    for (const auto& [unknown, own] : more) sum.push_back({unknown, weight * own});
  };
  for (const auto& [node, unknown] : number) combination[node] = functions[node] = {{unknown, 1.0}};
  for (const auto& [node, way] : continued)
    for (const auto& [from, weight] : way)
      if (const auto unknown = number.find(from); unknown != number.end()) combination[node].push_back({unknown->second, weight});
  for (const auto& [node, way] : interpolated)
    for (const auto& [from, weight] : way) {
      if (number.count(from)) functions[node].push_back({number.at(from), weight});
      if (const auto vertex = combination.find(from); vertex != combination.end()) addTo(combination[node], vertex->second, weight);
    }

  std::vector<Eigen::Triplet<double>> entries;
  for (const ContactSide& side : sides) {
    const Matrix own = functionsOf(side, interpolated.empty());
    const Matrix mass = own * sideMass(side.points, side.dimension, side.axisymmetric) * own.transpose();
    for (std::size_t i = 0; i < side.nodes.size(); ++i) {
      const auto rows = functions.find(side.nodes[i]);
      if (rows == functions.end()) continue;
      for (std::size_t j = 0; j < side.nodes.size(); ++j)
        if (const auto columns = combination.find(side.nodes[j]); columns != combination.end())
          for (const auto& [row, factor] : rows->second)
            for (const auto& [unknown, weight] : columns->second)
              entries.emplace_back(row, unknown, factor * weight * mass(Eigen::Index(i), Eigen::Index(j)));
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) throw InternalError("the mass matrix of contact line " + std::to_string(line + 1) + " is singular");
  const Vector values = factor.solve(Eigen::Map<const Vector>(forces.data(), unknowns));

  std::map<GlobalId, double> factors, field;
  for (const auto& [node, from] : combination)
    for (const auto& [unknown, weight] : from) factors[node] += weight * values[unknown];
  for (const ContactSide& side : sides) {
    const Matrix own = functionsOf(side, interpolated.empty());
    std::map<GlobalId, double> here;
    for (std::size_t j = 0; j < side.nodes.size(); ++j)
      if (const auto factor = factors.find(side.nodes[j]); factor != factors.end())
        for (std::size_t i = 0; i < side.nodes.size(); ++i)
          if (const double value = own(Eigen::Index(j), Eigen::Index(i)); value != 0.0) here[side.nodes[i]] += value * factor->second;
    for (const auto& [node, value] : here) field[node] = value;  // equal from all sides
  }
  return field;
}

}  // namespace suture
