#include <suture/base/Errors.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/NestedLevels.hpp>
#include <suture/simulation/Overrides.hpp>
#include <suture/simulation/Stages.hpp>
#include <suture/solver/nested/NestedStart.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

/// The overrides "Path=value; Path=value" of one level.
std::vector<std::string> overridesOf(const std::string& level) {
  std::vector<std::string> all;
  std::size_t begin = 0;
  while (begin < level.size()) {
    const std::size_t end = std::min(level.find(';', begin), level.size());
    std::string one = level.substr(begin, end - begin);
    one.erase(0, one.find_first_not_of(" \t\n"));
    one.erase(one.find_last_not_of(" \t\n") + 1);
    if (!one.empty()) all.push_back(one);
    begin = end + 1;
  }
  return all;
}

CoarseAnswer solveLevel(const CommPtr& comm, const Scene& level, const CoarseAnswer* coarser, Monitor& monitor) {
  PreparedScene prepared = prepare(check(cut(read(RunContext(comm), level))));
  if (coarser) prepared.startFrom(nestedStart(*comm, *coarser, prepared.meshes()));
  const SolvedScene solved = solve(std::move(prepared));
  const Solution& solution = solved.solution();
  const std::string elements = counted(solved.size().elements, "element");
  if (!solution.converged) throw NumericalError("nested start, level of " + elements + ": " + solution.failure);
  monitor.note("nested start: " + elements + ", " + std::to_string(solution.iterations) + " outer, " + std::to_string(solution.pcgTotal) +
               " + " + std::to_string(solution.auxiliary.pcg) + " PCG");
  return {solved.meshes(), solution};
}

}  // namespace

std::vector<SceneFile> nestedLevels(const SceneFile& file) {
  std::vector<SceneFile> levels;
  const Parameters& outer = file.parameters->sublist("Outer Solver");
  if (outer.get<std::string>("Start") != "Nested") return levels;
  for (const std::string& level : outer.sublist("Nested").get<Teuchos::Array<std::string>>("Levels")) {
    std::vector<std::string> overrides = file.overrides;
    setOverride(overrides, "Outer Solver/Start=Bilateral");
    for (const std::string& one : overridesOf(level)) setOverride(overrides, one);
    levels.push_back(parseScene(file.text, file.path, sceneSchema(), overrides, file.folder, file.included));
  }
  return levels;
}

Start startFromLevels(const CommPtr& comm, const Scene& scene, const std::vector<SubdomainMesh>& meshes, Monitor& monitor) {
  std::unique_ptr<CoarseAnswer> answer;
  for (const Scene& level : scene.levels) answer = std::make_unique<CoarseAnswer>(solveLevel(comm, level, answer.get(), monitor));
  return nestedStart(*comm, *answer, meshes);
}

}  // namespace suture
