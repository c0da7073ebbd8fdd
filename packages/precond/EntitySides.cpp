#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/EntitySides.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

namespace {

using GO = Map::global_ordinal_type;

/// Rank of each local problem that shares an entity.
std::map<int, int> ranksOfSharers(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities) {
  std::vector<GO> mine, wanted;
  for (int i = 0; i < space.locals(); ++i) mine.push_back(space.localId(i));
  for (const InterfaceEntity& entity : entities)
    if (!entity.unknowns.empty()) wanted.insert(wanted.end(), entity.sharers.begin(), entity.sharers.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  const Map owners(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), Teuchos::ArrayView<const GO>(mine.data(), mine.size()), 0,
                   space.comm());
  std::vector<int> ranks(wanted.size());
  owners.getRemoteIndexList(Teuchos::ArrayView<const GO>(wanted.data(), wanted.size()),
                            Teuchos::ArrayView<int>(ranks.data(), ranks.size()));
  std::map<int, int> all;
  for (std::size_t k = 0; k < wanted.size(); ++k) all[static_cast<int>(wanted[k])] = ranks[k];
  return all;
}

/// Trace rows of interface unknowns in one local problem.
class Positions {
 public:
  struct Position {
    int row;
    double coefficient;
  };
  explicit Positions(const InterfaceSpace& space) : space_(space), positions_(space.overlapSize(), Position{-1, 0.0}) {}

  void setLocal(int local) {
    for (const int place : set_) positions_[place].row = -1;
    set_.clear();
    const std::vector<int>& places = space_.coupling(local).columns();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const InterfaceRelation* by = space_.relation(places[k]);
      if (by && by->others.size() != 1) continue;
      set_.push_back(by ? by->others[0] : places[k]);
      positions_[set_.back()] = {static_cast<int>(k), by ? by->coefficients[0] : 1.0};
    }
  }
  const Position& at(int place) const { return positions_[place]; }
  const std::vector<int>& places() const { return set_; }

 private:
  const InterfaceSpace& space_;
  std::vector<Position> positions_;
  std::vector<int> set_;
};

}  // namespace

std::vector<InterfaceEntity> withoutAlone(const InterfaceSpace& space, const std::vector<char>& alone) {
  std::vector<InterfaceEntity> rest;
  for (const InterfaceEntity& entity : space.entities()) {
    rest.push_back({entity.kind, entity.sharers, {}, {}, entity.contact});
    for (const int place : entity.unknowns)
      if (!alone[place]) rest.back().unknowns.push_back(place);
  }
  return rest;
}

std::vector<EntitySide> entitySides(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities) {
  std::map<int, int> localOf;
  for (int i = 0; i < space.locals(); ++i) localOf[space.localId(i)] = i;
  struct Number {
    int entity, side;
    std::size_t place;  // index among all sides
  };
  std::vector<std::vector<Number>> sidesOf(space.locals());
  std::size_t count = 0;
  for (std::size_t e = 0; e < entities.size(); ++e)
    for (std::size_t side = 0; side < entities[e].sharers.size() && !entities[e].unknowns.empty(); ++side)
      if (const auto here = localOf.find(entities[e].sharers[side]); here != localOf.end())
        sidesOf[here->second].push_back({static_cast<int>(e), static_cast<int>(side), count++});

  Positions positions(space);
  std::vector<EntitySide> sides(count);
  for (int i = 0; i < space.locals(); ++i) {
    if (sidesOf[i].empty()) continue;
    positions.setLocal(i);
    for (const Number& number : sidesOf[i]) {
      const std::vector<int>& unknowns = entities[number.entity].unknowns;
      EntitySide own{number.entity, number.side, i, {}, Vector(static_cast<int>(unknowns.size()))};
      for (const int place : unknowns) {
        own.coefficients(static_cast<int>(own.rows.size())) = positions.at(place).coefficient;
        own.rows.push_back(positions.at(place).row);
      }
      sides[number.place] = std::move(own);
    }
  }
  return sides;
}

std::vector<AloneRows> aloneRows(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities,
                                 const std::vector<EntitySide>& sides, const std::vector<char>& alone) {
  std::vector<AloneRows> all(sides.size());
  Positions positions(space);
  for (int i = 0; i < space.locals(); ++i) {
    positions.setLocal(i);
    std::vector<int> points;  // ascending, hence ids ascend, too
    for (const int place : positions.places())
      if (alone[place]) points.push_back(place);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (std::size_t k = 0; k < sides.size(); ++k) {
      if (sides[k].local != i) continue;
      const std::vector<int>& sharers = entities[sides[k].entity].sharers;
      std::vector<double> coefficients;
      for (const int place : points)
        if (std::includes(space.sharers(place).begin(), space.sharers(place).end(), sharers.begin(), sharers.end())) {
          all[k].rows.push_back(positions.at(place).row);
          all[k].ids.push_back(space.id(place));
          coefficients.push_back(positions.at(place).coefficient);
        }
      all[k].coefficients = Eigen::Map<const Vector>(coefficients.data(), static_cast<int>(coefficients.size()));
    }
  }
  const auto ids = exchangeSides(space, entities, sides, [&](std::size_t k) {
    Matrix own(static_cast<int>(all[k].ids.size()), 1);
    for (int row = 0; row < own.rows(); ++row) own(row, 0) = static_cast<double>(all[k].ids[row]);
    return own;
  });
  for (std::size_t k = 0; k < sides.size(); ++k) {
    AloneRows kept;
    std::vector<double> coefficients;
    for (std::size_t row = 0; row < all[k].ids.size(); ++row) {
      const auto has = [&](const Matrix& other) {
        return other.size() > 0 && (other.array() == static_cast<double>(all[k].ids[row])).any();
      };
      const std::vector<Matrix>& own = ids[sides[k].entity];
      if (!std::all_of(own.begin(), own.end(), has)) continue;
      kept.rows.push_back(all[k].rows[row]);
      kept.ids.push_back(all[k].ids[row]);
      coefficients.push_back(all[k].coefficients(static_cast<int>(row)));
    }
    kept.coefficients = Eigen::Map<const Vector>(coefficients.data(), static_cast<int>(coefficients.size()));
    all[k] = std::move(kept);
  }
  return all;
}

std::vector<std::vector<Matrix>> exchangeSides(const InterfaceSpace& space, const std::vector<InterfaceEntity>& entities,
                                               const std::vector<EntitySide>& sides, const std::function<Matrix(std::size_t)>& own) {
  const std::map<int, int> rankOf = ranksOfSharers(space, entities);
  const int here = space.comm()->getRank();
  std::vector<std::vector<Matrix>> all(entities.size());
  std::vector<int> touched;
  for (std::size_t e = 0; e < entities.size(); ++e) {
    all[e].resize(entities[e].sharers.size());
    if (!entities[e].unknowns.empty()) touched.push_back(static_cast<int>(e));
  }
  std::map<int, Packer> packers;
  std::map<int, std::vector<std::pair<int, int>>> expected;  // rank -> (entity, side) in the order of the message
  collectively(*space.comm(), "exchanging the sides of the entities", [&] {
    for (std::size_t k = 0; k < sides.size(); ++k) all[sides[k].entity][sides[k].side] = own(k);
    // Both ranks process their common entities in the same order: by the id of the first unknown.
    const auto number = [&](int e) { return space.id(entities[e].unknowns.front()); };
    std::sort(touched.begin(), touched.end(), [&](int a, int b) { return number(a) < number(b); });
    for (const int e : touched) {
      std::set<int> others;
      for (const int sharer : entities[e].sharers) others.insert(rankOf.at(sharer));
      if (others.erase(here) == 0) continue;  // known only from its place on a contact line
      for (std::size_t side = 0; side < entities[e].sharers.size(); ++side) {
        const int rank = rankOf.at(entities[e].sharers[side]);
        if (rank != here) {
          expected[rank].emplace_back(e, static_cast<int>(side));
          continue;
        }
        const Matrix& matrix = all[e][side];
        for (const int other : others) {
          packers[other].put(static_cast<int>(matrix.rows()));
          packers[other].put(std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
        }
      }
    }
  });
  std::map<int, std::string> messages;
  for (const auto& [rank, packer] : packers) messages[rank] = packer.bytes();
  for (auto& [rank, bytes] : swapWithNeighbours(*space.comm(), messages)) {
    Unpacker unpacker(bytes);
    for (const auto& [entity, side] : expected[rank]) {
      const int rows = unpacker.get<int>();
      const auto values = unpacker.get<std::vector<double>>();
      const Eigen::Index columns = rows > 0 ? static_cast<Eigen::Index>(values.size()) / rows : 0;
      all[entity][side] = Eigen::Map<const Matrix>(values.data(), rows, columns);
    }
  }
  return all;
}

}  // namespace suture
