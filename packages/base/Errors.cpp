#include "Errors.hpp"

#include <algorithm>
#include <cctype>

namespace suture {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Edit distance in which a swap of two adjacent letters, the most common typing error, counts once.
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

constexpr std::size_t longestWord = 200, longestLine = 4000;

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// A text that is already cut stays as it is: a message may pass through several errors.
std::string cut(const std::string& text, std::size_t most) {
  if (text.size() <= most || (text.size() <= most + 3 && endsWith(text, "...")) ||
      (text.size() <= most + 40 && endsWith(text, " characters)")))
    return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not inside a UTF-8 character
  return text.substr(0, end) + "... (" + std::to_string(text.size()) + " characters)";
}

std::vector<Problem> allShortened(std::vector<Problem> problems) {
  for (Problem& problem : problems) {
    problem.path = shortened(problem.path);
    problem.message = shortened(problem.message);
  }
  return problems;
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

std::string shortened(const std::string& message) {
  if (message.size() <= longestWord) return message;
  std::string all, line;
  const auto endLine = [&] {
    all += cut(line, longestLine);
    line.clear();
  };
  for (std::size_t i = 0; i < message.size();) {
    const char c = message[i];
    if (c == '\n') {
      endLine();
      all += '\n';
      ++i;
      continue;
    }
    // A quotation begins after a blank or a bracket; an apostrophe within a word does not begin one.
    const bool opens = c == '\'' && (i == 0 || std::isspace(static_cast<unsigned char>(message[i - 1])) || message[i - 1] == '(');
    const std::size_t close = opens ? message.find('\'', i + 1) : std::string::npos;
    if (close != std::string::npos) {
      line += "'" + cut(message.substr(i + 1, close - i - 1), longestWord) + "'";
      i = close + 1;
    } else {
      const std::size_t end = std::min(message.find_first_of(" \n'", i + 1), message.size());
      line += cut(message.substr(i, end - i), longestWord);
      i = end;
    }
  }
  endLine();
  return all;
}

InputError::InputError(std::vector<Problem> problems)
    : Error(ExitCode::Input, lines(problems)), problems_(allShortened(std::move(problems))) {}

std::string nearestName(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string wanted = lower(name);
  if (wanted.empty()) return "";
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, wanted.size() / 3) + 1;  // at most one letter in three may be wrong
  for (const std::string& candidate : candidates) {
    const std::size_t distance = editDistance(wanted, lower(candidate));
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty() || wanted.size() < 3) return nearest;
  // "Young" is far from "Young Modulus" in edit distance but clearly meant.
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
