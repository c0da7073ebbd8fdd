#pragma once
#include <suture/base/Types.hpp>
#include <suture/quality/PairResult.hpp>
#include <suture/quality/Verification.hpp>
#include <suture/quality/answers/Extremes.hpp>
#include <suture/solver/OuterFigures.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// A rigid motion of a body that a solution does not determine: it changes no pair force, and no load drives it.
struct NeutralMotion {
  std::string body;
  std::string words;        ///< "turn about (3, 4), clockwise"
  bool loaded = false;      ///< forces act on the body: its place matters
  bool bothSenses = false;  ///< free forwards and backwards; else only away from pairs that touch
  bool least = true;        ///< the least displacement is kept; with friction, where the way there tells, it stays as it was found
};

/// Contact forces that equilibrium does not determine: pairs of these contacts can share their forces in several ways.
struct UndeterminedForces {
  std::vector<std::string> contacts;  ///< in the order of the scene
  int pairs = 0;                      ///< whose forces are concerned
  std::vector<std::string> totals;    ///< contacts among them whose total force is determined all the same

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.contacts), each(self.pairs), each(self.totals);
  }
};

/// The answer of a run and the figures that summary.json reports.
struct Solution : OuterFigures {
  std::string undetermined;            ///< bodies that are free to move at the solution, where the scene does not allow that; else empty
  std::vector<NeutralMotion> neutral;  ///< see settleNeutralMotions()
  std::vector<UndeterminedForces> sharedForces;  ///< see settleContactForces()
  /// One vector for each subdomain of this rank, in the order of distribute(), beside its lift: node-major, Cartesian [length].
  std::vector<Vector> displacement;
  std::optional<double> meshError;    ///< averagedEstimate(): relative error of the mesh in the energy norm, where nothing better is known
  std::map<int, Matrix> ownStresses;  ///< Subdomain::stresses() of those of this rank with physics of their own, by place
  std::vector<Matrix> nodalStresses;  ///< by subdomain: see nodalStresses(); empty if nobody asked for them
  std::vector<PairResult> pairs;      ///< on rank 0: all, by id
  std::vector<PairResult> onAxis;     ///< on rank 0: see axisResults()

  std::string outerSolver;               ///< "" for a scene without unilateral contact
  double energy = 0.0;                   ///< total potential energy a(u,u)/2 - L(u)
  Verification verification;             ///< and the balance of forces; without checks before verify()
  Extremes extremes;                     ///< see findExtremes()
  std::map<std::string, double> errors;  ///< against the scene's exact solution, where it has one: see exactErrors()
};

}  // namespace suture
