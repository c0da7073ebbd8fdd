#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/quality/Balance.hpp>
#include <suture/quality/answers/Reactions.hpp>

#include <string>
#include <vector>

namespace suture {

/// One quantity of the verdict, where it comes closest to its bound or exceeds it most.
struct Check {
  std::string name;    ///< as in summary.json
  double value = 0.0;  ///< relative to the body's own forces or deformation
  double bound = 0.0;  ///< allowed by the tolerance and the rounding of displacements, relative to the same
  std::string where;   ///< body and place, or pair, place and bodies; empty: nothing to check
  std::string advice;  ///< remedy when the bound is exceeded

  bool holds() const { return value <= bound; }  // not, when one is NaN
};

/// The verdict on a run, and its forces: their balance, and one by one.
struct Verification {
  std::vector<Check> checks;
  Balance balance;
  Reactions reactions;
  std::vector<BodyForces> forces;  ///< what acts on each body

  bool holds() const;
  /// The check that uses most of its bound, slides and offsets within theirs aside; null without checks.
  const Check* worst() const;
  /// "penetration 1.2e-03 exceeds 1.0e-06 at ...; try ..."; of all checks that do not hold; empty if all do.
  std::string failure() const;
};

}  // namespace suture
