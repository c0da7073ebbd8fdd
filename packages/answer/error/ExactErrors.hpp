#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Evaluates the exact solution at every point that exactErrors() uses, with side A for the pressure, so that errors show up before the
/// solution starts. Collective. \param contact  the scene's list `Contact`. \throws InputError  if an expression has no finite value (names
/// the position)
void checkExactSolution(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& contact);

/// Errors of a solution against the scene's exact one, for the fields it gives, with their names in summary.json: displacement_l2,
/// energy_norm (of the stress difference), pressure_l2 (of pressureField(), along all contacts), and each `..._relative` to the same norm
/// of the exact field unless that is zero. Empty for a scene without Exact Solution. The same on all ranks. Collective. \param contact  the
/// scene's list `Contact`;  \param displacement  of each mesh, without its lift, node-major, Cartesian;
/// \param pairs  on rank 0: all
/// \throws InputError  if an expression has no finite value (names the position)
std::map<std::string, double> exactErrors(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                          const Parameters& contact, const std::vector<Vector>& displacement,
                                          const std::vector<PairResult>& pairs);

}  // namespace suture
