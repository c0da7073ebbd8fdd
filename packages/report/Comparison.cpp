#include <suture/answer/verdict/Findings.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/report/Comparison.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/answers/Tables.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using Json = nlohmann::ordered_json;

namespace suture {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
/// Round-off of an energy that is a difference of larger ones, as a fraction of the largest force times the largest displacement.
constexpr double kEnergyRounding = 1e-12;

double numberOf(const Json& value) { return value.is_number() ? value.get<double>() : kUnknown; }

std::vector<double> vectorOf(const Json& value) {
  std::vector<double> all;
  for (const Json& one : value) all.push_back(numberOf(one));
  return all;
}

double normOf(const std::vector<double>& vector) {
  double sum = 0.0;
  for (const double one : vector) sum += one * one;
  return std::sqrt(sum);
}

/// The larger of the two that is not NaN.
double larger(double a, double b) { return std::isnan(a) ? b : std::isnan(b) ? a : std::max(a, b); }

/// Outer Solver/Tolerance: in files a number or a word; NaN for an automatic tolerance.
double askedTolerance(const Json& run) {
  const Json value = run.at("parameters").value("Outer Solver", Json::object()).value("Tolerance", Json());
  return value.is_string() ? parseReal(value.get<std::string>()).value_or(kUnknown) : numberOf(value);
}

/// Figures of a summary that scale differences of other figures.
struct SummaryScales {
  double force = 0.0, displacement = 0.0, gap = 0.0, stress = 0.0, tolerance = 0.0;

  explicit SummaryScales(const Json& run) {
    for (const char* kind : {"conditions", "contacts"})
      for (const auto& one : run.at("reactions").at(kind)) force = larger(force, normOf(vectorOf(one.at("force"))));
    displacement = larger(displacement, numberOf(run.at("max_displacement")));
    gap = larger(displacement, numberOf(run.at("contact").at("max_gap")));
    stress =
        larger(larger(stress, numberOf(run.at("extremes").at("von_mises").at("value"))), numberOf(run.at("contact").at("max_pressure")));
    const double asked = askedTolerance(run);
    tolerance = larger(larger(tolerance, asked), numberOf(run.at("outer").at("residual")));
    if (std::isnan(asked)) tolerance = larger(tolerance, numberOf(run.at("error").value("algebraic_energy_norm_relative", Json())));
  }
  SummaryScales(const SummaryScales& a, const SummaryScales& b)
      : force(larger(a.force, b.force)),
        displacement(larger(a.displacement, b.displacement)),
        gap(larger(a.gap, b.gap)),
        stress(larger(a.stress, b.stress)),
        tolerance(larger(a.tolerance, b.tolerance)) {}
};

std::string shownVector(const std::vector<double>& vector) {
  std::string text;
  for (const double one : vector) text += (text.empty() ? "" : " ") + format("%.4e", one);
  return text;
}

class FigureList {
 public:
  FigureList(const Json& then, const Json& now) : then_(then), now_(now) {}

  /// Adds a figure that must be equal in both runs.
  void same(const std::string& name, const char* key) {
    const bool equal = then_.at(key) == now_.at(key);
    all.push_back({name, then_.at(key).dump(), now_.at(key).dump(), equal ? 0.0 : std::numeric_limits<double>::infinity(), 0.0, true});
  }
  /// Adds a count, which may differ by `allowed`; -1: without limit.
  void count(const std::string& name, const Json& then, const Json& now, double allowed) {
    all.push_back({name, then.dump(), now.dump(), std::abs(numberOf(now) - numberOf(then)), allowed, allowed >= 0.0});
  }
  void value(const std::string& name, const Json& then, const Json& now, double scale, double allowed) {
    values(name, {numberOf(then)}, {numberOf(now)}, scale, allowed);
  }
  void vector(const std::string& name, const Json& then, const Json& now, double scale, double allowed) {
    values(name, vectorOf(then), vectorOf(now), scale, allowed);
  }

  std::vector<ComparedFigure> all;

 private:
  void values(const std::string& name, const std::vector<double>& then, const std::vector<double>& now, double scale, double allowed) {
    std::vector<double> off;
    for (std::size_t k = 0; k < std::min(then.size(), now.size()); ++k)
      off.push_back(std::isnan(then[k]) && std::isnan(now[k]) ? 0.0 : now[k] - then[k]);
    double difference = normOf(off);
    if (difference > 0.0 && scale > 0.0) difference /= scale;
    if (std::isnan(difference) || then.size() != now.size()) difference = std::numeric_limits<double>::infinity();
    all.push_back({name, shownVector(then), shownVector(now), difference, allowed, true});
  }

  const Json &then_, &now_;
};

void compareAnswers(const Json& a, const Json& b, const SummaryScales& scales, FigureList& figures) {
  const double whole = Bounds::resultant.at(scales.tolerance), local = Bounds::contact.at(scales.tolerance);
  const double energy = std::max(std::abs(numberOf(a.at("energy"))), std::abs(numberOf(b.at("energy"))));
  figures.value("energy", a.at("energy"), b.at("energy"), larger(energy, kEnergyRounding / whole * scales.force * scales.displacement),
                whole);
  figures.value("largest displacement", a.at("max_displacement"), b.at("max_displacement"), scales.displacement, whole);
  for (const char* kind : {"contacts", "conditions"})
    for (const auto& [name, one] : a.at("reactions").at(kind).items()) {
      const Json other = b.at("reactions").at(kind).value(name, Json::object());
      figures.vector((kind == std::string("contacts") ? "contact force '" : "force of '") + name + "'", one.at("force"),
                     other.value("force", Json::array()), scales.force, whole);
    }
  const Json &contactA = a.at("contact"), &contactB = b.at("contact");
  if (numberOf(contactA.at("pairs")) > 0) {
    const double touching = larger(numberOf(contactA.at("touching_without_force")), numberOf(contactB.at("touching_without_force")));
    figures.count("closed pairs", contactA.at("active"), contactB.at("active"), touching);
    figures.value("largest pressure", contactA.at("max_pressure"), contactB.at("max_pressure"),
                  larger(numberOf(contactA.at("max_pressure")), numberOf(contactB.at("max_pressure"))), local);
    figures.value("largest gap", contactA.at("max_gap"), contactB.at("max_gap"), scales.gap, local);
  }
  if (contactA.contains("friction") && contactB.contains("friction")) {
    const Json &rubA = contactA.at("friction"), &rubB = contactB.at("friction");
    figures.vector("tangential force", rubA.at("tangential_force"), rubB.at("tangential_force"), scales.force, whole);
    figures.value("mobilisation, mean", rubA.at("mean_mobilisation"), rubB.at("mean_mobilisation"), 1.0, local);
    figures.value("dissipated work", rubA.at("dissipated_work"), rubB.at("dissipated_work"), scales.force * scales.displacement, whole);
    figures.count("sticking pairs", rubA.at("sticking"), rubB.at("sticking"), -1.0);
    figures.count("slipping pairs", rubA.at("slipping"), rubB.at("slipping"), -1.0);
  }
  const Json &extremesA = a.at("extremes"), &extremesB = b.at("extremes");
  for (const auto& [key, name] : {std::pair("von_mises", "von Mises stress"), std::pair("tension", "largest principal stress"),
                                  std::pair("compression", "smallest principal stress")})
    figures.value(name, extremesA.at(key).at("value"), extremesB.at(key).at("value"), scales.stress, local);
}

}  // namespace

bool Comparison::agrees() const {
  return std::all_of(figures.begin(), figures.end(), [](const ComparedFigure& one) { return one.agrees(); });
}

bool Comparison::isExact() const {
  return std::all_of(figures.begin(), figures.end(), [](const ComparedFigure& one) { return one.difference == 0.0; });
}

Comparison compareSummaries(const std::string& then, const std::string& now) try {
  const Json a = Json::parse(then), b = Json::parse(now);
  const SummaryScales scales{SummaryScales(a), SummaryScales(b)};
  FigureList figures(a, b);
  figures.same("converged", "converged");
  figures.same("verified", "verified");
  for (const char* key : {"nodes", "elements", "dofs"}) figures.count(key, a.at(key), b.at(key), 0.0);
  compareAnswers(a, b, scales, figures);
  if (a.contains("load_steps") && b.contains("load_steps"))
    figures.count("load steps", a["load_steps"].at("count"), b["load_steps"].at("count"), -1.0);
  figures.count("subdomains", a.at("subdomains"), b.at("subdomains"), -1.0);
  figures.count("outer iterations", a.at("outer").at("iterations"), b.at("outer").at("iterations"), -1.0);
  figures.count("PCG", a.at("outer").at("pcg_total"), b.at("outer").at("pcg_total"), -1.0);
  Comparison comparison{figures.all, scales.tolerance, a.at("ranks").get<int>(), b.at("ranks").get<int>(), {}};
  for (const auto& [library, version] : a.at("versions").items())
    if (const Json other = b.at("versions").value(library, Json("none")); other != version)
      comparison.notes.push_back(library + " " + version.get<std::string>() + " then, " + other.get<std::string>() + " now");
  return comparison;
} catch (const Json::exception& error) {
  throw InputError("summary.json", std::string("cannot be compared: ") + error.what());
}

std::string tableOf(const Comparison& comparison) {
  const auto widest = [&](std::size_t least, const auto& textOf) {
    for (const ComparedFigure& one : comparison.figures) least = std::max(least, textOf(one).size());
    return int(least);
  };
  const int names = widest(8, [](const ComparedFigure&one) { return one.name; }),
            then = widest(4, [](const ComparedFigure&one) { return one.then; }),
            now = widest(3, [](const ComparedFigure&one) { return one.now; });
  std::string text = format("again: %s then, %s now, tolerance %.1e\n", counted(comparison.ranksThen, "rank").c_str(),
                            counted(comparison.ranksNow, "rank").c_str(), comparison.tolerance);
  for (const std::string& note : comparison.notes) text += "   " + note + "\n";
  text += format("   %-*s   %*s   %*s   difference   allowed\n", names, "quantity", then, "then", now, "now");
  std::size_t judged = 0;
  const ComparedFigure* nearest = nullptr;
  for (const ComparedFigure& one : comparison.figures) {
    const std::string off = one.difference == 0.0 ? "0" : format("%.1e", one.difference);
    text +=
        format("   %-*s   %*s   %*s   %10s   %7s%s\n", names, one.name.c_str(), then, one.then.c_str(), now, one.now.c_str(), off.c_str(),
               !one.judged          ? "any"
               : one.allowed == 0.0 ? "0"
                                    : format("%.1e", one.allowed).c_str(),
               one.agrees() ? "" : "   differs");
    judged += one.judged;
    if (one.judged && one.difference > 0.0 && (!nearest || one.difference * nearest->allowed > nearest->difference * one.allowed))
      nearest = &one;
  }
  if (!comparison.agrees()) return text + "does not agree: " + failureOf(comparison) + "\n";
  if (comparison.isExact()) return text + format("agrees: all %zu quantities to the last bit\n", comparison.figures.size());
  text += format("agrees: all %zu compared quantities", judged);
  if (nearest) text += format(", closest to its limit: %s %.1e of %.1e", nearest->name.c_str(), nearest->difference, nearest->allowed);
  return text + "\n";
}

std::string failureOf(const Comparison& comparison) {
  std::string text;
  for (const ComparedFigure& one : comparison.figures)
    if (!one.agrees())
      text += (text.empty() ? "" : "; ") + one.name + format(" differs by %.1e, allowed %.1e", one.difference, one.allowed) + " (" +
              one.then + " then, " + one.now + " now)";
  return text;
}

void writeComparison(const Comparison& comparison, const std::string& path) {
  std::string text = "quantity,then,now,difference,allowed,agrees\n";
  for (const ComparedFigure& one : comparison.figures)
    text += csvField(one.name) + "," + csvField(one.then) + "," + csvField(one.now) + format(",%.9g,", one.difference) +
            (one.judged ? format("%.9g", one.allowed) : "") + (one.agrees() ? ",true\n" : ",false\n");
  writeTextFile(path, text);
}

}  // namespace suture
