#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/Mechanisms.hpp>
#include <suture/precond/MortarRows.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace suture {

namespace {

constexpr double kSameMotion = 1e-2;  // tolerance for dependent motions of a group: a nearly straight line
constexpr int kColumnsAtOnce = 32;    // columns per sum over all ranks, which are as long as the interface
constexpr double kDependent = 1e-8;   // relative remainder below which a functional is linearly dependent on the others

int largest(const Comm& comm, int mine) {
  int all = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace

/// Works in the broken space.
class MortarRows::Maker {
 public:
  Maker(const InterfaceSpace& space, const InterfaceSpace& broken, const PrimalChoice& choice, MortarRows& made)
      : space_(broken), made_(made) {
    // A rank knows only the entities of its local problems: owners send their flags to the others.
    Matrix alone = Matrix::Zero(space_.overlapSize(), 1);
    for (int place = 0; place < space_.overlapSize(); ++place) alone(place, 0) = space_.ownedRow(place) >= 0 && choice.alone[place];
    space_.sum(alone);
    for (int place = 0; place < space_.overlapSize(); ++place) alone_.push_back(alone(place, 0) > 0.0);
    for (int i = 0; i < space_.locals(); ++i) localOf_[space_.localId(i)] = i;
    for (const InterfaceRelation& relation : space.relations())
      if (space.isBroken(relation)) relations_[space_.id(relation.unknown)] = &relation;
  }

  void make() {
    findGroups();
    addPoints();
    orthonormalise();
    exchange();
    write();
  }

 private:
  /// A right-hand side on one local problem j: coefficients of its unknowns that are not primal alone. All ranks identify it by one of its
  /// rows and a number within that row.
  struct Functional {
    int row;                                       // place of the row's expressed unknown
    int slot;                                      // number within the row
    int on;                                        // id of j
    std::map<int, double> coefficients;            // by place
    std::vector<std::pair<int, double>> combined;  // private primal unknowns of j, by number
  };
  /// A left-hand side, and the right-hand sides of which it is the sum.
  struct Side {
    std::vector<std::pair<int, double>> entries;  // (place, coefficient) of the group
    std::map<int, double> alone;                  // coefficients of unknowns that are primal alone, by place
    std::vector<int> functionals;
    int on = -1;  // id of i; -1: the expressed unknown itself, in all its local problems
  };

  bool isOn(int place, int local) const {
    const std::vector<int>& sharers = space_.sharers(place);
    return std::binary_search(sharers.begin(), sharers.end(), local);
  }

  /// Adds the coefficients of the unknowns that express one or several rows.
  void add(Side& side, const std::map<int, double>& masters, int row, int firstSlot, int on) {
    std::map<int, std::map<int, double>> byLocal;
    for (const auto& [place, value] : masters)
      if (alone_[place])
        side.alone[place] += value;
      else
        byLocal[on >= 0 && isOn(place, on) ? on : space_.sharers(place).front()][place] += value;
    int slot = firstSlot;
    for (auto& [id, coefficients] : byLocal) {
      side.functionals.push_back(static_cast<int>(functionals_.size()));
      functionals_.push_back({row, slot++, id, std::move(coefficients), {}});
    }
  }

  void findGroups() {
    std::map<std::pair<int, int>, std::vector<const InterfaceRelation*>> groups;  // (i, j)
    for (const auto& [id, relation] : relations_) {
      const std::vector<int>& own = space_.sharers(relation->unknown);
      if (own.size() != 1 || alone_[relation->unknown]) continue;
      std::vector<int> common;
      bool any = false, allAlone = true;
      for (const int place : relation->others) {
        const std::vector<int>& sharers = space_.sharers(place);
        if (isOn(place, own[0])) continue;
        std::vector<int> both;
        std::set_intersection(common.begin(), common.end(), sharers.begin(), sharers.end(), std::back_inserter(both));
        if (any)
          common = std::move(both);
        else
          common = sharers;
        any = true;
        allAlone = allAlone && alone_[place];
      }
      if (!common.empty() && !allAlone) groups[{own[0], common[0]}].push_back(relation);
    }
    findUngrouped(groups);
    for (const auto& [pair, rows] : groups) {
      // Ranks of other local problems have only some of the rows.
      if (!localOf_.count(pair.first) && !localOf_.count(pair.second)) continue;
      std::vector<int> places;
      for (const InterfaceRelation* row : rows) places.push_back(row->unknown);
      const Matrix motions = orthonormalBasis(rigidMotionsOf(space_, places, true), kSameMotion);
      double size = 0.0;
      for (const InterfaceRelation* row : rows) size = std::max(size, row->size);
      for (Eigen::Index c = 0; c < motions.cols(); ++c) {
        Side side;
        side.on = pair.first;
        std::map<int, double> masters;
        for (std::size_t r = 0; r < rows.size(); ++r) {
          const double q = motions(static_cast<Eigen::Index>(r), c) * rows[r]->size / size;
          side.entries.emplace_back(rows[r]->unknown, q);
          for (std::size_t k = 0; k < rows[r]->others.size(); ++k) {
            const int place = rows[r]->others[k];
            if (isOn(place, pair.first))  // another component of the same node
              side.entries.emplace_back(place, -q * rows[r]->coefficients[k]);
            else
              masters[place] += q * rows[r]->coefficients[k];
          }
        }
        add(side, masters, places[static_cast<std::size_t>(c)], 0, pair.second);
        sides_.push_back(std::move(side));
      }
    }
  }

  /// Flags the rows of local problems without any group: each becomes a constraint. Their ranks send the flags to the others.
  void findUngrouped(const std::map<std::pair<int, int>, std::vector<const InterfaceRelation*>>& groups) {
    std::set<int> grouped;
    for (const auto& entry : groups) grouped.insert(entry.first.first);
    Matrix flags = Matrix::Zero(space_.overlapSize(), 1);
    for (const auto& [id, relation] : relations_) {
      const std::vector<int>& own = space_.sharers(relation->unknown);
      if (own.size() == 1 && localOf_.count(own[0]) && !grouped.count(own[0])) flags(relation->unknown, 0) = 1.0;
    }
    space_.sum(flags);
    for (int place = 0; place < space_.overlapSize(); ++place) counts_.push_back(flags(place, 0) > 0.0);
  }

  void addPoints() {
    for (const auto& [id, relation] : relations_) {
      if (!alone_[relation->unknown] && !counts_[relation->unknown]) continue;
      Side side;
      side.entries.emplace_back(relation->unknown, 1.0);
      if (!alone_[relation->unknown]) side.on = space_.sharers(relation->unknown)[0];
      std::map<int, double> masters;
      for (std::size_t k = 0; k < relation->others.size(); ++k)
        if (side.on >= 0 && isOn(relation->others[k], side.on))
          side.entries.emplace_back(relation->others[k], -relation->coefficients[k]);
        else
          masters[relation->others[k]] = relation->coefficients[k];
      add(side, masters, relation->unknown, 0, -1);
      sides_.push_back(std::move(side));
    }
  }

  /// Gram-Schmidt in the order of the rows, two passes for accuracy.
  void orthonormalise() {
    std::map<int, std::vector<Functional*>> on;
    for (Functional& functional : functionals_)
      if (localOf_.count(functional.on)) on[functional.on].push_back(&functional);
    int most = 0;
    for (auto& [id, all] : on) {
      std::sort(all.begin(), all.end(), [&](const Functional* a, const Functional* b) {
        return std::make_pair(space_.id(a->row), a->slot) < std::make_pair(space_.id(b->row), b->slot);
      });
      std::vector<int> places;
      for (const Functional* functional : all)
        for (const auto& entry : functional->coefficients) places.push_back(entry.first);
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      Matrix basis(static_cast<int>(places.size()), static_cast<int>(all.size()));
      int count = 0;
      for (Functional* functional : all) {
        Vector left = Vector::Zero(basis.rows());
        for (const auto& [place, value] : functional->coefficients)
          left(std::lower_bound(places.begin(), places.end(), place) - places.begin()) = value;
        const double whole = left.norm();
        std::map<int, double> parts;
        for (int turn = 0; turn < 2; ++turn)
          for (int q = 0; q < count; ++q) {
            const double product = basis.col(q).dot(left);
            if (product == 0.0) continue;
            left -= product * basis.col(q);
            parts[q] += product;
          }
        if (const double rest = left.norm(); rest > kDependent * whole) {
          parts[count] = rest;
          basis.col(count++) = left / rest;
        }
        functional->combined.assign(parts.begin(), parts.end());
      }
      for (int q = 0; q < count; ++q) {
        basisOf_[id].emplace_back();
        for (std::size_t k = 0; k < places.size(); ++k)
          if (const double value = basis(static_cast<int>(k), q); value != 0.0) basisOf_[id].back()[places[k]] = value;
      }
      most = std::max(most, count);
    }
    most_ = largest(*space_.comm(), most);
  }

  static double norm(const std::map<int, double>& values) {
    double sum = 0.0;
    for (const auto& entry : values) sum += entry.second * entry.second;
    return std::sqrt(sum);
  }

  /// Coefficients of a functional are computed on the rank of j and sent to all ranks that have its row.
  void exchange() {
    int slots = 0;
    for (const Functional& functional : functionals_) slots = std::max(slots, functional.slot + 1);
    slots = largest(*space_.comm(), slots);
    std::vector<std::vector<std::pair<int, double>>> told(functionals_.size());
    for (int first = 0; first < slots * most_; first += kColumnsAtOnce) {
      Matrix values = Matrix::Zero(space_.overlapSize(), std::min(kColumnsAtOnce, slots * most_ - first));
      const auto end = static_cast<int>(first + values.cols());
      for (const Functional& functional : functionals_)
        for (const auto& [number, value] : functional.combined)
          if (const int column = functional.slot * most_ + number; first <= column && column < end)
            values(functional.row, column - first) = value;
      space_.sum(values);
      for (std::size_t f = 0; f < functionals_.size(); ++f) {
        const int begin = functionals_[f].slot * most_;
        for (int column = std::max(begin, first); column < std::min(begin + most_, end); ++column)
          if (const double value = values(functionals_[f].row, column - first); value != 0.0) told[f].emplace_back(column - begin, value);
      }
    }
    for (std::size_t f = 0; f < functionals_.size(); ++f) functionals_[f].combined = std::move(told[f]);
  }

  /// Keys beyond those of all unknowns and entities.
  GlobalId keyOf(int id, int number) const {
    return 2 * (space_.map()->getMaxAllGlobalIndex() + 1 + static_cast<GlobalId>(id) * most_ + number);
  }

  void write() {
    // Place -> row of the trace, and unknown divided by trace value there: a pair of two nodes identifies an unknown with another one.
    std::vector<std::map<int, std::pair<int, double>>> positions(space_.locals());
    for (int i = 0; i < space_.locals(); ++i) {
      const std::vector<int>& places = space_.coupling(i).columns();
      for (std::size_t k = 0; k < places.size(); ++k)
        if (const InterfaceRelation* by = space_.relation(places[k]); !by)
          positions[i][places[k]] = {static_cast<int>(k), 1.0};
        else if (by->others.size() == 1)
          positions[i].emplace(by->others[0], std::make_pair(static_cast<int>(k), 1.0 / by->coefficients[0]));
    }
    made_.rows_.resize(space_.locals());
    made_.private_.resize(space_.locals());
    for (const auto& [id, basis] : basisOf_) {
      const int local = localOf_.at(id);
      for (std::size_t q = 0; q < basis.size(); ++q) {
        Row row;
        std::vector<int> places;
        Matrix coefficients(1, static_cast<int>(basis[q].size()));
        for (const auto& [place, value] : basis[q]) {
          const auto [position, over] = positions[local].at(place);
          row.entries.emplace_back(position, value * over);
          coefficients(0, static_cast<int>(places.size())) = value;
          places.push_back(place);
        }
        row.terms = {{keyOf(id, static_cast<int>(q)), 1.0}};
        made_.private_[local].push_back(combinedUnknown(space_, row.terms[0].key, places, coefficients));
        made_.rows_[local].push_back(std::move(row));
      }
    }
    for (const Side& side : sides_) {
      std::vector<PrimalRows::Term> terms;
      for (const auto& [place, value] : side.alone) terms.push_back({aloneKey(space_, place), value});
      for (const int f : side.functionals)
        for (const auto& [number, value] : functionals_[f].combined) terms.push_back({keyOf(functionals_[f].on, number), value});
      if (side.on < 0) {
        made_.instead_[side.entries[0].first] = std::move(terms);
        continue;
      }
      const auto here = localOf_.find(side.on);
      if (here == localOf_.end()) continue;
      Row row;
      std::map<int, double> entries;
      for (const auto& [place, value] : side.entries) entries[place] += value;
      const double size = norm(entries);
      for (const auto& [place, value] : entries) {
        const auto [position, over] = positions[here->second].at(place);
        row.entries.emplace_back(position, value * over / size);
      }
      for (PrimalRows::Term& term : terms) term.coefficient /= size;
      row.terms = std::move(terms);
      made_.rows_[here->second].push_back(std::move(row));
    }
  }

  const InterfaceSpace& space_;
  MortarRows& made_;
  std::vector<char> counts_;                                // true for places of rows that are constraints by themselves
  std::vector<char> alone_;                                 // true for places that are primal alone
  std::map<int, int> localOf_;                              // id -> index among the local problems of this rank
  std::map<GlobalId, const InterfaceRelation*> relations_;  // broken relations, by the unknown that they express
  std::vector<Functional> functionals_;
  std::vector<Side> sides_;
  std::map<int, std::vector<std::map<int, double>>> basisOf_;  // id of j -> orthonormal functionals
  int most_ = 0;                                               // private unknowns of a local problem
};

MortarRows::MortarRows(const InterfaceSpace& space, const InterfaceSpace& broken, const PrimalChoice& choice) {
  Maker(space, broken, choice, *this).make();
}

}  // namespace suture
