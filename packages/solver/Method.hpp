#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/base/Monitor.hpp>
#include <suture/base/Registry.hpp>
#include <suture/base/Timers.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/solver/MakeSubdomains.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Input of a method: a scene cut into subdomains. The referenced objects must outlive the method.
struct CutScene {
  CommPtr comm;
  const Mesh& mesh;                ///< on rank 0, if the method needs the whole mesh; else empty
  const Constraints& constraints;  ///< likewise
  const Partition& partition;
  const std::vector<SubdomainMesh>& meshes;  ///< subdomains of this rank
  const ElasticModel& model;
  const Parameters& settings;           ///< resolved lists of the solver packages
  std::vector<SubdomainKind> kinds{};   ///< physics of each body; empty: all elastic
  std::vector<std::string> contacts{};  ///< names of the contact lines, for messages
  ContactLaws laws{};                   ///< laws of the contact lines; empty: frictionless
  bool needsLaw = false;                ///< the scene requests results that require a material law at every point
  bool inSteps = false;                 ///< loads, prescribed displacements and histories of pairs change, see Method::reload()
};

/// Initial state of a solution: an earlier one of the scene, or the solution on a coarser mesh.
struct Start {
  std::vector<Vector> displacement;    ///< displacements of each subdomain of this rank, without its lift, node-major, Cartesian [length]
  std::map<int, ContactState> status;  ///< pair id -> state, at least for the pairs of this rank; default: closed
  std::vector<BodyForces> carried{};   ///< largest forces on each body in earlier load steps; empty: none
  double predictedError = 0.0;         ///< discretisation error predicted from coarser meshes, in the energy norm; 0: unknown
  double tolerance = 0.0;              ///< least tolerance, for a solution that is not final; a method may be more accurate
};

/// Solution method for a scene cut into subdomains: `Decomposition`, with an outer solver on the interface, or a method for the whole
/// scene, selected by its name in `Outer Solver/Type`: `Reference` (Monolithic), or a user's method added through Registry<Method>. The
/// base class checks the order of calls, makes the subdomains and measures times; subclasses implement doAssemble() and doSolve().
class Method {
 public:
  static const char* kind() { return "method"; }
  /// \param settings  resolved lists of the solver packages;  \param own  the method's own list
  using Maker = std::function<std::unique_ptr<Method>(const Parameters& settings, const Parameters& own)>;
  virtual ~Method() = default;

  /// True if rank 0 must keep the whole mesh and its constraints.
  virtual bool needsWholeMesh() const = 0;
  /// Estimated memory of this rank before assembly. [MB] Collective. \param unknowns  of the whole scene
  virtual double megabytes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, GlobalId unknowns) const;

  /// True if it supports friction and laws whose pairs never open. Local. \param settings  of the scene
  virtual bool knowsFriction(const Parameters& settings) const {
    (void)settings;
    return false;
  }

  /// Assembles and factors. To be called once. Collective; phases "assemble" and "factor".
  /// \throws NumericalError;  InputError  a subdomain has its own physics, but the scene or the method needs a material law; a contact law
  /// restricts sliding, and the method does not support this
  void prepare(const CutScene& scene, Timers& timers);

  /// True if reload() may be called. After prepare().
  virtual bool reloads() const { return false; }
  /// Updates the loads of the model, the values of the meshes' rules, and the gaps and histories of their pairs; factors are kept. After
  /// solve(). Collective; phase "load".
  void reload(Timers& timers);

  /// Takes over new places and pairs of bodies that move far, from the same objects of the scene; factors are kept. False if the method
  /// cannot: it must then be made and prepared anew. After solve(). Collective; phase "load".
  bool rearrange(Timers& timers);

  /// Number of unknowns of the interface problem over all ranks; 0 for a method without one. After prepare().
  virtual GlobalId interfaceUnknowns() const { return 0; }
  /// True if it uses a given start; else solve() ignores it. After prepare().
  virtual bool takesStart() const { return false; }

  /// Called after every outer iteration except the last, with a function that makes the solution of the current state; all ranks call that
  /// function, or none.
  using Keep = std::function<void(const std::function<Solution()>& solution)>;
  /// The solution, converged or not. After prepare(). Collective; phase "solve".
  /// \param start  initial state, or null;  \param keep  may be empty; a method without intermediate states does not call it
  /// \throws NumericalError  breakdown
  Solution solve(Monitor& monitor, Timers& timers, const Start* start = nullptr, const Keep& keep = {});

  /// Subdomains of this rank; empty if the method has none. Local.
  virtual const Subdomains& subdomains() const;
  /// Ends the method: frees everything except the subdomains with their own physics, which are needed to verify the solution. Null entries
  /// are subdomains that follow the model; empty: all do. Local.
  virtual Subdomains takeSubdomains() { return {}; }

 protected:
  /// True if it works with the laws of the materials instead of the subdomains.
  virtual bool needsLaw() const { return false; }
  /// \param subdomains  of this rank, not yet assembled
  virtual void doAssemble(Subdomains subdomains) = 0;
  /// Does nothing in methods that factor while solving.
  virtual void doFactor() {}
  virtual Solution doSolve(Monitor& monitor, const Start* start, const Keep& keep) = 0;
  virtual void doReload() {}
  virtual bool doRearrange() { return false; }
  /// Available in all of these functions.
  const CutScene& scene() const { return *scene_; }

 private:
  std::optional<CutScene> scene_;
  bool isPrepared_ = false;
};

/// Methods are registered by their own packages.
inline void registerBuiltIns(Registry<Method>&) {}

/// The method of `Outer Solver/Type`: the one with that name in Registry<Method>, else Decomposition with that outer solver. Local, the
/// same on all ranks. \param contact  true if the scene has contact lines
/// \throws InputError  with contact, the outer solver does not fit the formulation; the message lists those that do
std::unique_ptr<Method> makeMethod(const Parameters& settings, bool contact);

}  // namespace suture
