#pragma once
#include <suture/base/Point.hpp>
#include <suture/base/scene/Schema.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// The list `Accuracy` of a scene: the error that the answer may have, and the limits of the meshes on which it is sought.
struct AccuracyRequest {
  static constexpr const char *kEnergy = "Energy", *kContactForce = "Contact Force", *kReaction = "Reaction",
                              *kMeanDisplacement = "Mean Displacement", *kLargestPressure = "Largest Pressure";

  double error = 0.0;              ///< largest relative error of the quantity
  std::string quantity = kEnergy;  ///< one of the names above
  std::string object{};            ///< its contact, condition or side group; a contact may be empty: the only one, for a pressure all
  Point direction{0, 0, 0};        ///< direction of a mean displacement, not normalised
  int order = 0;                   ///< order of the elements; 0: second order, unless the list Mesh has an order
  bool keepsCurves = false;        ///< second-order sides follow curves
  long long mostUnknowns = 0;
  double mostSeconds = 0.0;  ///< time limit of the whole run; 0: none [s]
  int mostLevels = 0;

  bool isEnergy() const { return quantity == kEnergy; }
  /// "the energy norm", "the force of contact 'joint'"
  std::string name() const;

  static Schema schema();
  /// The request in the settings of a scene; nothing if it has none. Local. \throws InputError  a direction of a wrong length
  static std::optional<AccuracyRequest> of(const Parameters& settings);
};

/// One mesh of a run with a request for accuracy. \see AccuracyReached
struct AccuracyLevel {
  long long unknowns = 0, elements = 0;
  double error = 0.0;                ///< relative error of the requested quantity: bound or estimate; NaN: it has none
  bool strict = false;               ///< a bound
  double seconds = 0.0;              ///< wall clock of this level: mesh, solution, error
  int iterations = 0;                ///< conjugate gradient iterations, with those of the auxiliary problem
  int outer = 0;                     ///< outer iterations
  double energy = 0.0;               ///< total potential energy
  std::string refinement;            ///< origin of the mesh: "start", "size field", "bisection", "uniform"
  std::optional<double> geometry{};  ///< relative effect of straight sides in place of curved ones, estimated; nothing: not known
  std::optional<double> estimate{};  ///< relative error in the energy norm, estimated from recovered stresses
  /// If the quantity is not the energy norm: its value, and the relative error in the energy norm, by which meshes are refined.
  std::optional<double> value{}, energyError{};
};

/// Result of a request for accuracy.
struct AccuracyReached {
  double requested = 0.0;
  std::string quantity;              ///< AccuracyRequest::name(); "Energy" for the energy norm
  double reached = 0.0;              ///< relative error of the quantity
  bool strict = false;               ///< `reached` is a bound, otherwise an estimate
  std::optional<double> geometry{};  ///< only for the energy norm: AccuracyLevel::geometry
  std::string limit;  ///< limit that ended the search: "unknowns", "memory", "time", "levels", "mesh", "solution", "quantity"; empty: the
                      ///< request is met
  std::string why{};  ///< with the limit "quantity": why the quantity has no relative error
  std::vector<AccuracyLevel> levels;
  /// Predicted cost of uniform refinement to the same error.
  struct Uniform {
    int order = 0;
    double unknowns = 0.0, seconds = 0.0;
  };
  std::optional<Uniform> uniform;

  bool isMet() const { return limit.empty(); }
  /// `reached` with the effect of straight sides: their squares add up, as differences of the energy.
  double total() const;
  /// "error of 2.3 % instead of 1 %, ended by Accuracy/Most Unknowns"; empty if the request is met.
  std::string failure() const;
};

}  // namespace suture
