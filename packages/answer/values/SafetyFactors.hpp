#pragma once
#include <suture/answer/values/Extremes.hpp>
#include <suture/elasticity/strength/Strength.hpp>

#include <limits>
#include <vector>

namespace suture {

/// The least safety factor of a body, and where.
struct LeastSafety {
  double factor = std::numeric_limits<double>::infinity();  ///< infinity: no load
  int body = -1;
  int region = -1;           ///< index in ElasticModel::materialOfRegion; -1: the body's material
  GlobalId id = -1;          ///< node or element, as Extreme::id; -1 without load
  Point place{0, 0, 0};      ///< on the undeformed body [length]
  PrincipalStress stress{};  ///< there [stress]
  int step = 0;              ///< load step, from 1; 0 without load steps
  double time = 0.0;         ///< end of that step

  bool exists() const { return id >= 0; }
  const Material& material(const ElasticModel& model) const {
    return region < 0 ? model.materialOfBody[std::size_t(body)] : model.materialOfRegion[std::size_t(region)];
  }
};

/// Safety factors of a solution: Strength::factor() of the stresses that the extremes are taken from, recovered ones at nodes if requested,
/// else those at centroids. A node between several materials of a body has the smallest of their factors, for the mean stress there.
struct SafetyFactors {
  std::vector<LeastSafety> ofBodies;  ///< bodies of which a material has a strength, in the order of the model; the same on all ranks
  std::vector<Vector> nodal;          ///< by mesh of this rank, per node, NaN without strength; empty unless stresses were recovered
};

/// Empty if no material has a strength. Collective.
SafetyFactors findSafety(const Comm& comm, const SearchedFields& fields);

/// Factors at the centroids of a mesh; NaN in materials without strength. Local. \param stresses  as elementStresses()
Vector safetyFactors(const SubdomainMesh& mesh, const ElasticModel& model, const Matrix& stresses);

/// Replaces the least factors by those of another load step that are smaller. Local.
void keepLeast(std::vector<LeastSafety>& least, const std::vector<LeastSafety>& step);

/// A warning for each body that exceeds its strength, at most five; a note for each anisotropic material with a strength. Local.
std::vector<std::string> safetyNotes(const ElasticModel& model, const SafetyFactors& factors);

}  // namespace suture
