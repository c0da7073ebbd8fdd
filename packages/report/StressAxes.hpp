#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// Turns stresses to the axes in which a run writes their components (`Output/Stress Axes`): the global ones, or those that turn with a
/// body that moves far. Local. \param stresses  rows as in elementStresses()
Matrix inStressAxes(const Run& run, const SubdomainMesh& mesh, const Matrix& stresses);
/// These axes in words.
std::string stressAxesText(const Run& run);

}  // namespace suture
