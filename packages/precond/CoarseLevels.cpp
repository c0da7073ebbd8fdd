#include <suture/precond/CoarseLevels.hpp>
#include <suture/precond/CoarseSystem.hpp>
#include <suture/precond/SecondLevel.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

void CoarseLevels::addParameters(Schema& schema) {
  const CoarseLevels defaults;
  addCoarseParameters(schema);
  schema.integer("Coarse Level Above", defaults.above,
                 "With more local problems than this the coarse problem is not factored but solved by BDDC on clusters of them; 0: always.",
                 Range::atLeast(0));
  schema.wordOrNumber("Coarse Clusters", "Automatic", {"Automatic"}, Range::atLeast(1),
                      "Clusters of that level. Automatic: the square root of the number of local problems, at least one for each rank.");
  schema.real(
      "Coarse Accuracy", defaults.accuracy,
      "Of that level's solution; decides how many steps it makes. The coarse solution is within this part of the exact one, in energy.",
      Range{1e-12, 0.9, false, false, {}});
}

CoarseLevels CoarseLevels::from(const Parameters& own) {
  CoarseLevels levels;
  levels.solver = [own] { return makeStrategy<LocalSolver>(own, "Coarse Solver"); };
  levels.copies = own.get<int>("Coarse Copies");
  levels.above = own.get<int>("Coarse Level Above");
  const auto clusters = own.get<std::string>("Coarse Clusters");
  levels.clusters = clusters == "Automatic" ? 0 : std::stoi(clusters);
  levels.accuracy = own.get<double>("Coarse Accuracy");
  return levels;
}

std::unique_ptr<CoarseSolve> makeCoarseSolve(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseLevels& levels) {
  if (levels.goesOn(locals)) return std::make_unique<SecondLevel>(comm, coarse, locals, levels);
  return std::make_unique<CoarseSystem>(comm, coarse.size, std::move(coarse.elements), levels.solver(), levels.copies, false);
}

}  // namespace suture
