#pragma once
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Strict conversion: the whole text (except surrounding blanks) must be one finite number, in any locale. Local.
/// "3.7" is not an integer; "1e-8x", "", "nan", "inf" and "1e999" are rejected.
std::optional<double> parseReal(const std::string& text);
std::optional<int> parseInteger(const std::string& text);

/// The entries of "{a, b}", trimmed; a text without braces is one entry, "{}" has none. Nested braces stay: "{{1, 2}, {3, 4}}" has two
/// entries. Nothing if a brace or an entry is missing.
std::optional<std::vector<std::string>> parseEntries(const std::string& text);

/// The shortest text that reads back as exactly this number: "0.1", "1e-08".
std::string realText(double value);

/// The text without leading and trailing blanks, tabs and line ends.
std::string trimmed(const std::string& text);

}  // namespace suture
