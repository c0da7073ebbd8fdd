#pragma once
#include <suture/answer/verdict/Verification.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Quantities of the verdict that are within their bounds but large enough for a warning: the worst value of each over one or several
/// solutions, because intermediate load steps may be worse than the last one. Local, the same on all ranks.
class Doubts {
 public:
  /// \param when  time of the solution: ", t = 0.5"; empty if there is only one
  void add(const Verification& verdict, const std::string& when = "");
  void add(const Doubts& others);
  /// One sentence for each quantity above its warning threshold.
  std::vector<std::string> warnings() const;

 private:
  std::map<std::string, Check> worst_;  // by name
};

}  // namespace suture
