#include <suture/answer/values/SingularExtremes.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Units.hpp>
#include <suture/report/answers/Answers.hpp>

#include <Teuchos_RCP.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using Json = nlohmann::ordered_json;

namespace suture {

namespace {

Json componentsOf(const Point& vector, int dimension) {
  Json all = Json::array();
  for (int k = 0; k < dimension; ++k) all.push_back(vector[k]);
  return all;
}

/// In 2D the moment about the out-of-plane axis.
Json momentOf(const Point& moment, int dimension) { return dimension == 2 ? Json::array({moment[2]}) : componentsOf(moment, 3); }

Json resultantOf(const Resultant& sum, int dimension) {
  return {{"force", componentsOf(sum.force, dimension)}, {"moment", momentOf(sum.moment, dimension)}};
}

Json extreme(const Run& run, const Extreme& found, const std::string& unit, int dimension) {
  if (!found.exists()) return {{"value", found.value}, {"unit", unit}, {"body", nullptr}, {"place", nullptr}};
  return {{"value", found.value}, {"unit", unit}, {"body", bodyName(run, found.body)}, {"place", componentsOf(found.place, dimension)}};
}

std::string contactName(const Run& run, int line) {
  return line >= 0 && line < static_cast<int>(run.contacts.size()) ? run.contacts[line] : std::to_string(line + 1);
}

Json bodiesOf(const Run& run, std::initializer_list<std::vector<int>> sides) {
  Json all = Json::array();
  for (const std::vector<int>& side : sides)
    for (const int body : side)
      if (body >= 0) all.push_back(bodyName(run, body));
  return all;
}

Json contactJson(const Run& run, const ContactResultant& contact, int dimension) {
  Json row = {{"bodies", bodiesOf(run, {contact.bodies[0], contact.bodies[1]})}};
  row.update(resultantOf(contact.onB, dimension));
  row["centre"] = contact.presses() ? componentsOf(contact.centre, dimension) : Json();
  row["closed"] = contact.closed;
  row["whole"] = contact.whole;
  return row;
}

/// "2.31e+05 Pa in 'left' at (1, 2)"
std::string told(const Run& run, const char* pattern, const Extreme& found, const std::string& unit, int dimension) {
  if (!found.exists()) return "0 " + unit;
  return format("%s %s in '%s' at %s", format(pattern, found.value).c_str(), unit.c_str(), bodyName(run, found.body).c_str(),
                placeText(found.place, dimension).c_str());
}

/// Adds to each extreme of a stress how far its value can be trusted.
void addAccuracy(const ErrorBars& bars, Json& extremes) {
  for (const char* key : {"von_mises", "tension", "compression", "pressure"}) {
    if (extremes[key].is_null()) continue;
    const auto reason = bars.singular.find(key);
    extremes[key]["accuracy"] = reason == bars.singular.end() ? "estimate" : "singular";
    if (reason != bars.singular.end()) extremes[key]["reason"] = reason->second;
  }
}

/// The largest resultant of all conditions and contacts.
double largestForce(const std::vector<ConditionResultant>& conditions, const std::vector<ContactResultant>& contacts) {
  double largest = 0;
  for (const ConditionResultant& one : conditions) largest = std::max(largest, norm(one.sum.force));
  for (const ContactResultant& one : contacts) largest = std::max(largest, norm(one.onB.force));
  return largest;
}

int numberOf(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

}  // namespace

std::string bodyName(const Run& run, int body) {
  return body >= 0 && body < static_cast<int>(run.model.bodies.size()) ? run.model.bodies[body] : "";
}

std::vector<ConditionResultant> conditionResultants(const Run& run) {
  const Reactions& reactions = run.solution.verification.reactions;
  std::vector<ConditionResultant> all;
  for (std::size_t c = 0; c < run.conditions.size(); ++c)
    all.push_back({run.conditions[c], "support", c < reactions.supports.size() ? reactions.supports[c] : Resultant()});
  const auto rowOf = [&](const std::string& name, const char* kind) -> ConditionResultant& {
    auto row = std::find_if(all.begin(), all.end(), [&](const ConditionResultant& one) { return one.name == name; });
    if (row == all.end()) row = all.insert(all.end(), {name, kind, {}});
    row->kind = kind;
    return *row;
  };
  for (std::size_t l = 0; l < run.model.loads.size(); ++l) {
    const Load& load = run.model.loads[l];
    if (load.isCorrection) continue;
    if (load.kind == Load::Kind::NodalForces && load.factor == 0.0) continue;  // forces of removed parts, which have fallen to zero
    ConditionResultant& row =
        rowOf(load.atReference ? load.name + "/Force" : load.name, load.control == Load::Control::MeanDisplacement ? "support" : "load");
    if (l < reactions.loads.size()) row.sum.add(reactions.loads[l]);
  }
  for (std::size_t s = 0; s < run.model.supports.size() && s < reactions.springs.size(); ++s)
    rowOf(run.model.supports[s].name, "support").sum.add(reactions.springs[s]);
  if (norm(reactions.own.force) > 0.0 || norm(reactions.own.moment) > 0.0)
    all.push_back({"subdomains with physics of their own", "load", reactions.own});
  return all;
}

std::vector<ContactResultant> contactResultants(const Run& run) {
  return contactResultants(run.solution.pairs, static_cast<int>(run.contacts.size()), run.model.axisymmetric);
}

Resultant sumOfResultants(const std::vector<ConditionResultant>& conditions, const std::vector<ContactResultant>& contacts) {
  Resultant sum;
  for (const ConditionResultant& condition : conditions) sum.add(condition.sum);
  for (const ContactResultant& contact : contacts)
    if (contact.pairs > 0 && contact.bodies[1].empty()) sum.add(contact.onB, -1.0);  // reaction of the obstacle
  return sum;
}

Json extremesJson(const Run& run, int dimension) {
  const Extremes& found = run.solution.extremes;
  const Units units = unitsOf(*run.scene.parameters);
  Json all = {{"stresses", found.recovered ? "recovered at nodes" : "at centroids of elements"},
              {"von_mises", extreme(run, found.vonMises, units.stress, dimension)},
              {"tension", extreme(run, found.tension, units.stress, dimension)},
              {"compression", extreme(run, found.compression, units.stress, dimension)},
              {"displacement", extreme(run, found.displacement, units.length, dimension)},
              {"pressure", Json()}};
  if (run.solution.sinceTime) {
    all["displacement_since"] = extreme(run, found.displacementSince, units.length, dimension);
    all["displacement_since"]["time"] = *run.solution.sinceTime;
  }
  if (const PairResult* pair = largestPressure(run.solution))
    all["pressure"] = {{"value", pair->pressure},
                       {"unit", units.stress},
                       {"contact", contactName(run, pair->line)},
                       {"bodies", bodiesOf(run, {{pair->bodies[0], pair->bodies[1]}})},
                       {"place", componentsOf(pair->position, dimension)}};
  if (run.solution.errorBars) addAccuracy(*run.solution.errorBars, all);
  return all;
}

ForceErrors::ForceErrors(const Run& run, const std::vector<ConditionResultant>& conditions, const std::vector<ContactResultant>& contacts)
    : run_(run), largest_(largestForce(conditions, contacts)) {}

std::optional<double> ForceErrors::of(const ConditionResultant& condition) const {
  if (!run_.solution.errorBars || condition.kind != "support") return std::nullopt;
  return run_.solution.errorBars->ofCondition(numberOf(run_.conditions, condition.name), largest_);
}

std::optional<double> ForceErrors::ofContact(int line) const {
  if (!run_.solution.errorBars) return std::nullopt;
  return run_.solution.errorBars->ofContact(line, largest_);
}

const ForceInterval* intervalOf(const Run& run, const std::string& name, bool isContact) {
  for (const ForceInterval& one : run.solution.intervals)
    if (one.name == name && one.isContact == isContact) return &one;
  return nullptr;
}

double largestForceError(const Run& run) {
  const std::vector<ConditionResultant> conditions = conditionResultants(run);
  const std::vector<ContactResultant> contacts = contactResultants(run);
  const ForceErrors errors(run, conditions, contacts);
  double largest = 0;
  for (const ConditionResultant& one : conditions) largest = std::max(largest, errors.of(one).value_or(0.0));
  for (std::size_t line = 0; line < contacts.size(); ++line)
    largest = std::max(largest, errors.ofContact(static_cast<int>(line)).value_or(0.0));
  return largest;
}

namespace {

/// Adds the bounds of a force or displacement to its row; null: not bounded.
void addInterval(const ForceInterval* interval, int dimension, Json& row) {
  if (!interval) return;
  const auto known = [](const std::optional<Interval>& one, double Interval::*end) { return one ? Json((*one).*end) : Json(); };
  if (interval->displacement) {
    row["displacement"] = *interval->displacement;
    row["displacement_low"] = known(interval->ofDisplacement, &Interval::low);
    row["displacement_high"] = known(interval->ofDisplacement, &Interval::high);
  } else {
    row["force_low"] = row["force_high"] = Json::array();
    for (int k = 0; k < dimension; ++k) {
      row["force_low"].push_back(known(interval->force[static_cast<std::size_t>(k)], &Interval::low));
      row["force_high"].push_back(known(interval->force[static_cast<std::size_t>(k)], &Interval::high));
    }
  }
  if (!interval->reason.empty()) row["not_bounded"] = interval->reason;
}

}  // namespace

std::string intervalsText(const Run& run, int dimension) {
  const Units units = unitsOf(*run.scene.parameters);
  std::string text;
  for (const ForceInterval& one : run.solution.intervals) {
    std::string values;
    for (int k = 0; k < dimension; ++k)
      if (const std::optional<Interval>& force = one.force[static_cast<std::size_t>(k)]; force && (force->low != 0.0 || force->high != 0.0))
        values += format("%s%c from %.6g to %.6g", values.empty() ? "" : ", ", "xyz"[k], force -> low, force -> high);
    if (!values.empty()) values += " " + units.force;
    if (one.ofDisplacement)
      values = format("mean displacement from %.6g to %.6g %s", one.ofDisplacement->low, one.ofDisplacement->high, units.length.c_str());
    if (!one.reason.empty()) values += (values.empty() ? "not bounded, because " : "; not all bounded, because ") + one.reason;
    text += "   strict: " + std::string(one.isContact ? "contact" : "condition") + " '" + one.name + "' " +
            (values.empty() ? "no force" : values) + "\n";
  }
  return text;
}

Json reactionsJson(const Run& run, int dimension) {
  const std::vector<ConditionResultant> conditions = conditionResultants(run);
  const std::vector<ContactResultant> contacts = contactResultants(run);
  const std::optional<ErrorBars>& bars = run.solution.errorBars;
  const ForceErrors errors(run, conditions, contacts);
  Json all = {{"about", componentsOf({0, 0, 0}, dimension)}, {"conditions", Json::object()}, {"contacts", Json::object()}};
  for (const ConditionResultant& condition : conditions) {
    Json row = {{"kind", condition.kind}};
    row.update(resultantOf(condition.sum, dimension));
    if (const std::optional<double> error = errors.of(condition)) row["force_error"] = *error;
    addInterval(intervalOf(run, condition.name, false), dimension, row);
    all["conditions"][condition.name] = row;
  }
  for (std::size_t line = 0; line < contacts.size(); ++line) {
    const std::string name = contactName(run, static_cast<int>(line));
    Json row = contactJson(run, contacts[line], dimension);
    if (const std::optional<double> error = errors.ofContact(static_cast<int>(line))) row["force_error"] = *error;
    addInterval(intervalOf(run, name, true), dimension, row);
    for (const ContactResultant& part : contacts[line].ofBodies) row["of_bodies"].push_back(contactJson(run, part, dimension));
    all["contacts"][name] = row;
  }
  if (bars) all["force_error_kind"] = "estimate";
  all["sum"] = resultantOf(sumOfResultants(conditions, contacts), dimension);
  return all;
}

namespace {

Json safetyOf(const Run& run, const LeastSafety& one, int dimension) {
  const Material& material = one.material(run.model);
  const bool isLoaded = one.exists();
  Json json = {{"factor", isLoaded ? Json(one.factor) : Json()},
               {"material", material.name},
               {"criterion", material.strength ? Json(material.strength->name()) : Json()},
               {"place", isLoaded ? componentsOf(one.place, dimension) : Json()},
               {"principal_stresses", isLoaded ? Json(one.stress) : Json()},
               {"unit", unitsOf(*run.scene.parameters).stress}};
  if (!run.steps.empty()) {
    json["step"] = isLoaded ? Json(one.step) : Json();
    json["time"] = isLoaded ? Json(one.time) : Json();
  }
  return json;
}

const LeastSafety& leastOf(const SafetyFactors& safety) {
  return *std::min_element(safety.ofBodies.begin(), safety.ofBodies.end(),
                           [](const LeastSafety& a, const LeastSafety& b) { return a.factor < b.factor; });
}

}  // namespace

Json safetyJson(const Run& run, int dimension) {
  const SafetyFactors& safety = run.solution.safety;
  Json all = {{"stresses", run.solution.extremes.recovered ? "recovered at nodes" : "at centroids of elements"},
              {"least", Json()},
              {"body", Json()},
              {"bodies", Json::object()}};
  for (const LeastSafety& one : safety.ofBodies) all["bodies"][bodyName(run, one.body)] = safetyOf(run, one, dimension);
  if (const LeastSafety& least = leastOf(safety); least.exists()) {
    all["least"] = least.factor;
    all["body"] = bodyName(run, least.body);
  }
  return all;
}

std::vector<StepRow::Group> groupsOfStep(const Run& run) {
  std::vector<StepRow::Group> all;
  if (run.solution.rigidGroups.empty()) return all;
  const std::vector<ConditionResultant> conditions = conditionResultants(run);
  for (const RigidGroupMotion& group : run.solution.rigidGroups) {
    const std::string& name = run.conditions[static_cast<std::size_t>(group.condition)];
    Resultant sum;
    for (const ConditionResultant& one : conditions)
      if (one.name == name || one.name == name + "/Force") sum.add(one.sum);
    const Point place = plus(group.point, group.displacement);
    all.push_back({name, group.displacement, group.rotation, sum.force, minus(sum.moment, cross(place, sum.force))});
  }
  return all;
}

Json rigidGroupsJson(const Run& run, int dimension) {
  Json all = Json::object();
  for (const RigidGroupMotion& group : run.solution.rigidGroups) {
    Json& row = all[run.conditions[static_cast<std::size_t>(group.condition)]];
    row["point"] = componentsOf(group.point, dimension);
    row["displacement"] = componentsOf(group.displacement, dimension);
    row["rotation"] = dimension == 2 ? Json::array({group.rotation[2]}) : componentsOf(group.rotation, 3);
  }
  return all;
}

namespace {

constexpr double kRounded = 1e-9;  // component of a motion, relative to the largest, that is printed as zero

Point withoutRounding(Point motion) {
  const double most = std::max({std::abs(motion[0]), std::abs(motion[1]), std::abs(motion[2])});
  for (double& component : motion)
    if (std::abs(component) < kRounded * most) component = 0.0;
  return motion;
}

std::string motionText(const Run& run, const RigidGroupMotion& group, const std::string& length, int dimension) {
  const Point rotation = withoutRounding(group.rotation);
  return "   rigid group '" + run.conditions[static_cast<std::size_t>(group.condition)] + "' moves by " +
         placeText(withoutRounding(group.displacement), dimension) + " " + length + " and turns by " +
         (dimension == 2 ? format("%.6g", rotation[2]) : placeText(rotation, 3)) + " rad\n";
}

}  // namespace

std::string extremesText(const Run& run, int dimension) {
  const Extremes& found = run.solution.extremes;
  if (!found.displacement.exists()) return "";
  const Units units = unitsOf(*run.scene.parameters);
  std::string text = "   von Mises stress up to " + told(run, "%.3e", found.vonMises, units.stress, dimension);
  text += found.recovered ? " (recovered at nodes)" : " (at centroids)";
  text += "\n   principal stresses from " + told(run, "%.3e", found.compression, units.stress, dimension) + " to " +
          told(run, "%.3e", found.tension, units.stress, dimension);
  text += "\n   displacement up to " + told(run, "%.3e", found.displacement, units.length, dimension);
  if (run.solution.sinceTime)
    text += format(", since t = %g up to ", *run.solution.sinceTime) + told(run, "%.3e", found.displacementSince, units.length, dimension);
  if (const PairResult* pair = largestPressure(run.solution); pair && pair->pressure > 0.0)
    text += format("; contact pressure up to %.3e %s on '%s' at %s", pair->pressure, units.stress.c_str(),
                   contactName(run, pair->line).c_str(), placeText(pair->position, dimension).c_str());
  text += "\n";
  for (const RigidGroupMotion& group : run.solution.rigidGroups) text += motionText(run, group, units.length, dimension);
  if (run.solution.safety.ofBodies.empty() || !leastOf(run.solution.safety).exists()) return text;
  const LeastSafety& least = leastOf(run.solution.safety);
  const Material& material = least.material(run.model);
  text += format("   safety factor at least %.3g in '%s' at %s, by %s of '%s'", least.factor, bodyName(run, least.body).c_str(),
                 placeText(least.place, dimension).c_str(), material.strength->name().c_str(), material.name.c_str());
  if (least.step > 0) text += format(" in load step %d", least.step);
  return text + (found.recovered ? " (recovered at nodes)\n" : " (at centroids)\n");
}

}  // namespace suture
