#pragma once
#include <suture/report/Run.hpp>

#include <string>

namespace suture {

/// A field of a CSV file; quoted where it has commas, quotes or line breaks. Local.
std::string csvField(const std::string& text);

/// A number with nine digits, after a comma; zero where it is mere rounding beside the largest of its column. Local.
std::string csvNumber(double value, double largest);

/// contact.csv: a row a contact pair, nine digits. On rank 0. \throws EnvironmentError
void writeContactTable(const Run& run, const std::string& path);

/// reactions.csv: a row a boundary condition, a contact, and the sum of conditions and obstacles. On rank 0. \throws EnvironmentError
void writeReactionTable(const Run& run, const std::string& path);

}  // namespace suture
