#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/EdgeSides.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

using GO = Map::global_ordinal_type;

/// Rank of each local problem that edges of this rank name.
std::map<int, int> ranksOfNeighbours(const InterfaceSpace& space) {
  std::vector<GO> mine, wanted;
  for (int i = 0; i < space.locals(); ++i) mine.push_back(space.localId(i));
  for (const InterfaceEdge& edge : space.edges()) wanted.insert(wanted.end(), edge.locals.begin(), edge.locals.end());
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

}  // namespace

std::vector<EdgeSide> edgeSides(const InterfaceSpace& space) {
  std::map<int, int> localOf;
  for (int i = 0; i < space.locals(); ++i) localOf[space.localId(i)] = i;
  struct Number {
    int edge, side;
    std::size_t place;  // among all sides
  };
  std::vector<std::vector<Number>> sidesOf(space.locals());
  std::size_t count = 0;
  for (std::size_t e = 0; e < space.edges().size(); ++e)
    for (int side = 0; side < 2; ++side)
      if (const auto here = localOf.find(space.edges()[e].locals[side]); here != localOf.end())
        sidesOf[here->second].push_back({static_cast<int>(e), side, count++});

  // Position of an interface unknown in the trace of the local problem at hand: read only where that has written it.
  struct Position {
    int row;
    double coefficient;
  };
  std::vector<Position> positions(space.overlapSize());
  std::vector<EdgeSide> sides(count);
  for (int i = 0; i < space.locals(); ++i) {
    const std::vector<int>& places = space.coupling(i).columns();
    std::vector<int> corners;  // ascending, and so are ids
    for (std::size_t k = 0; k < places.size(); ++k) {
      const InterfaceRelation* by = space.relation(places[k]);
      if (by && by->others.size() != 1) continue;
      const int place = by ? by->others[0] : places[k];
      positions[place] = {static_cast<int>(k), by ? by->coefficients[0] : 1.0};
      if (space.isCorner(place)) corners.push_back(place);
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    for (const Number& number : sidesOf[i]) {
      const InterfaceEdge& edge = space.edges()[number.edge];
      EdgeSide own{number.edge, number.side, i, {}, Vector(static_cast<int>(edge.unknowns.size())), {}, {}, {}};
      for (const int place : edge.unknowns) {
        own.coefficients(static_cast<int>(own.rows.size())) = positions[place].coefficient;
        own.rows.push_back(positions[place].row);
      }
      std::vector<double> coefficients;
      for (const int place : corners)  // locals of an edge ascend, as sharers do
        if (std::includes(space.sharers(place).begin(), space.sharers(place).end(), edge.locals.begin(), edge.locals.end())) {
          own.cornerRows.push_back(positions[place].row);
          own.cornerIds.push_back(space.id(place));
          coefficients.push_back(positions[place].coefficient);
        }
      own.cornerCoefficients = Eigen::Map<const Vector>(coefficients.data(), static_cast<int>(coefficients.size()));
      sides[number.place] = std::move(own);
    }
  }
  return sides;
}

void keepCommonCorners(const InterfaceSpace& space, std::vector<EdgeSide>& sides) {
  const auto ids = exchangeEdges(space, sides, [](const EdgeSide& side) {
    Matrix own(static_cast<int>(side.cornerIds.size()), 1);
    for (int k = 0; k < own.rows(); ++k) own(k, 0) = static_cast<double>(side.cornerIds[k]);
    return own;
  });
  for (EdgeSide& side : sides) {
    const Matrix& others = ids[side.edge][1 - side.side];
    EdgeSide kept = side;
    kept.cornerRows.clear();
    kept.cornerIds.clear();
    std::vector<double> coefficients;
    for (std::size_t k = 0; k < side.cornerIds.size(); ++k) {
      if (others.size() == 0 || !(others.array() == static_cast<double>(side.cornerIds[k])).any()) continue;
      kept.cornerRows.push_back(side.cornerRows[k]);
      kept.cornerIds.push_back(side.cornerIds[k]);
      coefficients.push_back(side.cornerCoefficients(static_cast<int>(k)));
    }
    kept.cornerCoefficients = Eigen::Map<const Vector>(coefficients.data(), static_cast<int>(coefficients.size()));
    side = std::move(kept);
  }
}

std::vector<std::array<Matrix, 2>> exchangeEdges(const InterfaceSpace& space, const std::vector<EdgeSide>& sides,
                                                 const std::function<Matrix(const EdgeSide&)>& own) {
  const std::map<int, int> rankOf = ranksOfNeighbours(space);
  const int here = space.comm()->getRank();
  std::vector<std::array<Matrix, 2>> all(space.edges().size());
  // Neighbours go through the edges that they share in the same order: by the number of their first unknown.
  const auto number = [&](int edge) { return space.id(space.edges()[edge].unknowns.front()); };
  std::vector<const EdgeSide*> order;
  for (const EdgeSide& side : sides) order.push_back(&side);
  std::sort(order.begin(), order.end(), [&](const EdgeSide* a, const EdgeSide* b) { return number(a->edge) < number(b->edge); });
  std::map<int, Packer> packers;
  std::map<int, std::vector<const EdgeSide*>> expected;
  collectively(*space.comm(), "the two sides of the edges", [&] {
    for (const EdgeSide* side : order) {
      Matrix& matrix = all[side->edge][side->side];
      matrix = own(*side);
      const int other = rankOf.at(space.edges()[side->edge].locals[1 - side->side]);
      if (other == here) continue;
      packers[other].put(static_cast<int>(matrix.rows()));
      packers[other].put(std::vector<double>(matrix.data(), matrix.data() + matrix.size()));
      expected[other].push_back(side);
    }
  });
  std::map<int, std::string> messages;
  for (const auto& [rank, packer] : packers) messages[rank] = packer.bytes();
  for (auto& [rank, bytes] : swapWithNeighbours(*space.comm(), messages)) {
    Unpacker unpacker(bytes);
    for (const EdgeSide* side : expected[rank]) {
      const int rows = unpacker.get<int>();
      const auto values = unpacker.get<std::vector<double>>();
      const Eigen::Index columns = rows > 0 ? static_cast<Eigen::Index>(values.size()) / rows : 0;
      all[side->edge][1 - side->side] = Eigen::Map<const Matrix>(values.data(), rows, columns);
    }
  }
  return all;
}

}  // namespace suture
