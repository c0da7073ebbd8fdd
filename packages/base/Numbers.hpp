#pragma once
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Strict numbers: the whole text (blanks around it aside) must be one finite number; the locale plays no part. Local.
/// "3.7" is no integer, "1e-8x", "", "nan", "inf" and "1e999" are nothing at all.
std::optional<double> parseReal(const std::string& text);
std::optional<int> parseInteger(const std::string& text);

/// The entries of "{a, b}", trimmed; a text without braces is one entry, "{}" is none. An entry may have braces of its own, which stay:
/// "{{1, 2}, {3, 4}}" has two. Nothing when a brace or an entry is missing.
std::optional<std::vector<std::string>> parseEntries(const std::string& text);

/// The shortest text that reads back as exactly this number: "0.1", "1e-08".
std::string realText(double value);

/// Without blanks, tabs and line ends on both sides.
std::string trimmed(const std::string& text);

}  // namespace suture
