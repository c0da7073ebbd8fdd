#include <suture/precond/coarse/ClusterCoarse.hpp>
#include <suture/precond/coarse/CoarseOptions.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

void CoarseOptions::addParameters(Schema& schema) {
  const CoarseOptions defaults;
  schema.choice("Weighting", "Stiffness Diagonal", Registry<Weighting>::instance().schemas(),
                "Weights D_i of the subdomains at shared unknowns.");
  schema.choice("Edge Constraints", "Automatic", Registry<PrimalConstraints>::instance().schemas(),
                "Primal constraints on edges, in addition to their end points, and in 3D on faces.");
  addCoarseParameters(schema);
  schema.wordOrNumber(
      "Coarse Level Above", "Automatic", {"Automatic"}, Range::atLeast(0),
      "With more local problems than this, the coarse problem is solved by BDDC on clusters of local problems, with the same "
      "strategies, instead of a factorisation; 0: always. Not available for closed pairs of more than two nodes. Automatic: 1000, in 3D "
      "600.");
  schema.wordOrNumber(
      "Coarse Clusters", "Automatic", {"Automatic"}, Range::atLeast(1),
      "Number of clusters on that level, each within one rank. Automatic: the square root of the number of local problems, at least "
      "one per rank.");
  schema.real(
      "Coarse Accuracy", defaults.accuracy,
      "Accuracy of the solution on that level, which determines the number of Chebyshev steps: the relative error in the energy norm.",
      Range{1e-12, 0.9, false, false, {}});
}

CoarseOptions CoarseOptions::from(const Parameters& own) {
  CoarseOptions levels;
  levels.weighting = [own] { return makeStrategy<Weighting>(own, "Weighting"); };
  levels.primal = [own] { return makeStrategy<PrimalConstraints>(own, "Edge Constraints"); };
  levels.solver = [own] { return makeStrategy<LocalSolver>(own, "Coarse Solver"); };
  levels.copies = own.get<int>("Coarse Copies");
  const auto above = own.get<std::string>("Coarse Level Above");
  levels.above = above == "Automatic" ? kAutomatic : std::stoi(above);
  const auto clusters = own.get<std::string>("Coarse Clusters");
  levels.clusters = clusters == "Automatic" ? 0 : std::stoi(clusters);
  levels.accuracy = own.get<double>("Coarse Accuracy");
  return levels;
}

bool CoarseOptions::goesOn(int locals, int dimension) const {
  // Beyond this, factoring the coarse problem takes longer than clusters. It has about 8 unknowns per local problem in 2D, 17 to 34 in 3D.
  // 512 bricks with 8,589 unknowns: 5.2 s by a factor, 13.3 by clusters; 476 local problems with 16,267: 5.3 and 5.3 s, two ranks.
  const int most = above != kAutomatic ? above : dimension == 3 ? 600 : 1000;
  return locals > most && locals > 1;
}

std::unique_ptr<CoarseSolve> makeCoarseSolve(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels) {
  if (levels.goesOn(locals, coarse.dimension)) return std::make_unique<ClusterCoarse>(comm, std::move(coarse), locals, levels);
  return std::make_unique<DirectCoarse>(comm, coarse.size, std::move(coarse.elements), levels.solver(), levels.copies, false);
}

}  // namespace suture
