#include <Teuchos_CommHelpers.hpp>
#include <suture/answer/values/SingularExtremes.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/report/answers/SingularNotes.hpp>

namespace suture {

std::vector<std::string> singularNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                       const Solution& solution) {
  const std::map<std::string, std::string> found = singularExtremes(comm, meshes, model, solution, {"von_mises", "pressure"});
  int mine = 0, dimension = 0;
  for (const SubdomainMesh& mesh : meshes) mine = mesh.dimension;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(dimension));
  Point pressed{0, 0, 0};  // on rank 0
  if (const PairResult* pair = comm.getRank() == 0 ? largestPressure(solution) : nullptr) pressed = pair->position;
  std::vector<std::string> notes;
  for (const auto& [key, name] : {std::pair<const char*, const char*>{"von_mises", "von Mises stress"}, {"pressure", "pressure"}}) {
    const auto reason = found.find(key);
    if (reason == found.end()) continue;
    const Point& place = reason->first == "pressure" ? pressed : solution.extremes.vonMises.place;
    notes.push_back(broadcast(comm, std::string("the largest ") + name + " is at " + placeText(place, dimension) + ", " + reason->second +
                                        ": the exact value there is unbounded, and the computed value grows with mesh refinement"));
  }
  return notes;
}

}  // namespace suture
