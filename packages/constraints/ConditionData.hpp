#pragma once
#include <suture/base/Expression.hpp>

#include <vector>

namespace suture {

/// Values of a boundary condition, one per component: a number, or a function of position.
struct ConditionData {
  std::vector<double> values;
  std::vector<Expression> expressions;  ///< instead of values

  /// Value of component i at a point. \throws InputError  an expression has no finite value there. Local.
  double at(std::size_t i, const Point& point) const { return expressions.empty() ? values[i] : expressions[i].at(point); }
};

/// Reads `Value`, or else the expressions of the type (ConditionForm: `Expression x`, `Expression y`, ..., or `Expression`), of one entry
/// of `Boundary Conditions` that has data; components that a Displacement leaves free have neither. Local.
/// \param problems  gets: no data, both kinds of data, a wrong number of values, a surplus, missing or unreadable expression
ConditionData readConditionData(const Parameters& condition, const Constants& constants, Problems& problems, int dimension = 2);

/// Names of all parameters that hold expressions, for all types.
const std::vector<std::string>& expressionNames();

}  // namespace suture
