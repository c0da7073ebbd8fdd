#pragma once
#include <suture/mesh/MeshPart.hpp>
#include <suture/simulation/Release.hpp>
#include <suture/simulation/Scene.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// The phases of a scene whose bodies or regions are removed (excavated) or placed between load steps: parts of the load path during which
/// the same elements exist. Each phase is a scene with its own mesh, constraints and factors. Local, the same on all ranks.
class Phases {
 public:
  /// Reads `Load Steps/Removed`, `Load Steps/Placed` and `Load Steps/Release`; no phases if all are empty.
  /// \throws InputError  all of: an unknown body or region (nearest name), a placed region, times that are not the ends of load steps, a
  /// body placed after its removal, fractions that do not ascend to 1 within the path, different fractions for parts removed at the same
  /// time, a phase without bodies, a partitioned mesh, an exact solution, controlled loads
  explicit Phases(const Scene& scene);

  /// Result of changesBefore() where nothing was removed or placed.
  static constexpr const char* kNoChange = "no change";

  bool empty() const { return begins_.empty(); }
  int count() const { return static_cast<int>(begins_.size()); }
  double begin(int phase) const { return begins_[static_cast<std::size_t>(phase)]; }
  /// Last time of a phase.
  double end(int phase) const;
  /// Bodies and regions that do not exist in a phase.
  std::set<std::string> absent(int phase) const;
  /// Sentence on what changes at the beginning of a phase: "'core' removed, 'lining' placed".
  std::string changes(int phase) const;
  /// The phase in which a load step ends.
  int phaseAt(double time) const;
  /// All changes before a time: "t = 1: 'core' removed; t = 2: 'lining' placed"; "no change": none.
  std::string changesBefore(double time) const;
  /// How the forces of parts removed at a time are released; in the next load step where the scene gives nothing else.
  Release release(double removal) const;

 private:
  void read(const Scene& scene, const std::string& list, std::map<std::string, double>& times, Problems& problems);
  void readReleases(const Parameters& own, Problems& problems);

  std::vector<double> begins_, times_;
  double last_ = 0.0;
  std::map<std::string, double> removed_, placed_;
  std::map<double, std::pair<std::string, std::vector<double>>> released_;  // time of removal -> a part, fractions by step
  std::set<std::string> bodies_;
};

/// The scene of one phase of a whole scene.
class PhaseScene {
 public:
  /// \param whole  scene with all bodies; \param mesh  its mesh with bodies and regions, on rank 0. Collective.
  PhaseScene(const Comm& comm, const Scene& whole, const Phases& phases, int phase, std::shared_ptr<const Mesh> mesh);

  /// Its `mesh` is a part of the whole mesh; conditions, contacts, bodies and regions without any element are missing.
  const Scene& scene() const { return scene_; }
  /// Node of the phase's mesh -> node of the whole mesh, ascending. On rank 0.
  const std::vector<int>& nodeOfWhole() const { return *nodeOfWhole_; }

 private:
  Scene scene_;
  std::shared_ptr<std::vector<int>> nodeOfWhole_;
};

}  // namespace suture
