#include <suture/base/Point.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/MortarRows.hpp>
#include <suture/precond/PrimalRows.hpp>

#include <algorithm>
#include <utility>

namespace suture {

namespace {

// One interface unknown may have two primal unknowns: itself if it is alone, and the row of an entity that is numbered after it.
GlobalId rowKey(const InterfaceSpace& space, int place) { return 2 * space.id(place) + 1; }

InterfaceLayout::Unknown aloneUnknown(const InterfaceSpace& space, int place) {
  return {aloneKey(space, place), space.point(place), space.direction(place), space.moment(place)};
}

struct Row {
  std::vector<std::pair<int, double>> entries;  // position in the trace, coefficient
  std::vector<PrimalRows::Term> terms;
};

/// Sorts the entries.
PrimalRows::Rows sparse(std::vector<Row>& rows, int columns) {
  PrimalRows::Rows made(static_cast<int>(rows.size()), columns);
  std::size_t entries = 0;
  for (const Row& row : rows) entries += row.entries.size();
  made.reserve(static_cast<Eigen::Index>(entries));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::sort(rows[r].entries.begin(), rows[r].entries.end());
    made.startVec(static_cast<int>(r));
    for (const auto& [position, value] : rows[r].entries) made.insertBack(static_cast<int>(r), position) = value;
  }
  made.finalize();
  return made;
}

}  // namespace

GlobalId aloneKey(const InterfaceSpace& space, int place) { return 2 * space.id(place); }

InterfaceLayout::Unknown combinedUnknown(const InterfaceSpace& space, GlobalId key, const std::vector<int>& places,
                                         const Matrix& coefficients) {
  InterfaceLayout::Unknown sum{key, {0, 0, 0}, {0, 0, 0}};
  for (const int place : places)
    for (int k = 0; k < 3; ++k) sum.point[k] += space.point(place)[k] / static_cast<double>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point& d = space.direction(places[i]);
    const Point turned = plus(cross(minus(space.point(places[i]), sum.point), d), space.moment(places[i]));
    const double c = coefficients(0, static_cast<int>(i));
    for (int k = 0; k < 3; ++k) {
      sum.direction[k] += c * d[k];
      sum.moment[k] += c * turned[k];
    }
  }
  return sum;
}

std::vector<int> rowsIn(const PrimalRows::Rows& old, const PrimalRows::Rows& now) {
  const auto same = [&](int a, int b) {
    const int begin = old.outerIndexPtr()[a], end = old.outerIndexPtr()[a + 1], other = now.outerIndexPtr()[b];
    return now.outerIndexPtr()[b + 1] - other == end - begin &&
           std::equal(old.innerIndexPtr() + begin, old.innerIndexPtr() + end, now.innerIndexPtr() + other) &&
           std::equal(old.valuePtr() + begin, old.valuePtr() + end, now.valuePtr() + other);
  };
  std::vector<int> from(now.rows(), -1);
  std::vector<char> taken(old.rows(), 0);
  for (int row = 0; row < now.rows(); ++row)
    for (int k = 0; k < old.rows() && from[row] < 0; ++k)
      if (!taken[k] && same(k, row)) {
        from[row] = k;
        taken[k] = 1;
      }
  return from;
}

std::vector<PrimalRows> primalRows(const InterfaceSpace& space, const PrimalChoice& choice, bool withUnknowns, const MortarRows* mortar) {
  std::vector<std::vector<Row>> rows(space.locals());
  std::vector<std::vector<InterfaceLayout::Unknown>> unknowns(space.locals());
  for (int i = 0; i < space.locals(); ++i) {
    const std::vector<int>& places = space.coupling(i).columns();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const InterfaceRelation* by = space.relation(places[k]);
      const std::size_t count = by ? by->others.size() : 1;
      if (count == 0) {  // fixed: no primal unknown, the trace is zero
        rows[i].push_back({{{static_cast<int>(k), 1.0}}, {}});
        continue;
      }
      const int first = by ? by->others[0] : places[k];
      if (count == 1 && !choice.alone[first]) {
        // Two unknowns of one local problem (a node that slides along an oblique obstacle): a row couples them.
        if (const auto own = by ? std::find(places.begin(), places.end(), first) : places.end(); own != places.end())
          rows[i].push_back({{{static_cast<int>(k), 1.0}, {static_cast<int>(own - places.begin()), -by->coefficients[0]}}, {}});
        continue;
      }
      Row row{{{static_cast<int>(k), 1.0}}, {}};
      if (const auto* instead = mortar ? mortar->instead(first) : nullptr) {
        row.terms = *instead;
        for (PrimalRows::Term& term : row.terms) term.coefficient *= by ? by->coefficients[0] : 1.0;
        rows[i].push_back(std::move(row));
        continue;
      }
      for (std::size_t t = 0; t < count; ++t) {
        const int place = by ? by->others[t] : first;
        row.terms.push_back({aloneKey(space, place), by ? by->coefficients[t] : 1.0});
        if (withUnknowns) unknowns[i].push_back(aloneUnknown(space, place));
      }
      rows[i].push_back(std::move(row));
    }
  }

  const std::vector<InterfaceEntity> entities = withoutAlone(space, choice.alone);
  for (const EntitySide& side : entitySides(space, entities))
    for (int r = 0; r < choice.rows[side.entity].rows(); ++r) {
      Row row;
      for (std::size_t k = 0; k < side.rows.size(); ++k)
        row.entries.emplace_back(side.rows[k], choice.rows[side.entity](r, static_cast<int>(k)) / side.coefficients(static_cast<int>(k)));
      const std::vector<int>& places = entities[side.entity].unknowns;
      row.terms = {{rowKey(space, places[r]), 1.0}};
      if (withUnknowns) unknowns[side.local].push_back(combinedUnknown(space, row.terms[0].key, places, choice.rows[side.entity].row(r)));
      rows[side.local].push_back(std::move(row));
    }

  std::vector<PrimalRows> all(space.locals());
  for (int i = 0; i < space.locals(); ++i) {
    if (mortar) {
      for (const MortarRows::Row& row : mortar->of(i)) rows[i].push_back({row.entries, row.terms});
      if (withUnknowns) unknowns[i].insert(unknowns[i].end(), mortar->privateOf(i).begin(), mortar->privateOf(i).end());
    }
    all[i].rows = sparse(rows[i], space.coupling(i).rows());
    for (Row& row : rows[i]) all[i].terms.push_back(std::move(row.terms));
    const auto before = [](const InterfaceLayout::Unknown& a, const InterfaceLayout::Unknown& b) { return a.id < b.id; };
    const auto same = [](const InterfaceLayout::Unknown& a, const InterfaceLayout::Unknown& b) { return a.id == b.id; };
    std::stable_sort(unknowns[i].begin(), unknowns[i].end(), before);
    unknowns[i].erase(std::unique(unknowns[i].begin(), unknowns[i].end(), same), unknowns[i].end());
    all[i].unknowns = std::move(unknowns[i]);
  }
  return all;
}

}  // namespace suture
