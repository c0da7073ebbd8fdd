#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/precond/PrimalConstraints.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>
#include <suture/precond/coarse/CoarseSolve.hpp>

#include <functional>
#include <memory>

namespace suture {

/// Strategies of BDDC, the same on each level, and options of its coarse problem: exact, or with one more level if there are many local
/// problems.
struct CoarseOptions {
  static constexpr int kAutomatic = -1;

  std::function<std::unique_ptr<Weighting>()> weighting = [] { return std::make_unique<StiffnessDiagonalWeighting>(); };
  std::function<std::unique_ptr<PrimalConstraints>()> primal = automaticConstraints;
  LocalSolverMaker solver;  ///< direct solver of the last level
  int copies = 0;           ///< ranks that hold a factor; 0: all
  int above = kAutomatic;   ///< more local problems than this: one more level; 0: exactly one more level
  int clusters = 0;         ///< local problems of the next level; 0: automatic, see automaticClusters
  double accuracy = 0.1;    ///< accuracy of an approximate coarse solve: eigenvalues in [1 - accuracy, 1 + accuracy]

  /// Parameters `Weighting`, `Edge Constraints`, `Coarse Solver`, `Coarse Copies`, `Coarse Level Above`, `Coarse Clusters`,
  /// `Coarse Accuracy`.
  static void addParameters(Schema& schema);
  static CoarseOptions from(const Parameters& own);

  /// True if the coarse problem of `locals` local problems is solved with one more level.
  bool goesOn(int locals, int dimension) const;
};

/// \param locals  local problems of all ranks; one more level for them requires `coarse.unknowns`
/// Collective. \throws NumericalError  if the coarse matrix is not positive definite
std::unique_ptr<CoarseSolve> makeCoarseSolve(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels);

}  // namespace suture
