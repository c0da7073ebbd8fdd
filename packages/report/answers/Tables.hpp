#pragma once
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// A field of a CSV file, quoted if it contains commas, quotes or line breaks. Local.
std::string csvField(const std::string& text);

/// Name of a table of an object that the user has named: `<kind>_<name>.csv`; characters other than letters, digits and - become _. Local.
std::string tableName(const std::string& kind, const std::string& name);

/// A comma and a number with nine digits; zero if it is mere round-off relative to the largest of its column. Local.
std::string csvNumber(double value, double largest);

/// contact.csv: one row per contact pair, nine digits. On rank 0. \throws EnvironmentError
void writeContactTable(const Run& run, const std::string& path);

/// reactions.csv: one row per boundary condition and contact, and the sum of conditions and obstacles. On rank 0.
/// \throws EnvironmentError
void writeReactionTable(const Run& run, const std::string& path);

}  // namespace suture
