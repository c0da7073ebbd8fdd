#pragma once
#include <suture/base/Expression.hpp>

#include <vector>

namespace suture {

/// Value of a boundary condition for each of its components: a number, or a function of the place.
struct ConditionData {
  std::vector<double> values;
  std::vector<Expression> expressions;  ///< instead of values

  /// Value of component i at a point. \throws InputError  an expression has no finite value there. Local.
  double at(std::size_t i, const Point& point) const { return expressions.empty() ? values[i] : expressions[i].at(point); }
};

/// Reads `Value`, or else the expressions of the type (ConditionForm: `Expression x`, `Expression y`, ..., or `Expression`), of one entry
/// of `Boundary Conditions`; components that a Displacement leaves free have neither. For the types that have data. Local.
/// \param problems  gets: no data, both kinds of data, a wrong number of values, an expression too many or too few, one that cannot be read
ConditionData readConditionData(const Parameters& condition, const Constants& constants, Problems& problems, int dimension = 2);

/// The names of the parameters that hold expressions, of all types.
const std::vector<std::string>& expressionNames();

}  // namespace suture
