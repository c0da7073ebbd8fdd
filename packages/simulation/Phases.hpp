#pragma once
#include <suture/mesh/MeshPart.hpp>
#include <suture/simulation/Scene.hpp>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace suture {

/// The phases of a scene whose bodies or regions are removed (excavated) or placed between load steps: parts of the load path during which
/// the same elements exist. Each phase is a scene with its own mesh, constraints and factors. Local, the same on all ranks.
class Phases {
 public:
  /// Reads `Load Steps/Removed` and `Load Steps/Placed`; no phases if both are empty.
  /// \throws InputError  all of: an unknown body or region (nearest name), a placed region, times that are not the ends of load steps, a
  /// body placed after its removal, a phase without bodies, a partitioned mesh, an exact solution, controlled loads
  explicit Phases(const Scene& scene);

  bool empty() const { return begins_.empty(); }
  int count() const { return static_cast<int>(begins_.size()); }
  double begin(int phase) const { return begins_[static_cast<std::size_t>(phase)]; }
  /// Last time of a phase.
  double end(int phase) const;
  /// Bodies and regions that do not exist in a phase.
  std::set<std::string> absent(int phase) const;
  /// Sentence on what changes at the beginning of a phase: "'core' removed, 'lining' placed".
  std::string changes(int phase) const;

 private:
  void read(const Scene& scene, const std::string& list, std::map<std::string, double>& times, Problems& problems);

  std::vector<double> begins_;
  double last_ = 0.0;
  std::map<std::string, double> removed_, placed_;
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
