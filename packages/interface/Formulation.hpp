#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/Registry.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/subdomain/SchurComplement.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Elimination of the unknowns inside subdomains and groups.
struct LocalAlgebra {
  LocalSolverMaker solver;
  std::function<std::unique_ptr<SchurComplement>()> schur;
};

/// The formulation of a scene determines where contact enters the interface problem. It makes the InterfaceProblem from the subdomains.
/// Strategies: Contact On The Interface, Condensed Groups; add your own through Registry<Formulation>.
class Formulation {
 public:
  static const char* kind() { return "formulation"; }
  static constexpr const char* kOnTheInterface = "Contact On The Interface";  ///< the default
  virtual ~Formulation() = default;

  /// True if all subdomains of a contact group must be on one rank.
  virtual bool keepsGroupsWhole() const = 0;
  /// True if contact is condensed in the local problems: the space is the same for each status of the pairs, and the flux is a function of
  /// the trace alone. Required by some outer solvers.
  virtual bool hidesContact() const = 0;
  /// True if its problems support laws that restrict sliding and sides that never separate.
  virtual bool knowsFriction() const { return false; }
  /// Default outer solver.
  virtual std::string outerSolver() const = 0;

  /// Makes the problem of this rank's subdomains, which are assembled, in ascending order of ids, and must outlive it. Collective.
  /// \param laws  of the contact lines
  /// \throws NumericalError;  InputError  the formulation refuses the scene
  std::unique_ptr<InterfaceProblem> make(const CommPtr& comm, const Partition& partition,
                                         const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalAlgebra& algebra,
                                         const ContactLaws& laws = {}) const;

 protected:
  virtual std::unique_ptr<InterfaceProblem> doMake(const CommPtr& comm, const Partition& partition,
                                                   const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalAlgebra& algebra,
                                                   const ContactLaws& laws) const = 0;
};

void registerBuiltIns(Registry<Formulation>& registry);

/// The formulation selected by a scene. Local. \param settings  resolved: `Formulation`, and the list with its name
std::unique_ptr<Formulation> formulationOf(const Parameters& settings);

}  // namespace suture
