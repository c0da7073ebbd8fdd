#include <suture/precond/EdgeSides.hpp>
#include <suture/precond/PrimalConstraints.hpp>

#include <algorithm>
#include <utility>

namespace suture {

namespace {

// Two primal unknowns may belong to one interface unknown: the corner, and the edge constraint that is numbered after it.
GlobalId cornerKey(const InterfaceSpace& space, int place) { return 2 * space.id(place); }
GlobalId edgeKey(const InterfaceSpace& space, int place) { return 2 * space.id(place) + 1; }

InterfaceLayout::Unknown cornerUnknown(const InterfaceSpace& space, int place) {
  return {cornerKey(space, place), space.point(place), space.direction(place), space.moment(place)};
}

/// A combination of unknowns, as it moves about their centre.
InterfaceLayout::Unknown combined(const InterfaceSpace& space, GlobalId key, const std::vector<int>& places, const Matrix& coefficients) {
  InterfaceLayout::Unknown sum{key, {0, 0, 0}, {0, 0, 0}, 0.0};
  for (const int place : places)
    for (int k = 0; k < 3; ++k) sum.point[k] += space.point(place)[k] / static_cast<double>(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point &p = space.point(places[i]), &d = space.direction(places[i]);
    const double c = coefficients(0, static_cast<int>(i));
    for (int k = 0; k < 3; ++k) sum.direction[k] += c * d[k];
    sum.moment += c * (d[1] * (p[0] - sum.point[0]) - d[0] * (p[1] - sum.point[1]) + space.moment(places[i]));
  }
  return sum;
}

struct Row {
  std::vector<std::pair<int, double>> entries;  // position in the trace, coefficient
  std::vector<PrimalConstraints::Term> terms;
};

}  // namespace

std::vector<PrimalConstraints> primalConstraints(const InterfaceSpace& space, const std::vector<Matrix>& edgeRows) {
  std::vector<std::vector<Row>> rows(space.locals());
  std::vector<std::vector<InterfaceLayout::Unknown>> unknowns(space.locals());
  for (int i = 0; i < space.locals(); ++i) {
    const std::vector<int>& places = space.coupling(i).columns();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const InterfaceRelation* by = space.relation(places[k]);
      const std::size_t count = by ? by->others.size() : 1;
      if (count == 0) {  // held: no value of its own, but the trace is known to be zero
        rows[i].push_back({{{static_cast<int>(k), 1.0}}, {}});
        continue;
      }
      const int first = by ? by->others[0] : places[k];
      if (count == 1 && !space.isCorner(first)) continue;
      Row row{{{static_cast<int>(k), 1.0}}, {}};
      for (std::size_t t = 0; t < count; ++t) {
        const int place = by ? by->others[t] : first;
        row.terms.push_back({cornerKey(space, place), by ? by->coefficients[t] : 1.0});
        unknowns[i].push_back(cornerUnknown(space, place));
      }
      rows[i].push_back(std::move(row));
    }
  }

  for (const EdgeSide& side : edgeSides(space))
    for (int r = 0; r < edgeRows[side.edge].rows(); ++r) {
      Row row;
      for (std::size_t k = 0; k < side.rows.size(); ++k)
        row.entries.emplace_back(side.rows[k], edgeRows[side.edge](r, static_cast<int>(k)) / side.coefficients(static_cast<int>(k)));
      const std::vector<int>& places = space.edges()[side.edge].unknowns;
      row.terms = {{edgeKey(space, places[r]), 1.0}};
      unknowns[side.local].push_back(combined(space, row.terms[0].key, places, edgeRows[side.edge].row(r)));
      rows[side.local].push_back(std::move(row));
    }

  std::vector<PrimalConstraints> all(space.locals());
  for (int i = 0; i < space.locals(); ++i) {
    all[i].rows = Matrix::Zero(static_cast<int>(rows[i].size()), space.coupling(i).rows());
    for (std::size_t r = 0; r < rows[i].size(); ++r) {
      for (const auto& [position, value] : rows[i][r].entries) all[i].rows(static_cast<int>(r), position) = value;
      all[i].terms.push_back(rows[i][r].terms);
    }
    const auto before = [](const InterfaceLayout::Unknown& a, const InterfaceLayout::Unknown& b) { return a.id < b.id; };
    const auto same = [](const InterfaceLayout::Unknown& a, const InterfaceLayout::Unknown& b) { return a.id == b.id; };
    std::stable_sort(unknowns[i].begin(), unknowns[i].end(), before);
    unknowns[i].erase(std::unique(unknowns[i].begin(), unknowns[i].end(), same), unknowns[i].end());
    all[i].unknowns = std::move(unknowns[i]);
  }
  return all;
}

}  // namespace suture
