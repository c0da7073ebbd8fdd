#pragma once
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/base/Monitor.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/solver/Solution.hpp>

#include <string>
#include <vector>

namespace suture {

class MonolithicSystem;

struct MonolithicOptions {
  int maximumIterations = 200;        ///< solves of the condensed contact problem with an active set
  std::vector<ContactState> start{};  ///< state of each pair; empty: all closed, with friction its own start
  CholmodOptions::Ordering ordering = CholmodOptions::Ordering::Automatic;
};

/// Solution for the whole mesh on one rank.
struct MonolithicResult {
  bool converged = false;
  std::string failure;            ///< why not
  Vector displacement;            ///< displacements of the whole mesh: node-major, Cartesian [length]
  std::vector<PairResult> pairs;  ///< by id
  std::vector<PairForce> forces;  ///< by id
  int iterations = 0;             ///< 0 for a scene without unilateral contact
  double residual = 0.0;          ///< largest violation of the contact conditions over the size of the displacements
  double energy = 0.0;            ///< total potential energy
  double contraction = 0.0;       ///< contraction of the fixed point of friction, see ContactSolution; 0: it was not needed
  Balance balance;                ///< balance of forces
  std::vector<OuterRow> rows;     ///< the same that the monitor was told, for replay on other ranks

  GlobalId dofs = 0;           ///< free ones
  int contactDofs = 0;         ///< ordered last
  double factorEntries = 0.0;  ///< entries of the sparse factor
  double factorFlops = 0.0;
};

/// The independent reference: the whole scene as one system, ONE sparse Cholesky factorisation with the contact dofs last, contact
/// condensed to that trailing block and solved there exactly (MonolithicContact), one back-substitution. Shares nothing with the
/// decomposed path but element matrices, loads, constraints and pairs.
///
/// Bodies that only contact holds need no special care: their trailing diagonal is shifted for the factorisation and the shift taken off
/// the condensed stiffness; their rigid motions are free unknowns of the contact problem.
///
/// Local, for the rank that holds the mesh: so is what it tells the monitor. A listener that communicates must be given `rows` afterwards,
/// on all ranks.
///
/// \throws InputError      the scene has no solution, or more than one (checkSolvability)
/// \throws NumericalError  the factorisation broke down; a body slides away, and the message names it
MonolithicResult solveMonolithic(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model,
                                 const MonolithicOptions& options, Monitor& monitor);

/// The same with a system that was assembled before, of this mesh and these constraints.
MonolithicResult solveMonolithic(const Mesh& mesh, const Constraints& constraints, const MonolithicSystem& system,
                                 const MonolithicOptions& options, Monitor& monitor);

}  // namespace suture
