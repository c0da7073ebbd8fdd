#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <suture/base/Collective.hpp>
#include <suture/report/ContactFields.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Provenance.hpp>
#include <suture/report/Units.hpp>
#include <suture/report/VtkHdf.hpp>

namespace suture {
namespace {

/// Pairs and points on the axis as plotted; each point on the axis is next to the pair from which it is computed.
struct Drawn {
  std::vector<PairResult> points;
  std::vector<std::vector<GlobalId>> cells;  ///< indices into `points`
};

Drawn drawn(const std::vector<ContactPiece>& pieces, const Solution& solution) {
  std::vector<std::vector<const PairResult*>> beside(solution.pairs.size());  // points on the axis, by pair
  std::size_t next = 0;
  for (const ContactPiece& piece : pieces)
    for (const AxisPoint& point : piece.onAxis)
      if (next < solution.onAxis.size()) beside.at(std::size_t(point.pairs[0])).push_back(&solution.onAxis[next++]);
  Drawn all;
  std::vector<GlobalId> placeOf;
  for (const PairResult& pair : solution.pairs) {
    const std::vector<const PairResult*>& own = beside[placeOf.size()];
    const auto isBefore = [&](const PairResult* point) { return point->arc < pair.arc; };
    for (const PairResult* point : own)
      if (isBefore(point)) all.points.push_back(*point);
    const auto at = GlobalId(all.points.size());
    placeOf.push_back(at);
    all.points.push_back(pair);
    for (const PairResult* point : own)
      if (!isBefore(point)) all.points.push_back(*point);
    for (GlobalId k = 0; k < GlobalId(own.size()); ++k)
      all.cells.push_back(isBefore(own[std::size_t(k)]) ? std::vector<GlobalId>{at - 1, at} : std::vector<GlobalId>{at, at + 1});
  }
  std::vector<char> inCell(all.points.size(), 0);
  for (const std::vector<GlobalId>& cell : all.cells)
    for (const GlobalId at : cell) inCell[std::size_t(at)] = 1;
  for (const ContactPiece& piece : pieces)
    for (const std::vector<int>& cell : piece.cells) {
      all.cells.emplace_back();
      for (const int id : cell) {
        all.cells.back().push_back(placeOf.at(std::size_t(id)));
        inCell[std::size_t(placeOf[std::size_t(id)])] = 1;
      }
    }
  // Isolated pairs need a cell, otherwise they would not be visible.
  for (std::size_t at = 0; at < all.points.size(); ++at)
    if (!inCell[at]) all.cells.push_back({GlobalId(at)});
  std::sort(all.cells.begin(), all.cells.end());
  return all;
}

GridPiece gridOf(const Drawn& drawn) {
  constexpr unsigned char vtkTypes[] = {0, 1, 3, 5, 9};  // by the number of points: vertex, line, triangle, quadrilateral
  GridPiece grid;
  for (const PairResult& point : drawn.points) grid.points.insert(grid.points.end(), point.position.begin(), point.position.end());
  for (const std::vector<GlobalId>& cell : drawn.cells) {
    grid.connectivity.insert(grid.connectivity.end(), cell.begin(), cell.end());
    grid.ends.push_back(GlobalId(grid.connectivity.size()));
    grid.types.push_back(vtkTypes[cell.size()]);
  }
  return grid;
}

template <typename T, typename Take>
std::vector<T> column(const std::vector<PairResult>& pairs, const Take& take) {
  std::vector<T> values;
  for (const PairResult& pair : pairs) values.push_back(T(take(pair)));
  return values;
}

std::vector<double> vectors(const std::vector<PairResult>& pairs, Point PairResult::*member) {
  std::vector<double> values;
  for (const PairResult& pair : pairs) values.insert(values.end(), (pair.*member).begin(), (pair.*member).end());
  return values;
}

/// A vector of each pair divided by its tributary size.
std::vector<double> overSize(const std::vector<PairResult>& pairs, Point PairResult::*member) {
  std::vector<double> values = vectors(pairs, member);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = pairs[i / 3].length > 0.0 ? values[i] / pairs[i / 3].length : 0.0;
  return values;
}

std::vector<double> overSize(const std::vector<PairResult>& pairs, double PairResult::*member) {
  return column<double>(pairs, [&](const PairResult& pair) { return pair.length > 0.0 ? pair.*member / pair.length : 0.0; });
}

void writeFriction(const std::vector<PairResult>& pairs, const Units& units, const std::string& area, VtkHdf& file) {
  file.pointData({"TangentialTraction", 3, units.stress, "tangential " + area + "; on side B, along the axes"},
                 overSize(pairs, &PairResult::tangential));
  file.pointData(
      {"FrictionBound", 1, units.stress, "largest tangential " + area + " that the law allows; 0 where open, glued or unbounded"},
      overSize(pairs, &PairResult::bound));
  file.pointData({"Slip", 3, units.length, "displacement of side A minus that of side B along the sides, in the step; along the axes"},
                 vectors(pairs, &PairResult::slip));
  file.pointData({"Stick", 1, "", "1 sticks, 0 slips, -1 open; 0 for closed pairs without friction"},
                 column<int>(pairs, [](const PairResult& pair) {
                   return pair.state.status == PairStatus::Stick ? 1 : pair.state.closed() ? 0 : -1;
                 }));
  file.pointData({"DissipatedWork", 1, units.stress + " " + units.length, "work of the tangential traction on the slip in the step; >= 0"},
                 overSize(pairs, &PairResult::dissipated));
}

std::string namesOf(const std::vector<ContactPiece>& pieces) {
  nlohmann::json names = nlohmann::json::array();
  for (const ContactPiece& piece : pieces) names.push_back(piece.name);
  return names.dump();
}

}  // namespace

void writeContactFields(const Run& run, const std::string& path) {
  using Pair = PairResult;
  const Units units = unitsOf(*run.scene.parameters);
  Drawn all;  // rank 0 has all pairs
  collectivelyOnRoot(run.comm, "drawing the contact surfaces", [&] { all = drawn(run.pieces, run.solution); });
  const std::vector<Pair>& pairs = all.points;
  const GridPiece grid = gridOf(all);
  VtkHdf file(run.comm, path, {GlobalId(grid.points.size() / 3), GlobalId(grid.types.size()), GlobalId(grid.connectivity.size())});
  collectively(run.comm, "writing " + path, [&] { file.append(grid); });
  const bool hasArea = run.model.axisymmetric || run.model.dimension == 3;
  const std::string area = hasArea ? "force over tributary area" : "force over tributary length",
                    circle = run.model.axisymmetric     ? "of the pair, whole circle"
                             : run.model.dimension == 3 ? "of the pair"
                                                        : "of the pair, per unit thickness in 2D";
  const auto reals = [&](const char* name, const std::string& unit, const std::string& meaning, double Pair::*member) {
    file.pointData({name, 1, unit, meaning}, column<double>(pairs, [&](const Pair& pair) { return pair.*member; }));
  };
  const auto integers = [&](const char* name, const char* meaning, int Pair::*member) {
    file.pointData({name, 1, "", meaning}, column<int>(pairs, [&](const Pair& pair) { return pair.*member; }));
  };
  reals("Gap", units.length, "current gap along the normal; positive where open", &Pair::gap);
  reals("InitialGap", units.length, "gap before deformation; negative: interference", &Pair::initialGap);
  reals("ContactPressure", units.stress, area + "; compression positive", &Pair::pressure);
  reals("ContactForce", units.force, circle + "; compression positive", &Pair::force);
  reals("ArcLength", units.length, "along the side that carries the pairs (A, unless a mortar chose B), from its first node", &Pair::arc);
  file.pointData({"Active", 1, "", "1 closed, 0 open"}, column<unsigned char>(pairs, [](const Pair& pair) { return pair.state.closed(); }));
  file.pointData({"Touching", 1, "", "1 if the gap is zero without force, else 0"},
                 column<unsigned char>(pairs, [](const Pair& pair) { return pair.touching; }));
  file.pointData({"Displacement", 3, units.length, "of the node that carries the pair; x, y, z; along the axes"},
                 vectors(pairs, &Pair::displacement));
  file.pointData({"Normal", 3, "", "unit vector from side A to side B, or into the obstacle"}, vectors(pairs, &Pair::normal));
  std::vector<char> frictional(1, hasFriction(pairs));
  broadcast(run.comm, frictional);
  if (frictional.front()) writeFriction(pairs, units, area, file);
  integers("Pair", "number of the pair, from 0; -1 for a point on the axis, computed from the adjacent pairs", &Pair::id);
  integers("Line", "number of the contact line in the scene, from 0", &Pair::line);
  integers("Piece", "number of the contact piece, from 0; names in /Record/ContactPieces", &Pair::piece);
  writeProvenance(run, file.file());
  file.file().write("/Record/ContactPieces", broadcast(run.comm, namesOf(run.pieces)));
  file.close();
}

}  // namespace suture
