#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/Monitor.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/OuterSolver.hpp>

#include <memory>

namespace suture {

/// The steps of Decomposition from assembled subdomains to a solution. `settings` are the resolved lists of the solver packages. All
/// collective.

/// The interface problem of the chosen formulation, with factored subdomains and contact groups. `subdomains` must outlive it.
/// \throws NumericalError;  InputError  a contact group exceeds the Memory Limit of Condensed Groups
std::unique_ptr<InterfaceProblem> makeInterfaceProblem(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                                       const Parameters& settings, const ContactLaws& laws = {});

/// The interface state of a start.
InterfaceState stateOf(const Start& start, const InterfaceProblem& problem, const Subdomains& subdomains);

/// Solves with the chosen outer solver and preconditioner, from `start`, or from the auxiliary problem if it is null.
/// \param discretisationError  used only by an automatic tolerance  \param leastTolerance  see Start::tolerance
/// \param accepted  called with the state of every outer iteration except the last, or empty
/// \param kept  if given, in and out: preconditioner of the previous solution (initially null), whose unchanged parts are reused
/// \throws NumericalError
OuterResult solveInterface(const InterfaceProblem& problem, const Parameters& settings, Monitor& monitor,
                           const InterfaceState* start = nullptr, const AutomaticTolerance::Estimate& discretisationError = {},
                           const std::function<void(const InterfaceState&)>& accepted = {}, Teuchos::RCP<Preconditioner>* kept = nullptr,
                           double leastTolerance = 0.0);

/// Message that names the pairs for which a search for the set of closed pairs did not end: "; pairs 3, 4 of contact 'joint' (bodies
/// 'upper', 'lower') still open ...". Local.
/// \param pairs  the last ones that changed, not empty;  \param contacts, bodies  names;  \param atLimit  it stopped at the limit of
/// iterations
std::string unsettled(const ContactProblem& contact, const std::vector<int>& pairs, const std::vector<std::string>& contacts,
                      const std::vector<std::string>& bodies, bool atLimit = true);

/// Message for a scene without equilibrium: the bodies that contact or friction does not hold, and their motion. Local.
/// \param motion  OuterResult::slides;  \param bodies  names;  \param frictional  false: no contact has friction;  \param multiple  factor
/// on friction that would hold them; 0: unknown
std::string slidesAway(const ContactBodies& parts, const Vector& motion, const std::vector<std::string>& bodies, bool frictional,
                       double multiple = 0.0);

/// Interior displacements, contact results and energy of the final state of the outer solver.
Solution recover(const Comm& comm, const InterfaceProblem& problem, const OuterResult& result, const Subdomains& subdomains,
                 const Parameters& settings);

}  // namespace suture
