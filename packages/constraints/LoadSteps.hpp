#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Load steps of a scene, its list `Load Steps`: times, and factors of named boundary conditions as functions of time, which multiply their
/// loads or prescribed displacements. All other conditions act in full from the first step on. The path starts at time 0 with undeformed
/// bodies. Local.
class LoadSteps {
 public:
  /// Name and type of a boundary condition.
  using Named = std::pair<std::string, std::string>;

  /// No load steps: the scene is solved once, with all conditions in full.
  LoadSteps() = default;
  static Schema schema();
  /// \param list  resolved;  \param conditions  of the scene
  /// \throws InputError  all of: times that do not ascend, conditions that do not exist (nearest name) or have no amount, expressions,
  /// tables whose length differs from that of the times
  LoadSteps(const Parameters& list, const std::vector<Named>& conditions, const Constants& constants);

  bool empty() const { return times_.empty(); }
  /// Ends of the steps given in the scene, ascending, above 0.
  const std::vector<double>& times() const { return times_; }
  /// Number of distinct factors. Number 0 is the constant one.
  int factors() const { return 1 + static_cast<int>(functions_.size()); }
  /// Number of a condition's factor; 0 for a condition without one.
  int factorOf(const std::string& condition) const;
  /// All factors at a time, by their numbers. \throws InputError  an expression is not finite at that time
  std::vector<double> at(double time) const;

  double largestChange() const { return largestChange_; }  ///< fraction of the pairs that may change in a step
  int halvings() const { return halvings_; }               ///< maximum number of halvings of a scene's step

 private:
  /// Expression in t, or values at the times.
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
