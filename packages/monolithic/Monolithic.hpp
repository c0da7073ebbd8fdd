#pragma once
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/answer/Solution.hpp>
#include <suture/base/Monitor.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/pairs/PairForce.hpp>

#include <string>
#include <vector>

namespace suture {

class MonolithicSystem;

struct MonolithicOptions {
  int maximumIterations = 200;        ///< solves of the condensed contact problem with an active set
  std::vector<ContactState> start{};  ///< initial state of each pair; empty: all closed, or with friction an automatic start
  CholmodOptions::Ordering ordering = CholmodOptions::Ordering::Automatic;
  bool balances = false;  ///< refine the solution in any case, so that nodal forces balance up to their own round-off
};

/// Solution of the whole mesh on one rank.
struct MonolithicResult {
  bool converged = false;
  std::string failure;            ///< why it did not converge
  Vector displacement;            ///< displacements of the whole mesh: node-major, Cartesian [length]
  std::vector<PairResult> pairs;  ///< by id
  std::vector<PairForce> forces;  ///< by id
  int iterations = 0;             ///< 0 for a scene without unilateral contact
  double residual = 0.0;          ///< largest violation of the contact conditions over the size of the displacements
  double energy = 0.0;            ///< total potential energy
  double contraction = 0.0;       ///< contraction of the friction fixed point, see ContactSolution; 0: not needed
  Balance balance;                ///< balance of forces
  std::vector<OuterRow> rows;     ///< rows reported to the monitor, for replay on other ranks

  GlobalId dofs = 0;           ///< free dofs
  int contactDofs = 0;         ///< ordered last
  double factorEntries = 0.0;  ///< entries of the sparse factor
  double factorFlops = 0.0;
};

/// Reference solver: the whole scene as one system, one sparse Cholesky factorisation with the contact dofs last, the contact problem
/// condensed to that trailing block and solved exactly (MonolithicContact), and one back-substitution. It shares element matrices, loads,
/// constraints, pairs and the search for their states (StateSearch) with the decomposition, but no linear solver.
///
/// For bodies held only by contact the trailing diagonal is shifted for the factorisation, and the shift is subtracted from the condensed
/// stiffness; their rigid motions are free unknowns of the contact problem.
///
/// Local, on the rank with the mesh; so are its reports to the monitor. For a monitor that communicates, replay `rows` afterwards on all
/// ranks.
///
/// \throws InputError      the scene has no solution or is not uniquely solvable (checkSolvability)
/// \throws NumericalError  the factorisation broke down, or a body slides away (named in the message)
MonolithicResult solveMonolithic(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                                 const MonolithicOptions& options, Monitor& monitor);

/// The same with an already assembled system of this mesh and these constraints.
MonolithicResult solveMonolithic(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system,
                                 const MonolithicOptions& options, Monitor& monitor);

}  // namespace suture
