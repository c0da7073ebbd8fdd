#pragma once
#include <suture/answer/values/Reactions.hpp>
#include <suture/answer/verdict/Balance.hpp>
#include <suture/base/ForceScale.hpp>

#include <string>
#include <vector>

namespace suture {

/// One quantity of the verdict, at the place where it uses most of its bound.
struct Check {
  std::string name;    ///< as in summary.json
  double value = 0.0;  ///< relative to the body's own forces or deformation
  double bound = 0.0;  ///< allowed by the tolerance and by round-off of displacements, relative to the same
  std::string where;   ///< body and position, or pair, position and bodies; empty: nothing to check
  std::string advice;  ///< remedy if the bound is exceeded; empty: none

  bool holds() const { return value <= bound; }  // false for NaN
};

/// The verdict on a run, and its forces: their balance and the individual resultants.
struct Verification {
  std::vector<Check> checks;
  Balance balance;
  Reactions reactions;
  std::vector<BodyForces> forces;  ///< forces on each body

  bool holds() const;
  /// The check that uses most of its bound, not counting slides and offsets within their bounds; null without checks.
  const Check* worst() const;
  /// "penetration 1.2e-03 exceeds 1.0e-06 at ...; try ..."; for all checks that do not hold; empty if all hold.
  std::string failure() const;
};

}  // namespace suture
