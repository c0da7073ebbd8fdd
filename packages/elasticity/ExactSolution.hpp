#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Known parts of the exact solution of a body, as functions of the position in the undeformed body.
struct ExactFields {
  std::vector<Expression> displacement;  ///< x, y (3D: and z); or none [length]
  /// Tension positive, or none [stress]. 2D: xx, yy, xy, and zz, which follows from the model; 3D: as StressVector<3>.
  std::vector<Expression> stress;
};

/// The scene's list `Exact Solution`, against which errors are measured. Empty for most scenes.
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
/// \param problems  receives invalid expressions, a field with missing components or given for some bodies only, a component that does not
/// exist in this dimension, an unknown body
ExactSolution readExactSolution(const Parameters& list, const std::vector<std::string>& bodies, int dimension, const Constants& constants,
                                Problems& problems);

}  // namespace suture
