#pragma once
#include <suture/base/scene/Schema.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// The list `Accuracy` of a scene: the error that the answer may have, and the limits of the meshes on which it is sought.
struct AccuracyRequest {
  static constexpr const char* kEnergy = "Energy";

  double error = 0.0;  ///< largest relative error of the quantity
  std::string quantity = kEnergy;
  int order = 0;             ///< order of the elements; 0: second order, unless the list Mesh has an order
  bool keepsCurves = false;  ///< second-order sides follow curves
  long long mostUnknowns = 0;
  double mostSeconds = 0.0;  ///< time limit of the whole run; 0: none [s]
  int mostLevels = 0;

  static Schema schema();
  /// The request in the settings of a scene; nothing if it has none. Local.
  static std::optional<AccuracyRequest> of(const Parameters& settings);
};

/// One mesh of a run with a request for accuracy. \see AccuracyReached
struct AccuracyLevel {
  long long unknowns = 0, elements = 0;
  double error = 0.0;              ///< error in the energy norm, relative: bound or estimate
  bool strict = false;             ///< a bound
  std::optional<double> geometry;  ///< relative effect of straight sides in place of curved ones, estimated; nothing: not known
  double seconds = 0.0;            ///< wall clock of this level: mesh, solution, error
  int iterations = 0;              ///< conjugate gradient iterations, with those of the auxiliary problem
  int outer = 0;                   ///< outer iterations
  double energy = 0.0;             ///< total potential energy
  double value = 0.0;              ///< value of the requested quantity
  std::string refinement;          ///< origin of the mesh: "start", "size field", "bisection", "uniform"
};

/// Result of a request for accuracy.
struct AccuracyReached {
  double requested = 0.0;
  std::string quantity;
  double reached = 0.0;            ///< relative error of the quantity
  bool strict = false;             ///< `reached` is a bound, otherwise an estimate
  std::optional<double> geometry;  ///< see AccuracyLevel::geometry
  std::string
      limit;  ///< limit that ended the search: "unknowns", "memory", "time", "levels", "mesh", "solution"; empty: the request is met
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
