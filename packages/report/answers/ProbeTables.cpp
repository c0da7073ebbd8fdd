#include <suture/base/Point.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/ProbeValues.hpp>
#include <suture/report/answers/Tables.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace suture {

namespace {

std::string textOf(const Run& run, const std::vector<ProbeValue>& rows) {
  std::string text = "arc_length,x,y,z,body,ux,uy,uz,sxx,syy,szz,sxy,syz,sxz,von_mises,principal_1,principal_3,gap,pressure\n";
  double place = 0.0, displacement = 0.0, largest = 0.0, gap = 0.0, pressure = 0.0;  // largest value of each kind
  for (const ProbeValue& row : rows) {
    place = std::max({place, norm(row.place), row.arc});
    displacement = std::max(displacement, norm(row.displacement));
    for (const double one : row.stress) largest = std::max(largest, std::abs(one));
  }
  for (const PairResult& pair : run.solution.pairs) {
    gap = std::max({gap, std::abs(pair.gap), std::abs(pair.initialGap), norm(pair.displacement)});
    pressure = std::max(pressure, std::abs(pair.pressure));
  }
  for (const ProbeValue& row : rows) {
    const PrincipalExtremes invariants = principalExtremes(row, run.model.dimension);
    text += csvNumber(row.arc, place).substr(1);
    for (const double one : row.place) text += csvNumber(one, place);
    text += "," + csvField(bodyName(run, row.body));
    for (const double one : row.displacement) text += csvNumber(one, displacement);
    for (const double one : row.stress) text += csvNumber(one, largest);
    for (const double one : {invariants.vonMises, invariants.largest, invariants.smallest}) text += csvNumber(one, largest);
    text += std::isnan(row.gap) ? ",,\n" : csvNumber(row.gap, gap) + csvNumber(row.pressure, pressure) + "\n";
  }
  return text;
}

}  // namespace

void writeProbes(const Run& run, const std::vector<Probe>& probes, const std::string& folder) {
  const std::vector<std::vector<ProbeValue>> values = probeValues(run, probes, run.solution.nodalStresses);
  collectivelyOnRoot(run.comm, "writing probes", [&] {
    for (std::size_t p = 0; p < probes.size(); ++p)
      writeTextFile((std::filesystem::path(folder) / probes[p].fileName()).string(), textOf(run, values[p]));
  });
}

}  // namespace suture
