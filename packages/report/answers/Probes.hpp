#pragma once
#include <suture/answer/values/PointSearch.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/report/Run.hpp>

#include <string>
#include <vector>

namespace suture {

/// A probe of the scene (`Output/Probes/<name>`): a point, points along a line, or the nodes of a side group.
struct Probe {
  std::string name, path;           ///< path: "Output/Probes/<name>", for messages
  std::vector<SoughtPoint> points;  ///< empty for a group
  std::string group;                ///< empty: points
  int dimension = 2;                ///< dimension of the scene

  std::string fileName() const;  ///< "probe_<name>.csv"; see tableName()
};

/// Schema of one entry of `Output/Probes`.
Schema probeSchema();

/// Reads the list `Output/Probes`. Local. \param bodies  of the scene \throws InputError  lists all of: a missing parameter, a parameter
/// of another type, an unknown body, two probes with the same file
std::vector<Probe> readProbes(const Parameters& scene, const std::vector<std::string>& bodies);

/// Finds the points of all probes. Collective. \throws InputError  lists all of: points outside the bodies (with nearest body and
/// distance), groups missing in the mesh
std::vector<FoundPoints> locateProbes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                                      const std::vector<Probe>& probes);

/// Writes one table per probe into a folder, one row per point: displacement, stress (recovered if requested, otherwise at the element
/// centroid) and, on sides that carry pairs, gap and pressure. Collective. \throws EnvironmentError
void writeProbes(const Run& run, const std::vector<Probe>& probes, const std::string& folder);

}  // namespace suture
