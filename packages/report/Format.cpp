#include <cstdarg>
#include <cstdio>
#include <suture/report/Format.hpp>

namespace suture {

std::string format(const char* pattern, ...) {
  va_list arguments, again;
  va_start(arguments, pattern);
  va_copy(again, arguments);
  std::string text(std::size_t(std::vsnprintf(nullptr, 0, pattern, arguments)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, pattern, again);
  va_end(again);
  va_end(arguments);
  return text;
}

std::string grouped(long long number) {
  std::string digits = std::to_string(number < 0 ? -number : number);
  for (int at = int(digits.size()) - 3; at > 0; at -= 3) digits.insert(std::size_t(at), ",");
  return number < 0 ? "-" + digits : digits;
}

std::string counted(long long number, const std::string& noun) { return grouped(number) + " " + noun + (number == 1 ? "" : "s"); }

std::string shellCommand(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    const bool quote = word.empty() || word.find_first_of(" \t\"'$*?()<>|&;\\{}") != std::string::npos;
    std::string quoted = word;
    for (std::size_t at = 0; quote && (at = quoted.find('\'', at)) != std::string::npos; at += 4) quoted.replace(at, 1, "'\\''");
    text += (text.empty() ? "" : " ") + (quote ? "'" + quoted + "'" : word);
  }
  return text;
}

}  // namespace suture
