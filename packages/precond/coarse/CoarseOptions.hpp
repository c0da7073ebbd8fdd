#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/precond/PrimalConstraints.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>
#include <suture/precond/coarse/CoarseSolve.hpp>

#include <functional>
#include <memory>

namespace suture {

/// Strategies of BDDC, the same on each of its levels, and choices for its coarse problem: exact, or by a level more when there are many
/// local problems.
struct CoarseOptions {
  static constexpr int kAutomatic = -1;

  std::function<std::unique_ptr<Weighting>()> weighting = [] { return std::make_unique<StiffnessDiagonalWeighting>(); };
  std::function<std::unique_ptr<PrimalConstraints>()> primal = automaticConstraints;
  LocalSolverMaker solver;  ///< solver of the last level
  int copies = 0;           ///< ranks that hold a factor; 0: all
  int above = kAutomatic;   ///< local problems beyond which there is a level more; 0: always one, and no further
  int clusters = 0;         ///< local problems of the next level; 0: automatic, see automaticClusters
  double accuracy = 0.1;    ///< accuracy of a coarse solve that is not exact: eigenvalues in [1 - accuracy, 1 + accuracy]

  /// Parameters `Weighting`, `Edge Constraints`, `Coarse Solver`, `Coarse Copies`, `Coarse Level Above`, `Coarse Clusters`,
  /// `Coarse Accuracy`.
  static void addParameters(Schema& schema);
  static CoarseOptions from(const Parameters& own);

  /// True if the coarse problem of so many local problems is solved by a level more.
  bool goesOn(int locals, int dimension) const;
};

/// \param locals  local problems of all ranks; where there is a level more for them it needs `coarse.unknowns`
/// Collective. \throws NumericalError  the coarse matrix is not positive definite
std::unique_ptr<CoarseSolve> makeCoarseSolve(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels);

}  // namespace suture
