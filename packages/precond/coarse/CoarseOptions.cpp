#include <suture/precond/coarse/ClusterCoarse.hpp>
#include <suture/precond/coarse/CoarseOptions.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

void CoarseOptions::addParameters(Schema& schema) {
  const CoarseOptions defaults;
  schema.choice("Weighting", "Stiffness Diagonal", Registry<Weighting>::instance().schemas(), "How subdomains share the interface, D_i.");
  schema.choice("Edge Constraints", "Automatic", Registry<PrimalConstraints>::instance().schemas(),
                "Constraints that subdomains share on an edge, beside its end points, and in space on a face.");
  addCoarseParameters(schema);
  schema.integer(
      "Coarse Level Above", defaults.above,
      "With more local problems than this the coarse problem is not factored but solved by BDDC on clusters of them, with the same "
      "strategies; 0: always. Not where closed pairs have more than two nodes.",
      Range::atLeast(0));
  schema.wordOrNumber(
      "Coarse Clusters", "Automatic", {"Automatic"}, Range::atLeast(1),
      "Clusters of that level, each of local problems of one rank. Automatic: the square root of the number of local problems, "
      "at least one for each rank.");
  schema.real("Coarse Accuracy", defaults.accuracy,
              "Accuracy of that level's solution; decides how many steps it makes. The coarse solution is within this part of the exact "
              "one, in energy.",
              Range{1e-12, 0.9, false, false, {}});
}

CoarseOptions CoarseOptions::from(const Parameters& own) {
  CoarseOptions levels;
  levels.weighting = [own] { return makeStrategy<Weighting>(own, "Weighting"); };
  levels.primal = [own] { return makeStrategy<PrimalConstraints>(own, "Edge Constraints"); };
  levels.solver = [own] { return makeStrategy<LocalSolver>(own, "Coarse Solver"); };
  levels.copies = own.get<int>("Coarse Copies");
  levels.above = own.get<int>("Coarse Level Above");
  const auto clusters = own.get<std::string>("Coarse Clusters");
  levels.clusters = clusters == "Automatic" ? 0 : std::stoi(clusters);
  levels.accuracy = own.get<double>("Coarse Accuracy");
  return levels;
}

std::unique_ptr<CoarseSolve> makeCoarseSolve(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels) {
  if (levels.goesOn(locals)) return std::make_unique<ClusterCoarse>(comm, std::move(coarse), locals, levels);
  return std::make_unique<DirectCoarse>(comm, coarse.size, std::move(coarse.elements), levels.solver(), levels.copies, false);
}

}  // namespace suture
