#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/OuterSolver.hpp>
#include <suture/solver/Solution.hpp>

#include <memory>

namespace suture {

/// The steps of Decomposition from assembled subdomains to a solution. `settings` are the resolved lists of the solver packages. All
/// collective.

/// The problem of the settings' formulation: subdomains and contact groups factored. `subdomains` must outlive it.
/// \throws NumericalError;  InputError  a contact group larger than the Memory Limit of Condensed Groups
std::unique_ptr<InterfaceProblem> makeInterfaceProblem(const CommPtr& comm, const Partition& partition, const Subdomains& subdomains,
                                                       const Parameters& settings, const ContactLaws& laws = {});

/// The state of a problem that belongs to a start.
InterfaceState stateOf(const Start& start, const InterfaceProblem& problem, const Subdomains& subdomains);

/// Solves with the settings' outer solver and preconditioner, from `start` or, if it is null, from the auxiliary problem.
/// \param discretisationError  for an automatic tolerance; not asked for another
/// \param accepted  told the state of every outer iteration but the last, or empty
/// \param kept  if given, the preconditioner: that of an earlier solution, null at first, from which it keeps what is the same
/// \throws NumericalError
OuterResult solveInterface(const InterfaceProblem& problem, const Parameters& settings, Monitor& monitor,
                           const InterfaceState* start = nullptr, const AutomaticTolerance::Estimate& discretisationError = {},
                           const std::function<void(const InterfaceState&)>& accepted = {}, Teuchos::RCP<Preconditioner>* kept = nullptr);

/// Why a search for the set of closed pairs did not end: "; pairs 3, 4 of contact 'joint' (bodies 'upper', 'lower') still open ...". Local.
/// \param pairs  that changed last, not empty;  \param contacts, bodies  names;  \param atLimit  it stopped at the limit of iterations
std::string unsettled(const ContactSets& sets, const std::vector<int>& pairs, const std::vector<std::string>& contacts,
                      const std::vector<std::string>& bodies, bool atLimit = true);

/// Why there is no equilibrium: which bodies friction does not hold, and where they move. Local.
/// \param motion  OuterResult::slides;  \param bodies  names;  \param multiple  of friction, that would hold them; 0: not known
std::string slidesAway(const ContactBodies& parts, const Vector& motion, const std::vector<std::string>& bodies, double multiple = 0.0);

/// Interiors, contact and energy of the state that the outer solver ended with.
Solution recover(const Comm& comm, const InterfaceProblem& problem, const OuterResult& result, const Subdomains& subdomains,
                 const Parameters& settings);

}  // namespace suture
