#pragma once
#include <suture/report/AccuracyRequest.hpp>
#include <suture/simulation/SceneParts.hpp>
#include <suture/simulation/accuracy/LevelError.hpp>

#include <optional>
#include <string>

namespace suture {

/// Value of the quantity of a request for accuracy in the solution on one mesh, and its estimated error. The same on all ranks.
struct QuantityError {
  double value = 0.0;      ///< [force, length or stress]
  double error = 0.0;      ///< estimated [likewise]
  double order = 1.0;      ///< power of the relative error in the energy norm to which the error is proportional
  bool isComplete = true;  ///< false: the error requires the value on another mesh
  std::string why{};       ///< why there is no relative error: the exact value is infinite, or it is zero; else empty

  double relative() const;  ///< NaN if there is none
};

/// Forces and mean displacements: as error bars (ErrorBars). The largest pressure: its change from the previous mesh, plus the estimated
/// stress error of the elements at its place; it is not complete without a previous mesh. Collective.
/// \param solution  judged, with error bars \param before  value on the previous mesh
QuantityError quantityError(const SceneParts& parts, const Solution& solution, const AccuracyRequest& request,
                            const std::optional<double>& before);

/// Refuses a quantity of a contact or condition that the scene does not have; names the only contact if the request names none. Local.
/// \param conditions  names of all boundary conditions \throws InputError  with the nearest name
void checkQuantity(AccuracyRequest& request, const std::vector<std::string>& conditions, const std::vector<std::string>& contacts);

/// Refuses a side group that the mesh does not have. Collective. \throws InputError  with the nearest name
void checkQuantity(const Comm& comm, const AccuracyRequest& request, const std::vector<SubdomainMesh>& meshes);

}  // namespace suture
