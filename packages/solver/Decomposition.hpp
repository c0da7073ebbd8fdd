#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/Timers.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/ErrorEstimate.hpp>
#include <suture/solver/OuterSolver.hpp>
#include <suture/solver/Solution.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <memory>
#include <vector>

namespace suture {

using Subdomains = std::vector<std::unique_ptr<Subdomain>>;

/// The steps from distributed meshes to a solution, one function a stage. `scene` is the whole resolved scene. All collective.

/// Takes rigid motions out of the scene, where it prescribes any (takeOutRigidMotions()): after the checks, before anything is assembled.
/// `constraints` of rank 0, for Monolithic, follow the meshes; they may be empty.
/// Returns the work of the loads in these motions, which the energy of a Solution lacks. [force length]
double takeOutLift(const Comm& comm, const ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints);

/// Elastic subdomains of this rank's meshes, assembled. `meshes` and `model` must outlive them. \throws NumericalError
Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model);

/// The same, each of the kind that the scene names for its body (`Bodies/<name>/Subdomain`).
/// \throws NumericalError;  InputError  physics of a subdomain's own where the scene asks for what needs the law of a material at every
/// point:
///                           Monolithic, an error estimate or an automatic tolerance, an exact solution. Names the body.
Subdomains makeSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene);

/// For the check before Monolithic, which has no subdomains. \throws InputError  as makeSubdomains(). Collective.
void checkPhysics(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& scene);

/// Frees the subdomains (null then) that nobody needs to judge an answer: those that follow the model. Local.
void releaseFollowers(Subdomains& subdomains);

/// True if the scene's formulation is the paper's: contact groups live whole on one rank. Local.
bool isCondensed(const Parameters& scene);

/// \throws InputError  the scene's outer solver does not fit its formulation: names those that do; a law of a contact restricts sliding.
/// Local, the same on all ranks.
void checkCombination(const Parameters& scene);

/// The scene's formulation: subdomains and contact groups factored. `subdomains` must outlive it.
/// \throws NumericalError;  InputError  a contact group larger than the Memory Limit of Condensed Groups
std::unique_ptr<InterfaceProblem> makeInterfaceProblem(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                                       const Parameters& scene);

/// True if the scene's tolerance is Automatic. Local.
bool isAutomatic(const Parameters& scene);

/// The relative algebraic error that the scene's tolerance asks of a solution: a tenth of its estimated discretisation error where it is
/// Automatic. Local.
double requestedAccuracy(const Parameters& scene, const Solution& solution);

/// Estimator of the discretisation error for an automatic tolerance. All arguments must outlive it. Collective, and so is its call.
/// Expected of n nodes are 3 n^(-1/2) with linear cells, 1.5 / n with quadratic ones. (Measured: V5 on 64 x 64 cells T3 1.2, Q4 0.4 of
/// n^(-1/2), T6 1.5, Q9 0.3 of 1 / n; tunnel, hertz 3 to 4 of n^(-1/2).)
AutomaticTolerance::Estimate discretisationErrorOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                                   const Subdomains& subdomains);

/// Solves with the scene's outer solver and preconditioner, from `start` or, if it is null, from the auxiliary problem.
/// \param discretisationError  for an automatic tolerance; not asked for another
/// \throws NumericalError
OuterResult solveInterface(const InterfaceProblem& problem, const Parameters& scene, Monitor& monitor,
                           const InterfaceState* start = nullptr, const AutomaticTolerance::Estimate& discretisationError = {});

/// Interiors, contact and energy of the state that the outer solver ended with.
Solution recover(const Comm& comm, const InterfaceProblem& problem, const OuterResult& result, const Subdomains& subdomains,
                 const Parameters& scene);

/// True if the scene asks for the outer solver Monolithic.
bool isMonolithic(const Parameters& scene);

/// Sizes for the report, but for the interface.
ProblemSize problemSize(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition);

/// The same with the interface's. `problem` may be null (Monolithic): no interface then. Local.
ProblemSize withInterface(ProblemSize size, const InterfaceProblem* problem);

}  // namespace suture
