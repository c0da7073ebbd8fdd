#pragma once
#include <suture/quality/Verification.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Quantities of the verdict that are within their bounds, and large enough for a warning: the worst of each in one or several answers. A
/// path of load steps may end where nothing is seen of what happened on the way. Local, the same on all ranks.
class Doubts {
 public:
  /// \param when  of the answer: ", t = 0.5"; empty: it is the only one
  void add(const Verification& verdict, const std::string& when = "");
  /// A sentence for each that is beyond doubt.
  std::vector<std::string> warnings() const;

 private:
  std::map<std::string, Check> worst_;  // by name
};

}  // namespace suture
