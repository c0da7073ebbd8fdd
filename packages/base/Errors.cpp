#include "Errors.hpp"

#include <algorithm>
#include <cctype>

namespace suture {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Edit distance in which swapping two neighbours counts once: the commonest slip of a typing hand.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({change, last[j] + 1, now[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(now);
  }
  return last[b.size()];
}

std::string lines(const std::vector<Problem>& problems) {
  std::string all;
  for (const Problem& problem : problems) {
    if (!all.empty()) all += '\n';
    if (!problem.path.empty()) all += problem.path + ": ";
    all += problem.message;
  }
  return all;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems) : Error(ExitCode::Input, lines(problems)), problems_(std::move(problems)) {}

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string wanted = lower(name);
  if (wanted.empty()) return "";
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, wanted.size() / 3) + 1;  // one letter in three may be wrong, not more
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(wanted, lower(candidate));
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty() || wanted.size() < 3) return nearest;
  // "Young" is far from "Young Modulus" in letters, yet surely meant.
  for (const std::string& candidate : candidates) {
    if (lower(candidate).compare(0, wanted.size(), wanted) == 0) return candidate;
  }
  return "";
}

std::string suggestion(const std::string& name, std::vector<std::string> candidates) {
  if (candidates.empty()) return " None are known here.";
  std::sort(candidates.begin(), candidates.end());
  const std::string nearest = nearestName(name, candidates);
  return (nearest.empty() ? "" : " Did you mean '" + nearest + "'?") + (" Known here: " + joinNames(candidates));
}

std::string unknownName(const std::string& kind, const std::string& name, const std::vector<std::string>& candidates) {
  return "no such " + kind + " '" + name + "'." + suggestion(name, candidates);
}

std::string joinNames(const std::vector<std::string>& names, std::size_t most) {
  std::string all;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) all += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most) all += " ... (" + std::to_string(names.size()) + " in all)";
  return all;
}

}  // namespace suture
