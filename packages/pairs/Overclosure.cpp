#include <suture/base/Numbers.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/pairs/Overclosure.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

constexpr double kSameSlope = 1e-9;  // relative decrease of a slope that counts as round-off of a table
constexpr double kShareOfP = 0.7;    // part of the error that grows with the pressure: keeps the fitted function convex
constexpr int kSamples = 48;         // points of a line at which its error is compared
constexpr int kBisections = 40;      // halvings of the interval that contains the end of a line
constexpr int kMostSprings = 60;
constexpr const char *kHard = "Hard", *kLinear = "Linear", *kExponential = "Exponential", *kTable = "Table";
constexpr const char* kRatio = "Tangential Ratio";

/// The exponential law in units of p0 and c0.
double shape(double x) { return x > 0.0 ? x * std::expm1(x) / (std::exp(1.0) - 1.0) : 0.0; }

/// Corners of straight lines near the exponential law: x and pressure in its units. Corners lie below the law, middles of lines equally far
/// above it.
class ExponentialFit {
 public:
  ExponentialFit(double accuracy, double largest) : accuracy_(accuracy) {
    corners.push_back({root(), 0.0});
    while (shape(corners.back().first) < largest && corners.size() <= kMostSprings) corners.push_back(next(corners.back()));
  }
  std::vector<std::pair<double, double>> corners;

 private:
  double below(double x) const { return shape(x) - accuracy_ * (1.0 - kShareOfP + kShareOfP * shape(x)); }

  double root() const {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 2 * kBisections; ++i) (below(0.5 * (low + high)) > 0.0 ? high : low) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }

  bool isNear(const std::pair<double, double>& from, double to) const {
    for (int i = 1; i < kSamples; ++i) {
      const double part = double(i) / kSamples, x = from.first + part * (to - from.first), p = shape(x);
      if (from.second + part * (below(to) - from.second) - p > accuracy_ * std::max(p, 1.0)) return false;
    }
    return true;
  }

  std::pair<double, double> next(const std::pair<double, double>& from) const {
    double low = from.first, high = from.first + 2.0;
    for (int i = 0; i < kBisections; ++i) (isNear(from, 0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return {low, below(low)};
  }

  double accuracy_;
};

std::string percent(double fraction) {
  char text[30];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * fraction);
  return text;
}

std::vector<double> valuesIn(const Parameters& list, const std::string& name) {
  const auto given = list.get<Teuchos::Array<double>>(name);
  return {given.begin(), given.end()};
}

Overclosure readLaw(const std::string& type, const Parameters& own) {
  if (type == kLinear) return Overclosure::linear(own.get<double>("Stiffness"));
  if (type == kTable) return Overclosure::table(valuesIn(own, "Pressures"), valuesIn(own, "Overclosures"));
  const double pressure = own.get<double>("Pressure At Zero Clearance");
  return Overclosure::exponential(pressure, own.get<double>("Clearance At Zero Pressure"), own.get<double>("Accuracy"),
                                  own.isType<double>("Largest Pressure") ? own.get<double>("Largest Pressure") : 10.0 * pressure);
}

}  // namespace

Overclosure Overclosure::linear(double stiffness) {
  Overclosure law;
  law.springs_ = {{stiffness, 0.0}};
  return law;
}

Overclosure Overclosure::exponential(double pressure, double clearance, double accuracy, double largestPressure) {
  std::vector<double> pressures, overclosures;
  for (const auto& [x, p] : ExponentialFit(accuracy, largestPressure / pressure).corners) {
    overclosures.push_back((x - 1.0) * clearance);
    pressures.push_back(p * pressure);
  }
  Overclosure law = table(pressures, overclosures);
  law.largestPressure_ = largestPressure;
  law.note_ = "the exponential law is replaced by " + std::to_string(law.springs_.size()) + " straight lines, within " + percent(accuracy) +
              " of the larger of the pressure and " + realText(pressure) + ", up to the pressure " + realText(largestPressure);
  return law;
}

Overclosure Overclosure::table(const std::vector<double>& pressures, const std::vector<double>& overclosures) {
  const auto wrong = [](const std::string& what) { throw InputError("", what); };
  const std::size_t rows = pressures.size();
  if (rows != overclosures.size())
    wrong(std::to_string(rows) + " Pressures and " + std::to_string(overclosures.size()) + " Overclosures; expected as many of each");
  if (rows < 2) wrong("a table of fewer than two rows; expected the pressures at two or more overclosures");
  if (pressures.front() != 0.0) wrong("the first pressure is " + realText(pressures.front()) + "; expected 0, where contact begins");
  Overclosure law;
  double slope = 0.0;
  for (std::size_t i = 1; i < rows; ++i) {
    const double step = overclosures[i] - overclosures[i - 1], rise = pressures[i] - pressures[i - 1];
    const std::string at = "row " + std::to_string(i + 1) + ": ";
    if (!(step > 0.0))
      wrong(at + "the overclosure " + realText(overclosures[i]) + " is not above the one before; expected ascending values");
    if (rise < 0.0) wrong(at + "the pressure " + realText(pressures[i]) + " is below the one before; expected ascending values");
    const double own = rise / step;
    if (own < slope * (1.0 - kSameSlope))
      wrong(at + "the law softens, from the slope " + realText(slope) + " to " + realText(own) +
            "; expected slopes that do not decrease (a softening contact has no unique solution)");
    if (own > slope * (1.0 + kSameSlope)) law.springs_.push_back({own - slope, overclosures[i - 1]});
    slope = std::max(slope, own);
  }
  if (law.springs_.empty()) wrong("all pressures are zero; expected a positive one");
  law.largestPressure_ = pressures.back();
  return law;
}

double Overclosure::pressure(double overclosure) const {
  double sum = 0.0;
  for (const Spring& spring : springs_) sum += spring.stiffness * std::max(0.0, overclosure - spring.begin);
  return sum;
}

std::map<std::string, Schema> Overclosure::choices() {
  const auto withRatio = [](Schema schema) {
    return schema.real(
        kRatio, 1.0,
        "tangential stiffness as a fraction of the normal one: the elastic slip of pairs that stick; without friction it has "
        "no effect",
        Range::positive());
  };
  return {{kHard, Schema("no overclosure")},
          {kLinear, withRatio(Schema("pressure in proportion to the overclosure")
                                  .real("Stiffness", std::nullopt, "pressure per overclosure", Range::positive(), "stress / length"))},
          {kExponential,
           withRatio(
               Schema("p = p0 / (e - 1) ((c / c0 + 1) (exp(c / c0 + 1) - 1)) for overclosures c above -c0, as straight lines")
                   .real("Pressure At Zero Clearance", std::nullopt, "p0", Range::positive(), "stress")
                   .real("Clearance At Zero Pressure", std::nullopt, "c0", Range::positive(), "length")
                   .real("Largest Pressure", std::nullopt,
                         "pressure up to which the lines follow the law; the last one continues beyond it, with a warning. Default: 10 p0",
                         Range::positive(), "stress")
                   .optional()
                   .real("Accuracy", 0.01, "largest error of the lines, as a fraction of the larger of the pressure and p0",
                         Range{1e-4, 0.2, false, false, {}}))},
          {kTable,
           withRatio(Schema("straight lines between the rows of a table; the last one continues beyond it, with a warning")
                         .reals("Pressures", std::nullopt, "pressure of each row: first 0, then ascending", "stress")
                         .reals("Overclosures", std::nullopt,
                                "overclosure of each row, ascending; negative for a clearance. The slope must not decrease", "length"))}};
}

std::optional<Overclosure> Overclosure::read(const Parameters& contact, Problems& problems) {
  const std::string type = contact.isType<std::string>(kParameter) ? contact.get<std::string>(kParameter) : kHard;
  if (type == kHard) return std::nullopt;
  const Parameters& own = contact.sublist(type);
  try {
    Overclosure law = readLaw(type, own);
    law.tangentialRatio_ = own.get<double>(kRatio);
    const std::string force = contact.isType<std::string>("Law") ? contact.get<std::string>("Law") : "Frictionless";
    if (law.springs_.size() > 1 && force != "Frictionless" && force != "Coulomb" && force != "Tresca")
      problems.add(pathOf(contact, kParameter),
                   "'" + type + "' together with the Law '" + force + "'; expected Linear, or the Law Frictionless, Coulomb or Tresca");
    return law;
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) problems.add(pathOf(own), problem.message);
    return std::nullopt;
  }
}

std::vector<ContactLine> contactLines(const std::vector<std::string>& names, const std::vector<std::optional<Overclosure>>& laws) {
  std::vector<ContactLine> lines;
  for (std::size_t i = 0; i < names.size(); ++i) lines.push_back({names[i], static_cast<int>(i), 0, laws[i]});
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t spring = 1; laws[i] && spring < laws[i]->springs().size(); ++spring)
      lines.push_back({names[i], static_cast<int>(i), static_cast<int>(spring), laws[i]});
  return lines;
}

std::vector<ContactLine> contactLines(const Parameters& contact) {
  Problems problems;
  const std::vector<std::string> names = sublistNames(contact);
  std::vector<std::optional<Overclosure>> laws;
  for (const std::string& name : names) laws.push_back(Overclosure::read(contact.sublist(name), problems));
  problems.throwIfAny();
  return contactLines(names, laws);
}

}  // namespace suture
