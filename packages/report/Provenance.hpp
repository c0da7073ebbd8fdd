#pragma once
#include <suture/report/Run.hpp>
#include <suture/report/VtkHdf.hpp>

namespace suture {

/// /Record: the origin of a file. Texts Input (the scene verbatim), InputPath, Resolved (XML), MeshHash, Version, Commit, Libraries
/// (JSON: library -> version), CommandLine; attributes `ranks` and `seed` of the group. Equal runs write equal records.
/// Collective.
void writeProvenance(const Run& run, Hdf5Writer& file);

/// Names of the materials of bodies and regions, without duplicates; the field Material contains indices into this list. Local.
std::vector<std::string> materialNames(const ElasticModel& model);

/// Names needed for plots: texts Bodies and Subdomains (JSON lists in the order of the numbers in the fields), and for each side group of
/// the mesh a dataset `/Record/SideGroups/<name>`, one row per side: x, y, z of its first and second end point. As field data, shown by
/// ParaView: BodyNames, MaterialNames, SubdomainNames, in the order of the numbers in the fields, and GroupNames. Collective.
void writeNames(const Run& run, VtkHdf& file);

}  // namespace suture
