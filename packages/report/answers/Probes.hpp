#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/quality/answers/PointSearch.hpp>
#include <suture/report/Run.hpp>

#include <string>
#include <vector>

namespace suture {

/// A probe of the scene (`Output/Probes/<name>`): a point, points along a line, or the nodes of a side group.
struct Probe {
  std::string name, path;           ///< path: "Output/Probes/<name>", for messages
  std::vector<SoughtPoint> points;  ///< none of a group
  std::string group;                ///< empty: points
  int dimension = 2;                ///< of the scene

  std::string fileName() const;  ///< "probe_<name>.csv", all but letters, digits, - and _ of the name replaced by _
};

/// Schema of one entry of `Output/Probes`.
Schema probeSchema();

/// Reads the list `Output/Probes`. Local. \param bodies  of the scene \throws InputError  all of: a parameter that the type lacks or does
/// not take, a body that the scene does not have, two probes with one file
std::vector<Probe> readProbes(const Parameters& scene, const std::vector<std::string>& bodies);

/// Finds the points of all probes. Collective. \throws InputError  all of: points outside the bodies (nearest body, distance), groups that
/// the mesh does not have
std::vector<FoundPoints> locateProbes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<std::string>& bodies,
                                      const std::vector<Probe>& probes);

/// A table a probe, in a folder: a row a point with displacement, stress (recovered; at the element's centroid where nobody asked for that)
/// and, along sides that carry pairs, gap and pressure. Collective. \throws EnvironmentError
void writeProbes(const Run& run, const std::vector<Probe>& probes, const std::string& folder);

}  // namespace suture
