#pragma once
#include <suture/report/Run.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/LoadPath.hpp>
#include <suture/simulation/MeanSupports.hpp>
#include <suture/simulation/Phases.hpp>
#include <suture/simulation/RunContext.hpp>
#include <suture/simulation/Scene.hpp>
#include <suture/simulation/SoftenedContacts.hpp>
#include <suture/solver/Method.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

struct DrawnScene;

/// Plan of a scene with phases.
struct PhasePlan {
  Phases phases;
  Scene whole;                       ///< with all bodies
  std::shared_ptr<const Mesh> mesh;  ///< the whole mesh with its bodies and regions, on rank 0
};

/// A scene cut into subdomains, which all later stages of a run share. Stays at one place in memory: methods and load paths refer to it.
struct SceneParts {
  SceneParts(RunContext context, Scene given) : run(std::move(context)), scene(std::move(given)) {}
  SceneParts(const SceneParts&) = delete;
  SceneParts& operator=(const SceneParts&) = delete;

  RunContext run;
  Scene scene;
  bool isWhole = true;      ///< rank 0 has the whole mesh until the method is prepared
  Mesh mesh{};              ///< on rank 0
  Constraints constraints;  ///< likewise
  CutMesh cut{};
  ProblemSize size{};
  MeanSupports meanSupports{};       ///< in the meshes until the solution is verified
  std::unique_ptr<LoadPath> path{};  ///< null: neither load steps nor coupling
  /// Phases of a scene whose bodies are removed or placed on its path, with the scene of all bodies; null: there are none.
  std::shared_ptr<const PhasePlan> plan{};
  std::unique_ptr<const PhaseScene> phase{};  ///< the present phase; null without phases
  int phaseNumber = 0;
  /// Pair of a placed body -> part of its gap by which the body fits to a deformed side [length]; on rank 0.
  std::map<int, double> fits{};
  std::vector<Vector> reference{};  ///< displacements at the time of `Output/Displacements Since`, by mesh; empty before
  /// With a request for accuracy: the scene as given, and its mesh with the bodies, on rank 0, for the next mesh; else null.
  std::shared_ptr<const Scene> given{};
  std::shared_ptr<const Mesh> whole{};
  /// With Motion = Moving: the scene as drawn; else null.
  std::shared_ptr<const DrawnScene> drawn{};
  double megabytes = 0.0;  ///< memory for all ranks, estimated
  double liftWork = 0.0;   ///< work of the loads in the rigid motions removed, missing in the energies of the method

  /// Time at which the present phase begins; zero without phases.
  double begin() const { return plan ? plan->phases.begin(phaseNumber) : 0.0; }
  /// Ends of the load steps up to the end of the present phase.
  std::vector<double> times() const;
  /// End of the first load step of the present phase.
  double firstTime() const;
  /// Hash of the mesh, on rank 0; with phases that of the whole mesh.
  std::string meshHash() const { return plan ? plan->mesh->hash() : cut.whole.hash; }
  /// Adds the fits to the gaps of the pairs, before the mesh is cut. Local.
  void fitPairs();
  /// Names of all contacts on the path, of which the present phase may have only some.
  std::vector<std::string> contactsOfPath() const { return plan ? plan->whole.entries() : scene.entries(); }
  /// Time of `Output/Displacements Since`, if it has been reached; the same on all ranks.
  std::optional<double> sinceTime() const;
  /// Displacements that `Displacements Since` compares, from those of a solution: of bodies that move far those from the drawn bodies.
  /// Local.
  std::vector<Vector> comparable(const std::vector<Vector>& displacement) const;
  /// True if the scene has load steps, all of which are requested.
  bool followsPath() const { return !scene.steps.empty() && path && !scene.isOneStep; }
  /// The scene as input of its method. \param changes  loads and prescribed values change between solutions
  CutScene forMethod(bool changes) const;
};

/// Assembles and factors the method of a scene. \param method  of the scene, or null: a new one \param changes  see forMethod()
/// Collective.
std::unique_ptr<Method> preparedMethod(const SceneParts& parts, std::unique_ptr<Method> method, bool changes);

/// Initial guess for the next loads: a solution of this scene. Collective.
Start startOf(const Comm& comm, const Solution& solution);

/// Initial guess of a frictional scene with initial stresses: no displacement, and all pairs stick. In-situ stress states usually satisfy
/// the laws, and the rigid bodies from which a search starts otherwise know nothing of them. Nothing for other scenes. Collective.
std::optional<Start> inSituStart(const SceneParts& parts);

/// Forces and deformations of bodies whose stress is their initial stress: the scale of a solution that is zero up to round-off, because
/// loads and initial stresses are in equilibrium. Empty without initial stresses. Collective.
std::vector<BodyForces> inSituForces(const SceneParts& parts);

/// Settles undetermined motions, adds errors, verdict and extremes to a solution. Collective.
/// \param subdomains  as in verifySolution()
void judgeSolution(SceneParts& parts, const Subdomains& subdomains, Solution& solution);

/// Results by entries of the list `Contact`; nothing if no contact is softened. Local.
std::optional<EntryResults> entryResults(const SceneParts& parts, const Solution& solution);

/// The run of a solution, for reports. \param rows  load steps so far
Run runOf(const SceneParts& parts, const Solution& solution, const Invocation& invocation = {});

/// Path of the checkpoint in an output folder.
std::string checkpointIn(const std::string& folder);

/// Writes a solution to the checkpoint of the output folder. Collective.
void writeState(const SceneParts& parts, const Solution& solution);

}  // namespace suture
