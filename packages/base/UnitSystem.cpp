#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/base/UnitSystem.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

namespace suture {

namespace {

constexpr double kInch = 0.0254, kPound = 4.4482216152605;  // exact: international inch and pound, standard gravity
constexpr double kSame = 1e-9;                              // relative difference of equal units

using Names = std::map<std::string, double>;

const Names& lengths() {
  static const Names names{{"m", 1.0},        {"dm", 0.1}, {"cm", 0.01},  {"mm", 1e-3},    {"um", 1e-6},      {"\u00b5m", 1e-6},
                           {"\u03bcm", 1e-6}, {"km", 1e3}, {"in", kInch}, {"inch", kInch}, {"ft", 12 * kInch}};
  return names;
}

const Names& forces() {
  static const Names names{{"N", 1.0},      {"mN", 1e-3},
                           {"uN", 1e-6},    {"daN", 10.0},
                           {"kN", 1e3},     {"MN", 1e6},
                           {"GN", 1e9},     {"lbf", kPound},
                           {"lb", kPound},  {"kip", 1000 * kPound},
                           {"dyn", 1e-5},   {"kgf", 9.80665},
                           {"tf", 9806.65}, {"ton-force", 2000 * kPound}};
  return names;
}

const Names& stresses() {
  static const Names names{{"Pa", 1.0},
                           {"kPa", 1e3},
                           {"MPa", 1e6},
                           {"GPa", 1e9},
                           {"bar", 1e5},
                           {"N/m^2", 1.0},
                           {"N/m2", 1.0},
                           {"kN/m^2", 1e3},
                           {"kN/m2", 1e3},
                           {"MN/m^2", 1e6},
                           {"MN/m2", 1e6},
                           {"N/mm^2", 1e6},
                           {"N/mm2", 1e6},
                           {"kN/mm^2", 1e9},
                           {"kN/mm2", 1e9},
                           {"N/cm^2", 1e4},
                           {"N/cm2", 1e4},
                           {"kN/cm^2", 1e7},
                           {"kN/cm2", 1e7},
                           {"psi", kPound / (kInch * kInch)},
                           {"ksi", 1000 * kPound / (kInch * kInch)},
                           {"psf", kPound / (144 * kInch * kInch)},
                           {"ksf", 1000 * kPound / (144 * kInch * kInch)}};
  return names;
}

double sizeOf(const std::string& name, const char* quantity, const Names& known) {
  const auto found = known.find(name);
  if (found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& one : known) names.push_back(one.first);
  throw InputError("Units", name.empty() ? "the unit of " + std::string(quantity) + " is missing; expected three names: 'mm, N, MPa'"
                                         : unknownName("unit of " + std::string(quantity), name, names));
}

}  // namespace

UnitSystem UnitSystem::named(const std::string& names) {
  std::istringstream text(names);
  std::string name[3], rest;
  for (std::string& one : name) {
    std::getline(text, one, ',');
    one = trimmed(one);
  }
  if (std::getline(text, rest)) throw InputError("Units", "'" + names + "' has more than three names; expected 'mm, N, MPa'");
  const UnitSystem units{sizeOf(name[0], "length", lengths()), sizeOf(name[1], "force", forces()), sizeOf(name[2], "stress", stresses())};
  const double ratio = units.stress * units.length * units.length / units.force;
  if (std::abs(ratio - 1.0) > kSame)
    throw InputError(
        "Units", "'" + names + "' is not consistent: one " + name[1] + " / " + name[0] + "^2 is " + realText(1.0 / ratio) + " " + name[2]);
  return units;
}

double UnitSystem::unitOf(const std::string& quantity) const {
  if (quantity.empty() || quantity == "1 / temperature") return 1.0;
  if (quantity == "length") return length;
  if (quantity == "force") return force;
  if (quantity == "stress") return stress;
  if (quantity == "mass / volume") return stress / (length * length);
  throw InputError("Units", "values in '" + quantity + "' cannot be converted to other units");
}

double converted(double value, const std::string& quantity, const UnitSystem& from, const UnitSystem& to) {
  const double old = from.unitOf(quantity), now = to.unitOf(quantity);
  if (old == now) return value;
  char text[40];
  std::snprintf(text, sizeof text, "%.15g", value * old / now);
  return std::strtod(text, nullptr);
}

}  // namespace suture
