#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/PairResult.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Evaluates the exact solution wherever exactErrors() will, with side A for the pressure: better before the solution than after it.
/// Collective. \param contact  the scene's list `Contact`. \throws InputError  an expression has no finite value (place)
void checkExactSolution(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& contact);

/// Errors of a solution against the scene's exact one, as far as it gives it, under their names in summary.json: displacement_l2,
/// energy_norm (that of the difference of stresses), pressure_l2 (of pressureField(), along all contacts), and each `..._relative` to
/// the same norm of the exact field unless that is zero. Empty for a scene without Exact Solution. The same on all ranks.
/// Collective. \param contact  the scene's list `Contact`;  \param displacement  of each mesh, beside its lift, node-major, Cartesian;
/// \param pairs  on rank 0: all
/// \throws InputError  an expression has no finite value (place)
std::map<std::string, double> exactErrors(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                          const Parameters& contact, const std::vector<Vector>& displacement,
                                          const std::vector<PairResult>& pairs);

}  // namespace suture
