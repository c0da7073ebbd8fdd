#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/answer/solvability/SharedForces.hpp>
#include <suture/answer/solvability/UndeterminedForces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr double kHoldsAlone = 1e-3;    // least relative singular value of a pair's rows at a node without other pairs
constexpr double kAllowed = 1e-12;      // violation of a law that is accepted, relative to the largest force
constexpr double kSameTotal = 1e-9;     // relative change of a contact's total by a null vector that counts as zero
constexpr double kPushedAside = 1e150;  // slip, as a force, beyond any finite bound
constexpr double kNoSlip =
    1e-6;  // slip that counts as zero, relative to a body's largest displacement at pairs; as for gaps in PairClasses

using Rows = std::vector<const ContactRow*>;

/// Removes rows that cannot share their forces. A node of a single pair takes all forces of that pair, if the pair's rows are independent
/// there; the pair is removed, and its other nodes have one pair less. All pairs are treated as sticking: fewer rows cannot have more null
/// vectors.
class Peeling {
 public:
  Peeling(const Rows& rows, int dimension) : rows_(rows), dimension_(dimension), isLeft_(rows.size(), 1) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::set<GlobalId> nodes;
      for (const ContactRow::Equation& equation : rows[i]->equations)
        for (const GlobalId dof : equation.dofs) nodes.insert(dof / dimension_);
      for (const GlobalId node : nodes) at_[node].insert(i);
    }
  }

  Rows run() {
    std::vector<GlobalId> alone;
    for (const auto& [node, pairs] : at_)
      if (pairs.size() == 1) alone.push_back(node);
    while (!alone.empty()) {
      const GlobalId node = alone.back();
      alone.pop_back();
      if (at_[node].size() != 1) continue;
      const std::size_t pair = *at_[node].begin();
      if (!isHeldAt(*rows_[pair], node)) continue;
      isLeft_[pair] = 0;
      for (const ContactRow::Equation& equation : rows_[pair]->equations)
        for (const GlobalId dof : equation.dofs) {
          std::set<std::size_t>& others = at_[dof / dimension_];
          if (others.erase(pair) > 0 && others.size() == 1) alone.push_back(dof / dimension_);
        }
    }
    Rows left;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (isLeft_[i]) left.push_back(rows_[i]);
    return left;
  }

 private:
  bool isHeldAt(const ContactRow& row, GlobalId node) const {
    Matrix at = Matrix::Zero(Eigen::Index(row.equations.size()), dimension_);
    double largest = 0.0;
    for (std::size_t k = 0; k < row.equations.size(); ++k)
      for (std::size_t i = 0; i < row.equations[k].dofs.size(); ++i) {
        const double coefficient = row.equations[k].coefficients[i];
        largest = std::max(largest, std::abs(coefficient));
        if (row.equations[k].dofs[i] / dimension_ == node)
          at(Eigen::Index(k), Eigen::Index(row.equations[k].dofs[i] % dimension_)) = coefficient;
      }
    if (at.rows() == 1) return at.norm() > kHoldsAlone * largest;
    return singularValues(at).values.tail(1)(0) > kHoldsAlone * largest;
  }

  const Rows& rows_;
  GlobalId dimension_;
  std::vector<char> isLeft_;
  std::map<GlobalId, std::set<std::size_t>> at_;  // node -> places of rows
};

/// Rows of this rank that may share their forces with others; each row is on one rank.
std::vector<ContactRow> rowsInDoubt(const std::vector<SubdomainMesh>& meshes) {
  std::map<int, const ContactRow*> all;
  std::set<int> mine;
  int dimension = 2;
  for (const SubdomainMesh& mesh : meshes) {
    dimension = mesh.dimension;
    for (const ContactRow& row : mesh.contactRows) all.emplace(row.pair.id, &row);
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds)
      if (end.end == 0 && counts(mesh, end.node)) mine.insert(end.pair);
  }
  Rows rows;
  for (const auto& [id, row] : all) rows.push_back(row);
  std::vector<ContactRow> found;
  for (const ContactRow* row : Peeling(rows, dimension).run())
    if (mine.count(row->pair.id)) found.push_back(*row);
  return found;
}

/// The pairs without a gap of a solution whose rows may share forces, on one rank. Displacements alone decide which forces a pair may
/// carry. The states with which a solver ended do not: a pair that touches without force may be open or closed, and a pair at its bound
/// that does not slide may stick or slip.
class ClosedPairs {
 public:
  ClosedPairs(const std::vector<ContactRow>& rows, int dimension, const ContactLaws& laws, std::vector<PairResult>& pairs)
      : laws_(laws), pairs_(pairs) {
    for (const PairResult& pair : pairs)
      for (const int body : pair.bodies) moved_[body] = std::max(moved_[body], norm(pair.displacement));
    for (const ContactRow& row : rows) {
      const PairResult& pair = pairs.at(std::size_t(row.pair.id));
      const std::vector<Point> frame = pairFrame(row.pair, dimension);
      const ContactState state = stateWithoutGap(pair, frame);
      if (!state.closed()) continue;
      states_[pair.id] = state;
      frames_[pair.id] = frame;
      const double unit = pair.length > 0.0 ? std::sqrt(pair.length) : 1.0;
      for (std::size_t k = 0; k < row.equations.size(); ++k) {
        if (!state.holds(static_cast<int>(k))) continue;
        ForceColumn column{pair.id, {}};
        Point direction = frame[k];
        add(row.equations[k], unit, column);
        if (k == 0 && state.couplesToNormal())
          for (std::size_t t = 1; t < row.equations.size(); ++t) {
            const double part = state.friction * state.direction[t];
            add(row.equations[t], unit * part, column);
            direction = plus(direction, scaled(part, frame[t]));
          }
        columns_.push_back(column);
        amplitudes_.push_back((k == 0 ? pair.force : dot(pair.tangential, frame[k])) / unit);
        places_.push_back({pair.id, static_cast<int>(k), unit, direction});
      }
    }
  }

  const std::vector<ForceColumn>& columns() const { return columns_; }

  /// Sets the least forces of the pairs of some columns. \return these pairs and contacts
  UndeterminedForces settle(const SharedForces& shared, const std::vector<std::string>& contacts) {
    Vector amplitudes(Eigen::Index(shared.columns.size()));
    for (std::size_t i = 0; i < shared.columns.size(); ++i) amplitudes(Eigen::Index(i)) = amplitudes_[std::size_t(shared.columns[i])];
    const double largest = amplitudes.size() > 0 ? amplitudes.cwiseAbs().maxCoeff() : 0.0;
    const Vector least = leastAmplitudes(shared, amplitudes, [&](const Vector& now) { return violated(shared, now, kAllowed * largest); });
    UndeterminedForces found;
    std::set<int> ids, lines;
    bool isNormal = false;
    for (std::size_t i = 0; i < shared.columns.size(); ++i) {
      const Place& place = places_[std::size_t(shared.columns[i])];
      take(place, least(Eigen::Index(i)));
      if (shared.basis.row(Eigen::Index(i)).norm() <= kSameTotal) continue;
      PairResult& pair = pairs_[std::size_t(place.pair)];
      if (std::abs(least(Eigen::Index(i))) > kAllowed * largest) pair.state = states_.at(place.pair);
      isNormal = isNormal || place.component == 0;
      ids.insert(place.pair);
      lines.insert(pairs_[std::size_t(place.pair)].line);
    }
    found.pairs = static_cast<int>(ids.size());
    // A single pair whose tangential motion is prescribed on both sides, as in a plane of symmetry: its tangential force is of no interest.
    if (!isNormal && ids.size() < 2) return {};
    for (const int line : lines) {
      found.contacts.push_back(contacts.at(std::size_t(line)));
      if (isTotalDetermined(shared, line)) found.totals.push_back(found.contacts.back());
    }
    return found;
  }

 private:
  struct Place {
    int pair, component;
    double unit;      // scale of the amplitude [root of length or area]
    Point direction;  // direction of the force on side B
  };

  /// State of the pair by its displacements: open only with a gap, slipping only if it slides.
  ContactState stateWithoutGap(const PairResult& pair, const std::vector<Point>& frame) const {
    const bool touches = pair.state.closed() || pair.touching;
    if (!touches || !pair.kind.restrictsSliding) return touches ? PairStatus::Slip : PairStatus::Open;
    if (pair.state.status == PairStatus::Stick) return pair.state;
    const Point slip = pair.stepSlip();
    const double moved = std::max(moved_.at(pair.bodies[0]), moved_.at(pair.bodies[1])), size = norm(slip);
    const bool slides = size > kNoSlip * moved;
    if (pair.state.closed()) {
      ContactState state = pair.state;
      if (!slides) {
        state.status = PairStatus::Stick;
        state.direction = {0, 0, 0};
      }
      return state;
    }
    Point along{0, 0, 0};
    for (std::size_t t = 1; slides && t < frame.size(); ++t) along[t] = dot(slip, frame[t]) / size;
    return laws_.of(pair.line).project(pushed(pair, 1.0, along), slides ? PairStatus::Slip : PairStatus::Stick);
  }

  /// A trial that slides beyond any bound along a unit vector of the pair's frame; zero: it does not slide.
  static ContactTrial pushed(const PairResult& pair, double normal, const Point& along) {
    ContactTrial trial;
    trial.place = pair.position;
    trial.size = pair.length;
    trial.slipped = pair.past.slipped;
    trial.force[0] = std::max(normal, 0.0);
    for (int t = 1; t < 3; ++t) trial.jump[t] = kPushedAside * along[t];
    return trial;
  }

  static void add(const ContactRow::Equation& equation, double factor, ForceColumn& column) {
    for (std::size_t i = 0; i < equation.dofs.size(); ++i) column.entries.emplace_back(equation.dofs[i], factor * equation.coefficients[i]);
  }

  void take(const Place& place, double amplitude) {
    PairResult& pair = pairs_[std::size_t(place.pair)];
    const double force = amplitude * place.unit;
    const std::vector<Point>& frame = frames_.at(place.pair);
    if (place.component > 0) {
      pair.tangential = plus(
          pair.tangential, scaled(force - dot(pair.tangential, frame[std::size_t(place.component)]), frame[std::size_t(place.component)]));
      return;
    }
    const ContactState& state = states_.at(place.pair);
    if (state.couplesToNormal())
      for (std::size_t t = 1; t < frame.size(); ++t)
        pair.tangential = plus(pair.tangential, scaled((force - pair.force) * state.friction * state.direction[t], frame[t]));
    pair.force = force;
  }

  bool isTotalDetermined(const SharedForces& shared, int line) const {
    Matrix total = Matrix::Zero(3, Eigen::Index(shared.columns.size()));
    for (std::size_t i = 0; i < shared.columns.size(); ++i) {
      const Place& place = places_[std::size_t(shared.columns[i])];
      if (pairs_[std::size_t(place.pair)].line != line) continue;
      for (int c = 0; c < 3; ++c) total(c, Eigen::Index(i)) = place.unit * place.direction[std::size_t(c)];
    }
    return (total * shared.basis).norm() <= kSameTotal * total.norm();
  }

  std::vector<ForceCut> violated(const SharedForces& shared, const Vector& now, double slack) const {
    std::map<int, std::array<int, 3>> columnsOf;  // by pair: position of each component
    for (std::size_t i = 0; i < shared.columns.size(); ++i) {
      const Place& place = places_[std::size_t(shared.columns[i])];
      columnsOf.try_emplace(place.pair, std::array<int, 3>{{-1, -1, -1}}).first->second[std::size_t(place.component)] = static_cast<int>(i);
    }
    std::vector<ForceCut> cuts;
    for (const auto& [id, columns] : columnsOf) {
      const PairResult& pair = pairs_[std::size_t(id)];
      const double unit =
          places_[std::size_t(shared.columns[std::size_t(columns[0] >= 0 ? columns[0] : std::max(columns[1], columns[2]))])].unit;
      const double normal = columns[0] >= 0 ? now(columns[0]) * unit : pair.force;
      if (pair.kind.separates && columns[0] >= 0 && normal < -slack * unit) cuts.push_back({{{columns[0], 1.0}}, 0.0});
      const ContactState& held = states_.at(id);
      if (held.status != PairStatus::Stick || !pair.kind.restrictsSliding) continue;
      const std::vector<Point>& frame = frames_.at(id);
      Point along{0, 0, 0};
      for (std::size_t t = 1; t < frame.size(); ++t) along[t] = columns[t] >= 0 ? now(columns[t]) * unit : dot(pair.tangential, frame[t]);
      const double size = norm(along);
      if (size == 0.0) continue;
      const ContactState state = laws_.of(pair.line).project(pushed(pair, normal, scaled(1.0 / size, along)), held);
      if (state.status != PairStatus::Slip) continue;  // any force is admissible, or no pressure acts on the pair
      if (size <= state.largest(normal) + slack * unit) continue;
      ForceCut cut;
      double fixed = 0.0;
      if (columns[0] >= 0)
        cut.normal.emplace_back(columns[0], state.friction);
      else
        fixed += state.friction * pair.force / unit;
      for (std::size_t t = 1; t < frame.size(); ++t) {
        if (columns[t] >= 0)
          cut.normal.emplace_back(columns[t], -along[t] / size);
        else
          fixed -= along[t] / size * along[t] / unit;
      }
      cut.bound = -state.bound / unit - fixed;
      cuts.push_back(cut);
    }
    return cuts;
  }

  const ContactLaws& laws_;
  std::vector<PairResult>& pairs_;
  std::vector<ForceColumn> columns_;
  std::vector<double> amplitudes_;
  std::vector<Place> places_;
  std::map<int, double> moved_;  // by body: largest displacement at its pairs
  std::map<int, ContactState> states_;
  std::map<int, std::vector<Point>> frames_;
};

/// Joins parts that concern the same contacts. The total of a contact is determined if it is determined in all parts.
std::vector<UndeterminedForces> byContacts(const std::vector<UndeterminedForces>& parts) {
  std::map<std::vector<std::string>, UndeterminedForces> all;
  for (const UndeterminedForces& part : parts) {
    if (part.pairs == 0) continue;
    const auto [at, isNew] = all.try_emplace(part.contacts, part);
    if (isNew) continue;
    UndeterminedForces& sum = at->second;
    sum.pairs += part.pairs;
    std::vector<std::string> both;
    for (const std::string& name : sum.totals)
      if (std::find(part.totals.begin(), part.totals.end(), name) != part.totals.end()) both.push_back(name);
    sum.totals = both;
  }
  std::vector<UndeterminedForces> result;
  for (const auto& [contacts, one] : all) result.push_back(one);
  return result;
}

}  // namespace

void settleContactForces(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ContactLaws& laws,
                         const std::vector<std::string>& contacts, Solution& solution) {
  std::vector<ContactRow> mine;
  collectively(comm, "looking for contact forces that are not unique", [&] { mine = rowsInDoubt(meshes); });
  const std::vector<ContactRow> rows = joinOnRoot(comm, mine);
  int dimension = 2, any = 0;
  for (const SubdomainMesh& mesh : meshes) dimension = mesh.dimension;
  const int here[2] = {mine.empty() ? 0 : 1, dimension};
  int most[2];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, here, most);
  if (most[0] == 0) return;
  std::vector<PairForce> forces;
  std::string message;
  collectivelyOnRoot(comm, "finding contact forces that are not unique", [&] {
    std::vector<PairResult> settled = solution.pairs;
    ClosedPairs closed(rows, most[1], laws, settled);
    std::vector<UndeterminedForces> found;
    for (const SharedForces& shared : sharedForces(closed.columns())) {
      found.push_back(closed.settle(shared, contacts));
      any = 1;
    }
    for (const PairResult& pair : settled) forces.push_back({pair.id, pair.state, pair.force, pair.tangential});
    Packer packer;
    packer.put(any);
    packer.put(byContacts(found));
    message = packer.bytes();
  });
  Unpacker unpacker(broadcast(comm, message));
  unpacker.get(any);
  unpacker.get(solution.sharedForces);
  if (!any) return;
  std::vector<const SubdomainMesh*> all;
  for (const SubdomainMesh& mesh : meshes) all.push_back(&mesh);
  const std::vector<PairResult> before = solution.pairs;
  solution.pairs = pairResults(comm, all, solution.displacement, forces);
  for (std::size_t i = 0; i < before.size(); ++i) solution.pairs[i].touching = before[i].touching && !solution.pairs[i].state.closed();
}

std::string inWords(const UndeterminedForces& forces) {
  const auto listed = [](const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + ("'" + names[i] + "'");
    return text;
  };
  std::string text = (forces.contacts.size() == 1 ? "contact " : "contacts ") + listed(forces.contacts) +
                     ": equilibrium does not determine the forces of " + std::to_string(forces.pairs) +
                     (forces.pairs == 1 ? " pair" : " pairs") +
                     " at nodes that are shared by several pairs or held by boundary conditions. The least forces are reported";
  std::vector<std::string> open;
  for (const std::string& name : forces.contacts)
    if (std::find(forces.totals.begin(), forces.totals.end(), name) == forces.totals.end()) open.push_back(name);
  if (open.empty()) return text + "; the total force of each contact is unique";
  return text + "; the total force of " + listed(open) + " is not unique";
}

}  // namespace suture
