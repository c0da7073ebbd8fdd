#pragma once
#include <suture/answer/Overlaps.hpp>
#include <suture/simulation/Scene.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Notes on bodies that overlap, in the undeformed mesh and in the solution.
class OverlapNotes {
 public:
  /// Finds the overlaps of the undeformed bodies. Collective.
  OverlapNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene);

  /// Overlaps as drawn, except those on contacts, which report their interference. Local.
  std::vector<std::string> drawn(const Scene& scene) const;
  /// Overlaps that the solution created or deepened by half. Collective. \param displacement  of each subdomain of this rank [length]
  std::vector<std::string> added(const Comm& comm, const Scene& scene, const std::vector<Vector>& displacement) const;

 private:
  OverlapSearch search_;
  std::vector<Overlap> drawn_;
};

}  // namespace suture
