#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Exact solution of a body, as far as it is known, as functions of the place on the undeformed body.
struct ExactFields {
  std::vector<Expression> displacement;  ///< x, y, in space z; or none [length]
  /// Tension positive, or none [stress]. In the plane xx, yy, xy, and zz, which there follows from the model; in space as StressVector<3>.
  std::vector<Expression> stress;
};

/// The scene's list `Exact Solution`: what a run's errors are measured against. Empty for most scenes.
struct ExactSolution {
  std::vector<ExactFields> ofBody;     ///< in the order of the scene's bodies
  std::optional<Expression> pressure;  ///< on contact lines or surfaces, > 0 compressive [stress]

  bool hasDisplacement() const { return !ofBody.empty() && !ofBody[0].displacement.empty(); }
  bool hasStress() const { return !ofBody.empty() && !ofBody[0].stress.empty(); }
  bool empty() const { return !hasDisplacement() && !hasStress() && !pressure; }
};

/// The list's schema.
Schema exactSolutionSchema();

/// Local, the same on all ranks.
/// \param problems  gets expressions that cannot be read, a field of which only some components are given or that is known of some bodies
///                  only, a component that a scene of this dimension does not have, an unknown body
ExactSolution readExactSolution(const Parameters& list, const std::vector<std::string>& bodies, int dimension, const Constants& constants,
                                Problems& problems);

}  // namespace suture
