#include <suture/precond/PrimalConstraints.hpp>

#include <map>

namespace suture {

namespace {

// Two primal unknowns may belong to one interface unknown: the corner, and the edge constraint that is numbered after it.
GlobalId cornerKey(const InterfaceSpace& space, int place) { return 2 * space.id(place); }
GlobalId edgeKey(const InterfaceSpace& space, int place) { return 2 * space.id(place) + 1; }

struct Row {
  std::map<int, double> entries;  // position in the trace -> coefficient
  std::vector<PrimalConstraints::Term> terms;
};

}  // namespace

std::vector<PrimalConstraints> primalConstraints(const InterfaceSpace& space, const std::vector<Matrix>& edgeRows) {
  std::map<int, int> localOf;  // id -> local problem of this rank
  for (int i = 0; i < space.locals(); ++i) localOf[space.localId(i)] = i;
  std::vector<std::vector<Row>> rows(space.locals());
  // Where an edge's unknowns stand in the trace of either side; unknowns of edges only.
  struct Position {
    int row;
    double coefficient;  // the trace is this times the unknown
  };
  std::vector<std::map<int, Position>> positions(space.locals());

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
      const double coefficient = by ? by->coefficients[0] : 1.0;
      if (count > 1 || space.isCorner(first)) {
        Row row{{{static_cast<int>(k), 1.0}}, {}};
        for (std::size_t t = 0; t < count; ++t)
          row.terms.push_back({cornerKey(space, by ? by->others[t] : first), by ? by->coefficients[t] : 1.0});
        rows[i].push_back(std::move(row));
      } else {
        positions[i][first] = {static_cast<int>(k), coefficient};
      }
    }
  }

  for (std::size_t e = 0; e < edgeRows.size(); ++e) {
    const InterfaceEdge& edge = space.edges()[e];
    for (const int id : edge.locals) {
      const auto here = localOf.find(id);
      if (here == localOf.end()) continue;
      for (int r = 0; r < edgeRows[e].rows(); ++r) {
        Row row;
        for (std::size_t k = 0; k < edge.unknowns.size(); ++k) {
          const Position& at = positions[here->second].at(edge.unknowns[k]);
          row.entries[at.row] = edgeRows[e](r, static_cast<int>(k)) / at.coefficient;
        }
        row.terms = {{edgeKey(space, edge.unknowns[r]), 1.0}};
        rows[here->second].push_back(std::move(row));
      }
    }
  }

  std::vector<PrimalConstraints> all(space.locals());
  for (int i = 0; i < space.locals(); ++i) {
    all[i].rows = Matrix::Zero(static_cast<int>(rows[i].size()), space.coupling(i).rows());
    for (std::size_t r = 0; r < rows[i].size(); ++r) {
      for (const auto& [position, value] : rows[i][r].entries) all[i].rows(static_cast<int>(r), position) = value;
      all[i].terms.push_back(rows[i][r].terms);
    }
  }
  return all;
}

}  // namespace suture
