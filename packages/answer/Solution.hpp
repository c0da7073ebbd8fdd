#pragma once
#include <suture/answer/Balancing.hpp>
#include <suture/answer/OuterFigures.hpp>
#include <suture/answer/PairResult.hpp>
#include <suture/answer/bound/ErrorBound.hpp>
#include <suture/answer/values/ErrorBars.hpp>
#include <suture/answer/values/Extremes.hpp>
#include <suture/answer/values/ForceInterval.hpp>
#include <suture/answer/values/RigidGroupMotions.hpp>
#include <suture/answer/values/SafetyFactors.hpp>
#include <suture/answer/verdict/Verification.hpp>
#include <suture/base/Types.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// A rigid motion of a body that the solution does not determine: it changes no pair force, and no load drives it.
struct NeutralMotion {
  std::string body;
  std::string words;        ///< "turn about (3, 4), clockwise"
  bool loaded = false;      ///< forces act on the body, so its position matters
  bool bothSenses = false;  ///< free in both senses; else only away from touching pairs
  /// The smallest displacement is chosen; false: the displacement is kept, because with friction it depends on the path.
  bool least = true;
};

/// Contact forces that equilibrium does not determine: pairs of these contacts can share their forces in several ways.
struct UndeterminedForces {
  std::vector<std::string> contacts;  ///< in the order of the scene
  int pairs = 0;                      ///< number of pairs concerned
  std::vector<std::string> totals;    ///< contacts among them whose total force is determined

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.contacts), each(self.pairs), each(self.totals);
  }
};

/// Result of a run, with the figures reported in summary.json.
struct Solution : OuterFigures {
  std::string undetermined;            ///< bodies that are free to move at the solution, if the scene does not allow this; else empty
  std::vector<NeutralMotion> neutral;  ///< see settleNeutralMotions()
  std::vector<UndeterminedForces> sharedForces;  ///< see settleContactForces()
  /// One vector per subdomain of this rank, in the order of distribute(), without its lift: node-major, Cartesian [length].
  std::vector<Vector> displacement;
  /// Displacements since the time of `Output/Displacements Since`, likewise; empty up to that time.
  std::vector<Vector> since{};
  std::optional<double> sinceTime{};            ///< that time, if `since` is known; the same on all ranks
  std::vector<RigidGroupMotion> rigidGroups{};  ///< motions of the rigid groups, on rank 0
  std::optional<Balancing> balancing{};         ///< only with `Output/Error Bound`, see balanceForces()
  std::string notBalanced{};                    ///< reason why `balancing` is missing although it was requested; else empty
  std::optional<double> meshError;  ///< averagedEstimate(): relative discretisation error in the energy norm, if no better estimate exists
  std::optional<ErrorBound> bound;  ///< bound of the error in the energy norm, if requested
  std::map<int, Matrix> ownStresses;  ///< Subdomain::stresses() of this rank's subdomains that have their own physics, by place
  std::vector<Matrix> nodalStresses;  ///< by subdomain: see nodalStresses(); empty if not requested
  std::vector<PairResult> pairs;      ///< on rank 0: all, by id
  std::vector<PairResult> onAxis;     ///< on rank 0: see axisResults()

  std::string outerSolver;                 ///< "" for a scene without unilateral contact
  double energy = 0.0;                     ///< total potential energy a(u,u)/2 - L(u)
  Verification verification;               ///< checks (empty before verify()) and the balance of forces
  Extremes extremes;                       ///< see findExtremes()
  std::optional<ErrorBars> errorBars{};    ///< if requested and the run converged
  std::vector<ForceInterval> intervals{};  ///< strict bounds of forces, if requested; the same on all ranks
  SafetyFactors safety;                    ///< see findSafety(); with load steps the least factors over all steps
  std::map<std::string, double> errors;    ///< against the exact solution of the scene, if any: see exactErrors()

  /// True if the run converged, the verdict holds, and no loaded body is free to move.
  bool isValid() const { return converged && undetermined.empty() && verification.holds(); }
};

}  // namespace suture
