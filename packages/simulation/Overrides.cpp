#include <suture/base/Numbers.hpp>
#include <suture/simulation/Overrides.hpp>

#include <algorithm>

namespace suture {

std::string overridePath(const std::string& assignment) {
  const std::string path = assignment.substr(0, assignment.find('='));
  std::string result;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    result += (begin > 0 ? "/" : "") + trimmed(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

void setOverride(std::vector<std::string>& overrides, const std::string& assignment) {
  const std::string path = overridePath(assignment);
  const auto known =
      std::find_if(overrides.begin(), overrides.end(), [&](const std::string& other) { return overridePath(other) == path; });
  if (known == overrides.end())
    overrides.push_back(assignment);
  else
    *known = assignment;
}

}  // namespace suture
