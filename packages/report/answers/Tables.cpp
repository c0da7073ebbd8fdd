#include <suture/base/Point.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/Tables.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace suture {

namespace {

constexpr double kRounding = 1e-12;

std::string vectorFields(const Point& vector, double largest) {
  return csvNumber(vector[0], largest) + csvNumber(vector[1], largest) + csvNumber(vector[2], largest);
}

/// Largest force and moment of a table.
struct Scales {
  double force = 0.0, moment = 0.0;
  void take(const Resultant& sum) {
    force = std::max(force, norm(sum.force));
    moment = std::max(moment, norm(sum.moment));
  }
  std::string fields(const Resultant& sum) const { return vectorFields(sum.force, force) + vectorFields(sum.moment, moment); }
};

const char* slidingOf(const PairResult& pair) {
  if (!pair.kind.restrictsSliding || !pair.state.closed()) return "";
  return pair.state.status == PairStatus::Stick ? "stick" : "slip";
}

const char* statusOf(const PairResult& pair) { return pair.state.closed() ? "closed" : pair.touching ? "touching" : "open"; }

}  // namespace

std::string tableName(const std::string& kind, const std::string& name) {
  std::string file = name;
  for (char& c : file)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return kind + "_" + file + ".csv";
}

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csvNumber(double value, double largest) {
  if (std::abs(value) <= kRounding * largest) return ",0";
  char text[32] = ",";
  return {text, std::to_chars(text + 1, text + sizeof text, value, std::chars_format::general, 9).ptr};  // as %.9g, three times faster
}

void writeContactTable(const Run& run, const std::string& path) {
  const bool frictional = hasFriction(run.solution.pairs);
  std::string text = "pair,contact,body_a,body_b,x,y,z,nx,ny,nz,arc_length,initial_gap,gap,pressure,force,length,status";
  text += frictional ? ",tx,ty,tz,slip_x,slip_y,slip_z,bound,dissipated,sliding\n" : "\n";
  double place = 0.0, gap = 0.0, pressure = 0.0, force = 0.0;
  for (const PairResult& pair : run.solution.pairs) {
    place = std::max(place, norm(pair.position));
    gap = std::max({gap, std::abs(pair.gap), std::abs(pair.initialGap), norm(pair.displacement)});
    pressure = std::max(pressure, std::abs(pair.pressure));
    force = std::max(force, std::abs(pair.force));
  }
  for (const PairResult& pair : run.solution.pairs) {
    const bool named = pair.line >= 0 && pair.line < static_cast<int>(run.contacts.size());
    text += std::to_string(pair.id) + "," + csvField(named ? run.contacts[pair.line] : "") + "," + csvField(bodyName(run, pair.bodies[0])) +
            "," + csvField(bodyName(run, pair.bodies[1])) + vectorFields(pair.position, place) + vectorFields(pair.normal, 1.0) +
            csvNumber(pair.arc, place) + csvNumber(pair.initialGap, gap) + csvNumber(pair.gap, gap) + csvNumber(pair.pressure, pressure) +
            csvNumber(pair.force, force) + csvNumber(pair.length, 0.0) + "," + statusOf(pair);
    if (frictional)
      text += vectorFields(pair.tangential, force) + vectorFields(pair.slip, gap) + csvNumber(pair.bound, force) +
              csvNumber(pair.dissipated, force * gap) + "," + slidingOf(pair);
    text += "\n";
  }
  writeTextFile(path, text);
}

namespace {
std::string bodyNames(const Run& run, const std::vector<int>& bodies) {
  std::vector<std::string> names;
  for (const int body : bodies) names.push_back(bodyName(run, body));
  return joinNames(names);
}
}  // namespace

namespace {

/// Further columns of reactions.csv: errors and bounds of the forces, if they are requested.
class ErrorColumns {
 public:
  explicit ErrorColumns(const Run& run) : hasErrors_(run.solution.errorBars.has_value()), hasBounds_(!run.solution.intervals.empty()) {}

  std::string names() const {
    return std::string(hasErrors_ ? ",force_error" : "") +
           (hasBounds_ ? ",fx_low,fx_high,fy_low,fy_high,fz_low,fz_high,displacement,displacement_low,displacement_high" : "");
  }
  std::string fields(const std::optional<double>& error = std::nullopt, const ForceInterval* bounds = nullptr) const {
    std::string text;
    if (hasErrors_) text += field(error);
    if (!hasBounds_) return text;
    for (std::size_t k = 0; k < 3; ++k) text += fields(bounds ? bounds->force[k] : std::nullopt);
    return text + field(bounds ? bounds->displacement : std::nullopt) + fields(bounds ? bounds->ofDisplacement : std::nullopt);
  }

 private:
  static std::string field(const std::optional<double>& value) { return value ? csvNumber(*value, 0.0) : ","; }
  static std::string fields(const std::optional<Interval>& one) {
    return one ? csvNumber(one->low, 0.0) + csvNumber(one->high, 0.0) : ",,";
  }

  bool hasErrors_, hasBounds_;
};

}  // namespace

void writeReactionTable(const Run& run, const std::string& path) {
  const std::vector<ConditionResultant> conditions = conditionResultants(run);
  const std::vector<ContactResultant> contacts = contactResultants(run);
  const Resultant sum = sumOfResultants(conditions, contacts);
  const ForceErrors errors(run, conditions, contacts);
  const ErrorColumns columns(run);
  Scales scales;
  for (const ConditionResultant& condition : conditions) scales.take(condition.sum);
  for (const ContactResultant& contact : contacts) scales.take(contact.onB);
  double place = 0.0;
  for (const PairResult& pair : run.solution.pairs) place = std::max(place, norm(pair.position));
  std::string text = "name,kind,body_a,body_b,fx,fy,fz,mx,my,mz,centre_x,centre_y,centre_z,closed" + columns.names() + "\n";
  for (const ConditionResultant& condition : conditions)
    text += csvField(condition.name) + "," + condition.kind + ",," + scales.fields(condition.sum) + ",,,," +
            columns.fields(errors.of(condition), intervalOf(run, condition.name, false)) + "\n";
  const auto add = [&](const std::string& name, const char* kind, const ContactResultant& contact, const std::string& fields) {
    text += csvField(name) + "," + kind + "," + csvField(bodyNames(run, contact.bodies[0])) + "," +
            csvField(bodyNames(run, contact.bodies[1])) + scales.fields(contact.onB) +
            (contact.presses() ? vectorFields(contact.centre, place) : ",,,") + csvNumber(contact.closed, 0.0) + fields + "\n";
  };
  for (std::size_t line = 0; line < contacts.size(); ++line) {
    add(run.contacts[line], "contact", contacts[line],
        columns.fields(errors.ofContact(static_cast<int>(line)), intervalOf(run, run.contacts[line], true)));
    for (const ContactResultant& part : contacts[line].ofBodies)
      add(run.contacts[line] + ": " + bodyNames(run, part.bodies[0]) + ", " + bodyNames(run, part.bodies[1]), "bodies", part,
          columns.fields());
  }
  text += "sum,sum,," + scales.fields(sum) + ",,,," + columns.fields() + "\n";
  writeTextFile(path, text);
}

}  // namespace suture
