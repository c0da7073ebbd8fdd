#include "NestedLevels.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/solver/NestedStart.hpp>

#include "Overrides.hpp"
#include "SolveStages.hpp"

namespace suture {

namespace {

/// "Path=value; Path=value" of one level.
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

CoarseAnswer solveLevel(const CommPtr& comm, const SceneFile& file, const CoarseAnswer* coarser, Monitor& monitor) {
  const Parameters& scene = *file.parameters;
  CoarseAnswer answer;
  const ElasticModel model = makeElasticModel(scene);
  Partition partition;
  ProblemSize size;
  {
    const Mesh mesh = meshStage(*comm, file);
    Constraints constraints = constraintsStage(*comm, mesh, scene);
    partition = makePartition(*comm, mesh, constraints, scene.sublist("Partition"), isCondensed(scene));
    answer.meshes = distribute(*comm, mesh, constraints, partition);
    partition.share.reset();
    elementsStage(*comm, answer.meshes, model);
    solvabilityStage(*comm, mesh, constraints, model, partition);
    size = problemSize(*comm, mesh, constraints, partition);
    takeOutLift(*comm, model, answer.meshes, constraints);
  }
  const Subdomains subdomains = makeSubdomains(*comm, answer.meshes, model, scene);
  const auto problem = makeInterfaceProblem(comm, partition, subdomains, scene);
  std::unique_ptr<InterfaceState> start;
  if (coarser) start = std::make_unique<InterfaceState>(nestedStart(*comm, *coarser, *problem, subdomains));
  Monitor silent;
  const auto discretisationError = discretisationErrorOf(*comm, answer.meshes, model, subdomains);
  const OuterResult result = solveInterface(*problem, scene, silent, start.get(), discretisationError);
  answer.solution = recover(*comm, *problem, result, subdomains, scene);
  if (!answer.solution.converged)
    throw NumericalError("nested start, level of " + std::to_string(size.elements) + " elements: " + answer.solution.failure);
  monitor.note("nested start: " + std::to_string(size.elements) + " elements, " + std::to_string(answer.solution.outerIterations) +
               " outer, " + std::to_string(answer.solution.pcgTotal) + " + " + std::to_string(answer.solution.auxiliary.pcg) + " PCG");
  return answer;
}

}  // namespace

std::unique_ptr<InterfaceState> nestedStartStage(const CommPtr& comm, const SolveOptions& options, const Parameters& scene,
                                                 const InterfaceProblem& problem, const Subdomains& subdomains, Monitor& monitor) {
  const Parameters& own = scene.sublist("Outer Solver");
  if (own.get<std::string>("Start") != "Nested" || problem.pairs() == 0) return nullptr;
  std::vector<SceneFile> levels;
  for (const std::string& level : own.sublist("Nested").get<Teuchos::Array<std::string>>("Levels")) {
    std::vector<std::string> overrides = options.overrides;
    setOverride(overrides, "Outer Solver/Start=Bilateral");
    for (const std::string& one : overridesOf(level)) setOverride(overrides, one);
    levels.push_back(readScene(*comm, options.scene, sceneSchema(), overrides));
  }
  std::unique_ptr<CoarseAnswer> answer;
  for (const SceneFile& level : levels) answer = std::make_unique<CoarseAnswer>(solveLevel(comm, level, answer.get(), monitor));
  return answer ? std::make_unique<InterfaceState>(nestedStart(*comm, *answer, problem, subdomains)) : nullptr;
}

}  // namespace suture
