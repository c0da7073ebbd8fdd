#include "ExampleUnits.hpp"

#include <map>
#include <sstream>
#include <suture/base/Numbers.hpp>

namespace suture::proposal {

namespace {

double sizeOf(const std::string& unit) {
  static const std::map<std::string, double> known{
      {"m", 1.0},   {"cm", 1e-2},    {"mm", 1e-3},   {"um", 1e-6},      {"in", 0.0254},    {"ft", 0.3048},     {"N", 1.0},
      {"kN", 1e3},  {"MN", 1e6},     {"mN", 1e-3},   {"lbf", 4.448222}, {"kip", 4448.222}, {"Pa", 1.0},        {"kPa", 1e3},
      {"MPa", 1e6}, {"N/mm^2", 1e6}, {"N/mm2", 1e6}, {"GPa", 1e9},      {"psi", 6894.757}, {"ksi", 6894757.0}, {"psf", 47.88026}};
  const auto at = known.find(unit);
  return at == known.end() ? 1.0 : at->second;
}

}  // namespace

std::string completeUnits(const std::string& units) {
  static const std::map<std::string, std::string> known{{"mm", "mm, N, MPa"}, {"m", "m, N, Pa"}, {"in", "in, lbf, psi"}};
  const auto at = known.find(trimmed(units));
  return at == known.end() ? units : at->second;
}

ExampleUnits::ExampleUnits(const std::string& names) : names_(names) {
  std::istringstream words(names);
  for (double* size : {&length_, &force_, &stress_}) {
    std::string word;
    std::getline(words, word, ',');
    *size = sizeOf(trimmed(word));
  }
}

}  // namespace suture::proposal
