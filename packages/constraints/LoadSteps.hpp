#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Steps in which the loads of a scene come, its list `Load Steps`: times, and for named boundary conditions factors that their loads or
/// prescribed displacements are multiplied by, functions of the time. All other conditions act in full from the first step on. The path
/// begins at the time 0 with undeformed bodies. Local.
class LoadSteps {
 public:
  /// Name and type of a boundary condition.
  using Named = std::pair<std::string, std::string>;

  /// None: a scene is solved once, with all conditions in full.
  LoadSteps() = default;
  static Schema schema();
  /// \param list  resolved;  \param conditions  of the scene
  /// \throws InputError  all of: times that do not ascend, conditions that do not exist (nearest name) or have no amount, expressions,
  /// tables of another length than the times
  LoadSteps(const Parameters& list, const std::vector<Named>& conditions, const Constants& constants);

  bool empty() const { return times_.empty(); }
  /// Ends of the steps that the scene names, ascending, above 0.
  const std::vector<double>& times() const { return times_; }
  /// Number of distinct factors. Number 0 is the constant one.
  int factors() const { return 1 + static_cast<int>(functions_.size()); }
  /// Number of a condition's factor; 0 for one without.
  int factorOf(const std::string& condition) const;
  /// All factors at a time, by their numbers. \throws InputError  an expression is not finite then
  std::vector<double> at(double time) const;

  double largestChange() const { return largestChange_; }  ///< part of the pairs that may change in a step
  int halvings() const { return halvings_; }               ///< most halvings of a step of the scene

 private:
  /// An expression in t, or values at the times.
  struct Function {
    std::vector<Expression> expression;  // one, or none
    std::vector<double> table;
  };
  Function readFunction(const Parameters& list, const std::string& name, const Constants& constants, Problems& problems) const;

  std::vector<double> times_;
  std::vector<Function> functions_;
  std::map<std::string, int> factorOf_;
  double largestChange_ = 1.0;
  int halvings_ = 0;
};

}  // namespace suture
