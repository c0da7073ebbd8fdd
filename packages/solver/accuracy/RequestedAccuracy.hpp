#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/solver/MakeSubdomains.hpp>
#include <suture/solver/accuracy/AutomaticTolerance.hpp>

#include <vector>

namespace suture {

/// True if the settings request a largest error (Accuracy/Error), for which the mesh is refined. Local.
bool refinesMesh(const Parameters& settings);

/// True if the tolerance in the settings is Automatic. Local.
bool isAutomatic(const Parameters& settings);

/// The relative algebraic error required by the tolerance: a tenth of the estimated discretisation error if it is Automatic. Local.
double requestedAccuracy(const Parameters& settings, const Solution& solution);

/// Estimator of the discretisation error for an automatic tolerance. All arguments must outlive it. Collective, and so is its call. The
/// error expected for n nodes is 3 n^(-1/2) with linear cells, 6 / n with quadratic ones: a multiple of that of smooth solutions, because
/// those with corners or contact have larger errors. (Measured: V5 on 64 x 64 cells T3 1.2, Q4 0.4
/// of n^(-1/2), T6 1.5, Q9 0.3 of 1 / n; tunnel, hertz 3 to 4 of n^(-1/2).)
AutomaticTolerance::Estimate discretisationErrorOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                                   const Subdomains& subdomains);

}  // namespace suture
