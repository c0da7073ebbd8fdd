#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/Registry.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/subdomain/SchurComplement.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace suture {

/// How the unknowns inside subdomains and groups are eliminated.
struct LocalAlgebra {
  LocalSolverMaker solver;
  std::function<std::unique_ptr<SchurComplement>()> schur;
};

/// The formulation of a scene: where contact enters the problem on the interface. It makes the InterfaceProblem from the subdomains.
/// Strategies: Contact On The Interface, Condensed Groups; a user adds his own through Registry<Formulation>.
class Formulation {
 public:
  static const char* kind() { return "formulation"; }
  virtual ~Formulation() = default;

  /// True if all subdomains of a contact group must be on one rank.
  virtual bool keepsGroupsWhole() const = 0;
  /// True if contact is hidden in the local problems: the space is the same for every status of the pairs, and the flux is a function of
  /// the trace alone. Outer solvers ask for it.
  virtual bool hidesContact() const = 0;
  /// True if its problems know laws that restrict sliding, and sides that never part.
  virtual bool knowsFriction() const { return false; }
  /// Name of the outer solver that goes with it, for scenes that do not choose one.
  virtual std::string outerSolver() const = 0;

  /// The problem of these subdomains: of this rank, assembled, in ascending order of ids. They must outlive it. Collective.
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

/// The formulation that a scene names. Local. \param settings  resolved: `Formulation`, and a list of that name
std::unique_ptr<Formulation> formulationOf(const Parameters& settings);

}  // namespace suture
