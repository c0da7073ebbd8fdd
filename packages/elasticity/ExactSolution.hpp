#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Exact solution of a body, as far as it is known, as functions of the place on the undeformed body.
struct ExactFields {
  std::vector<Expression> displacement;  ///< x, y; or none [length]
  std::vector<Expression> stress;  ///< xx, yy, xy, tension positive, or none [stress]; and zz, which in the plane follows from the model
};

/// The scene's list `Exact Solution`: what a run's errors are measured against. Empty for most scenes.
struct ExactSolution {
  std::vector<ExactFields> ofBody;     ///< in the order of the scene's bodies
  std::optional<Expression> pressure;  ///< on contact lines, > 0 compressive [stress]

  bool hasDisplacement() const { return !ofBody.empty() && !ofBody[0].displacement.empty(); }
  bool hasStress() const { return !ofBody.empty() && !ofBody[0].stress.empty(); }
  bool empty() const { return !hasDisplacement() && !hasStress() && !pressure; }
};

/// The list's schema.
Schema exactSolutionSchema();

/// Local, the same on all ranks.
/// \param problems  gets expressions that cannot be read, a field of which only some components are given or that is known of some bodies
///                  only, an unknown body
ExactSolution readExactSolution(const Parameters& list, const std::vector<std::string>& bodies, const Constants& constants,
                                Problems& problems);

}  // namespace suture
