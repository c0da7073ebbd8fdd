#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/Registry.hpp>
#include <suture/base/Timers.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/solver/MakeSubdomains.hpp>
#include <suture/solver/Solution.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// A scene in subdomains, as a method is given it. The objects that it refers to outlive the method.
struct CutScene {
  CommPtr comm;
  const Mesh& mesh;                ///< on rank 0, if the method needs it; else empty
  const Constraints& constraints;  ///< likewise
  const Partition& partition;
  const std::vector<SubdomainMesh>& meshes;  ///< subdomains of this rank
  const ElasticModel& model;
  const Parameters& settings;           ///< resolved lists of the solver packages
  std::vector<SubdomainKind> kinds{};   ///< physics of each body; empty: all elastic
  std::vector<std::string> contacts{};  ///< names of the contact lines, for messages
  ContactLaws laws{};                   ///< laws of the contact lines; empty: frictionless
  bool needsLaw = false;                ///< the scene asks for what needs the law of a material at every point
  bool inSteps = false;                 ///< loads, prescribed displacements and histories of pairs change, see Method::reload()
};

/// A state to begin a solution from: an earlier one of the scene, or the answer on a coarser mesh.
struct Start {
  std::vector<Vector> displacement;    ///< displacements of each subdomain of this rank: beside its lift, node-major, Cartesian [length]
  std::map<int, ContactState> status;  ///< pair id -> state, of this rank's pairs at least; one that is not named is closed
  std::vector<BodyForces> carried{};   ///< largest forces on each body on the path of load steps before; empty: none
};

/// The way from a scene in subdomains to its solution: `Decomposition`, by an outer solver on the interface, or one that solves the scene
/// as a whole and has a name of its own among the values of `Outer Solver/Type`: `Reference` (Monolithic), or a user's, added through
/// Registry<Method>. The shell checks the order of calls, makes the subdomains and takes the times; a user writes doAssemble() and
/// doSolve().
class Method {
 public:
  static const char* kind() { return "method"; }
  /// \param settings  resolved lists of the solver packages;  \param own  the method's own list
  using Maker = std::function<std::unique_ptr<Method>(const Parameters& settings, const Parameters& own)>;
  virtual ~Method() = default;

  /// True if rank 0 must keep the whole mesh with its constraints.
  virtual bool needsWholeMesh() const = 0;
  /// Memory that this rank will take, estimated before anything is assembled. [MB] Collective. \param unknowns  of the whole scene
  virtual double megabytes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, GlobalId unknowns) const;

  /// True if it solves contact with friction, and with sides that never part. Local. \param settings  of the scene
  virtual bool knowsFriction(const Parameters& settings) const {
    (void)settings;
    return false;
  }

  /// Assembles and factors. Once. Collective; phases "assemble" and "factor".
  /// \throws NumericalError;  InputError  physics of a subdomain's own where the scene or the method needs the law of a material; a law of
  /// a contact restricts sliding
  void prepare(const CutScene& scene, Timers& timers);

  /// True if reload() may be called. After prepare().
  virtual bool reloads() const { return false; }
  /// Takes the loads of the model, values of the meshes' rules, and gaps and histories of their pairs as they are now: what was factored
  /// stays. After solve(). Collective; phase "load".
  void reload(Timers& timers);

  /// Unknowns of the interface problem, over all ranks; 0 for a method without one. After prepare().
  virtual GlobalId interfaceUnknowns() const { return 0; }
  /// True if it can begin at a given place; else solve() ignores the start. After prepare().
  virtual bool takesStart() const { return false; }

  /// Told the state after every outer iteration but the last, as a function that makes the solution of it: all ranks call it, or none.
  using Keep = std::function<void(const std::function<Solution()>& solution)>;
  /// The solution, converged or not. After prepare(). Collective; phase "solve".
  /// \param start  where to begin, or null;  \param keep  may be empty; a method without intermediate states does not call it
  /// \throws NumericalError  breakdown
  Solution solve(Monitor& monitor, Timers& timers, const Start* start = nullptr, const Keep& keep = {});

  /// Subdomains of this rank as they are; empty: the method has none. Local.
  virtual const Subdomains& subdomains() const;
  /// Ends the method: frees all but the subdomains with physics of their own, which judge the answer. Null stands for one that follows the
  /// model; empty: all do. Local.
  virtual Subdomains takeSubdomains() { return {}; }

 protected:
  /// True if it works with the laws of the materials instead of the subdomains.
  virtual bool needsLaw() const { return false; }
  /// \param subdomains  of this rank, made and not yet assembled
  virtual void doAssemble(Subdomains subdomains) = 0;
  /// Nothing, for a method that factors as it solves.
  virtual void doFactor() {}
  virtual Solution doSolve(Monitor& monitor, const Start* start, const Keep& keep) = 0;
  virtual void doReload() {}
  /// Known in all of them.
  const CutScene& scene() const { return *scene_; }

 private:
  std::optional<CutScene> scene_;
  bool isPrepared_ = false;
};

/// Methods are registered by their own packages.
inline void registerBuiltIns(Registry<Method>&) {}

/// The method of `Outer Solver/Type`: of that name in Registry<Method>, else Decomposition with that outer solver. Local, the same on all
/// ranks. \param contact  true if the scene has contact lines
/// \throws InputError  with contact: an outer solver that does not fit the formulation; names those that do
std::unique_ptr<Method> makeMethod(const Parameters& settings, bool contact);

}  // namespace suture
