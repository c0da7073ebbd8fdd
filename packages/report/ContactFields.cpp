#include <Teuchos_Comm.hpp>
#include <Teuchos_RCP.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <suture/base/Collective.hpp>
#include <suture/report/ContactFields.hpp>
#include <suture/report/Provenance.hpp>
#include <suture/report/Units.hpp>
#include <suture/report/VtkHdf.hpp>

namespace suture {
namespace {

constexpr unsigned char vtkVertex = 1, vtkLine = 3;

GridPiece gridOf(const std::vector<PairResult>& pairs) {
  GridPiece grid;
  const auto joined = [&](std::size_t i) {  // pair i and the next
    return i + 1 < pairs.size() && pairs[i].line == pairs[i + 1].line && pairs[i].piece == pairs[i + 1].piece;
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    grid.points.insert(grid.points.end(), pairs[i].position.begin(), pairs[i].position.end());
    // A pair alone would be in no cell and vanish from the picture.
    const bool alone = !joined(i) && (i == 0 || !joined(i - 1));
    if (!joined(i) && !alone) continue;
    grid.connectivity.push_back(GlobalId(i));
    if (!alone) grid.connectivity.push_back(GlobalId(i + 1));
    grid.ends.push_back(GlobalId(grid.connectivity.size()));
    grid.types.push_back(alone ? vtkVertex : vtkLine);
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

/// Points on the axis stand where they are on their line, before or behind the pair beside them.
std::vector<PairResult> withAxis(std::vector<PairResult> pairs, const std::vector<PairResult>& onAxis) {
  for (const PairResult& point : onAxis) {
    const auto nearest = std::min_element(pairs.begin(), pairs.end(), [&](const PairResult& a, const PairResult& b) {
      const auto far = [&](const PairResult& pair) { return pair.line == point.line ? std::abs(pair.arc - point.arc) : HUGE_VAL; };
      return far(a) < far(b);
    });
    pairs.insert(nearest->arc > point.arc ? nearest : nearest + 1, point);
  }
  return pairs;
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
  std::vector<Pair> pairs;  // rank 0 has all of them
  if (run.comm.getRank() == 0) pairs = withAxis(run.solution.pairs, run.solution.onAxis);
  const GridPiece grid = gridOf(pairs);
  VtkHdf file(run.comm, path, {GlobalId(grid.points.size() / 3), GlobalId(grid.types.size()), GlobalId(grid.connectivity.size())});
  collectively(run.comm, "writing " + path, [&] { file.append(grid); });
  const std::string area = run.model.axisymmetric ? "force over tributary area" : "force over tributary length",
                    circle = run.model.axisymmetric ? "of the pair, whole circle" : "of the pair, per unit thickness in 2D";
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
  file.pointData({"Touching", 1, "", "1 without a gap and without force, else 0"},
                 column<unsigned char>(pairs, [](const Pair& pair) { return pair.touching; }));
  file.pointData({"Displacement", 3, units.length, "of the node that carries the pair; x, y, z; along the axes"},
                 vectors(pairs, &Pair::displacement));
  file.pointData({"Normal", 3, "", "unit vector from side A to side B, or into the obstacle"}, vectors(pairs, &Pair::normal));
  integers("Pair", "number of the pair, from 0; -1 of a point on the axis, which follows from the pairs beside it", &Pair::id);
  integers("Line", "number of the contact line in the scene, from 0", &Pair::line);
  integers("Piece", "number of the contact piece, from 0; names in /Record/ContactPieces", &Pair::piece);
  writeProvenance(run, file.file());
  file.file().write("/Record/ContactPieces", broadcast(run.comm, namesOf(run.pieces)));
  file.close();
}

}  // namespace suture
