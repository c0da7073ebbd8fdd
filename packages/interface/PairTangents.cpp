#include <suture/interface/PairTangents.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

PairTangents::PairTangents(std::shared_ptr<const InterfaceSpace> space, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                           const std::vector<ContactRow>& rows, std::vector<char> owned, const ContactClusters& clusters, int components,
                           bool friction)
    : space_(std::move(space)), rows_(rows), owned_(std::move(owned)), clusters_(clusters), components_(components), restricts_(friction) {
  findNeighbours(subdomains);
}

/// In 2D pairs are numbered along their lines, and neighbours are consecutive. In 3D neighbours share a cell; only cells with a pair of
/// this rank are known here.
void PairTangents::findNeighbours(const std::vector<std::unique_ptr<Subdomain>>& subdomains) {
  if (space_->dimension() == 2) {
    for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
      const bool follows = i > 0 && rows_[i].pair.id == rows_[i - 1].pair.id + 1 && rows_[i].pair.line == rows_[i - 1].pair.line;
      if (!follows) neighbours_.emplace_back();
      neighbours_.back().push_back(i);
    }
    return;
  }
  std::map<int, int> rowOf;
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) rowOf[rows_[i].pair.id] = i;
  std::set<std::vector<int>> cells;
  for (const auto& subdomain : subdomains) cells.insert(subdomain->mesh().contactCells.begin(), subdomain->mesh().contactCells.end());
  for (const std::vector<int>& cell : cells) {
    neighbours_.emplace_back();
    for (const int pair : cell) {
      const auto at = rowOf.find(pair);
      neighbours_.back().push_back(at == rowOf.end() ? -1 : at->second);
    }
  }
}

/// Unknowns of neighbouring closed pairs, as InterfaceSpace::related() needs them.
std::vector<std::vector<int>> PairTangents::closedNeighbours(const std::vector<ContactState>& states) const {
  const bool inSpace = space_->dimension() == 3;
  std::vector<std::vector<int>> neighbours;
  for (int component = 0; component < components_; ++component)
    for (const auto& rows : neighbours_) {
      neighbours.emplace_back();
      for (const int pair : rows) {
        const int row = pair < 0 ? -1 : clusters_.rowOf(pair, component);
        // A closed pair identifies its unknowns, so any of them represents it. A pair that is open, or held on one side, ends a stretch.
        const bool joins = row >= 0 && states[pair].holds(component) && clusters_.row(row).places.size() == 2;
        if (joins || inSpace)
          neighbours.back().push_back(joins ? clusters_.row(row).places[0] : -1);
        else if (!neighbours.back().empty())
          neighbours.emplace_back();
      }
    }
  return neighbours;
}

std::shared_ptr<const FrictionTangent> PairTangents::frictionOf(const std::vector<ContactState>& states,
                                                                std::vector<InterfaceRelation> test) const {
  auto tangent = std::make_shared<FrictionTangent>();
  for (const ContactState& state : states) tangent->symmetric = tangent->symmetric && !state.couplesToNormal();
  tangent->test = std::move(test);
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const ContactState& own = states[i];
    if (!owned_[i] || own.transverseStiffness == 0.0) continue;
    const Point across = acrossSlip(own);
    InterfaceSpring spring;
    spring.stiffness = own.transverseStiffness;
    for (int component = 1; component <= 2; ++component)
      if (const int tangentRow = clusters_.rowOf(i, component); tangentRow >= 0) {
        const ContactClusters::Row& row = clusters_.row(tangentRow);
        for (std::size_t k = 0; k < row.places.size(); ++k) {
          spring.places.push_back(row.places[k]);
          spring.coefficients.push_back(across[component] * row.coefficients[k]);
        }
      }
    tangent->springs.push_back(std::move(spring));
  }
  return tangent;
}

const PairTangent& PairTangents::of(const ContactStates& states) {
  if (last_.space && states == last_.states) return last_;
  std::vector<InterfaceRelation> test, relations = clusters_.relations(states[0], restricts_ ? &test : nullptr);
  bool sameSpace = false;
  if (restricts_) {
    last_.friction = frictionOf(states[0], std::move(test));
    const auto sameRows = [](const ContactState& a, const ContactState& b) { return a.holdsAs(b); };
    std::vector<int> unknowns;
    for (const InterfaceRelation& relation : relations) unknowns.push_back(relation.unknown);
    sameSpace = last_.space && unknowns == unknowns_ && std::equal(states[0].begin(), states[0].end(), last_.states[0].begin(), sameRows);
    unknowns_ = std::move(unknowns);
  }
  if (!sameSpace) last_.space = space_->related(std::move(relations), closedNeighbours(states[0]));
  last_.states = states;
  return last_;
}

}  // namespace suture
