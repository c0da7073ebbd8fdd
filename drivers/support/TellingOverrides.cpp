#include "TellingOverrides.hpp"

#include <suture/simulation/Overrides.hpp>

namespace suture {

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
