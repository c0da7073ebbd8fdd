#pragma once
#include <suture/report/Run.hpp>
#include <suture/report/VtkHdf.hpp>

namespace suture {

/// /Record: where a file comes from. Texts Input (the scene verbatim), InputPath, Resolved (XML), MeshHash, Version, Commit, Libraries
/// (JSON: library -> version), CommandLine; attributes `ranks` and `seed` of the group. Nothing that differs between two equal runs.
/// Collective.
void writeProvenance(const Run& run, Hdf5File& file);

/// Names of the materials of bodies and regions, each once: the numbers of the field Material are places among them. Local.
std::vector<std::string> materialNames(const ElasticModel& model);

/// Names that pictures need: texts Bodies and Subdomains (JSON lists in the order of the numbers in the fields), and for each side group of
/// the mesh a dataset `/Record/SideGroups/<name>`, a row a side: x, y, z of its first and of its second end point. As field data, which
/// ParaView shows: BodyNames, MaterialNames, SubdomainNames, in the order of the numbers in the fields, and GroupNames. Collective.
void writeNames(const Run& run, VtkHdf& file);

}  // namespace suture
