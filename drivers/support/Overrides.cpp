#include "Overrides.hpp"

#include <algorithm>
#include <suture/base/Numbers.hpp>

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

int overrideOf(const Problem& problem, const std::vector<std::string>& overrides) {
  const auto begins = [](const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; };
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const std::string path = overridePath(overrides[i]);
    if (problem.path == path || begins(path, problem.path + "/") || begins(problem.message, "'" + overrides[i] + "'"))
      return static_cast<int>(i);
  }
  return -1;
}

ExitCode tellingOverrides(const std::vector<std::string>& overrides, const std::function<ExitCode()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems)
      if (const int i = overrideOf(problem, overrides); i >= 0) problem.message += "\ngiven on the command line: " + overrides[i];
    throw InputError(problems);
  }
}

}  // namespace suture
