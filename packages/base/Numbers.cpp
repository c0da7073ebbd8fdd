#include "Numbers.hpp"

#include <charconv>
#include <cmath>

namespace suture {
namespace {

template <typename T>
std::optional<T> parseWhole(const std::string& raw) {
  std::string text = trimmed(raw);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.erase(0, 1);  // from_chars accepts no plus sign
  T value{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || error != std::errc() || stopped != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parseReal(const std::string& text) {
  const std::optional<double> value = parseWhole<double>(text);
  if (value && !std::isfinite(*value)) return std::nullopt;  // from_chars accepts "nan" and "inf"
  return value;
}

std::optional<int> parseInteger(const std::string& text) { return parseWhole<int>(text); }

std::optional<std::vector<std::string>> parseEntries(const std::string& raw) {
  std::string text = trimmed(raw);
  const bool opens = !text.empty() && text.front() == '{';
  const bool closes = !text.empty() && text.back() == '}';
  if (opens != closes || (opens && text.size() < 2)) return std::nullopt;
  if (!opens) return text.empty() ? std::nullopt : std::optional<std::vector<std::string>>({text});

  text = trimmed(text.substr(1, text.size() - 2));
  std::vector<std::string> entries;
  if (text.empty()) return entries;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t end = 0; end <= text.size(); ++end) {
    const bool last = end == text.size();
    if (!last) depth += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
    if (depth < 0 || (last && depth > 0)) return std::nullopt;
    if (!last && (text[end] != ',' || depth > 0)) continue;
    entries.push_back(trimmed(text.substr(begin, end - begin)));
    if (entries.back().empty()) return std::nullopt;
    begin = end + 1;
  }
  return entries;
}

std::string realText(double value) {
  char text[40];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return error == std::errc() ? std::string(text, end) : std::to_string(value);
}

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? std::string() : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

}  // namespace suture
