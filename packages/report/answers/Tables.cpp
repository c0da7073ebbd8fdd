#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/Tables.hpp>

namespace suture {

namespace {

std::string vectorFields(const Point& vector) { return format(",%.9g,%.9g,%.9g", vector[0], vector[1], vector[2]); }

std::string resultantFields(const Resultant& sum) { return vectorFields(sum.force) + vectorFields(sum.moment); }

const char* statusOf(const PairResult& pair) { return pair.state.closed() ? "closed" : pair.touching ? "touching" : "open"; }

}  // namespace

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void writeContactTable(const Run& run, const std::string& path) {
  std::string text = "pair,contact,body_a,body_b,x,y,z,nx,ny,nz,arc_length,initial_gap,gap,pressure,force,length,status\n";
  for (const PairResult& pair : run.solution.pairs) {
    const bool named = pair.line >= 0 && pair.line < static_cast<int>(run.contacts.size());
    text += std::to_string(pair.id) + "," + csvField(named ? run.contacts[pair.line] : "") + "," + csvField(bodyName(run, pair.bodies[0])) +
            "," + csvField(bodyName(run, pair.bodies[1])) + vectorFields(pair.position) + vectorFields(pair.normal) +
            format(",%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%s\n", pair.arc, pair.initialGap, pair.gap, pair.pressure, pair.force, pair.length,
                   statusOf(pair));
  }
  writeTextFile(path, text);
}

void writeReactionTable(const Run& run, const std::string& path) {
  const std::vector<ConditionResultant> conditions = conditionResultants(run);
  const std::vector<ContactResultant> contacts = contactResultants(run);
  std::string text = "name,kind,body_a,body_b,fx,fy,fz,mx,my,mz,centre_x,centre_y,centre_z,closed\n";
  for (const ConditionResultant& condition : conditions)
    text += csvField(condition.name) + "," + condition.kind + ",," + resultantFields(condition.sum) + ",,,,\n";
  for (std::size_t line = 0; line < contacts.size(); ++line) {
    const ContactResultant& contact = contacts[line];
    text += csvField(run.contacts[line]) + ",contact," + csvField(bodyName(run, contact.bodies[0])) + "," +
            csvField(bodyName(run, contact.bodies[1])) + resultantFields(contact.onB) +
            (contact.presses() ? vectorFields(contact.centre) : ",,,") + format(",%.9g\n", contact.closed);
  }
  text += "sum,sum,," + resultantFields(sumOfResultants(conditions, contacts)) + ",,,,\n";
  writeTextFile(path, text);
}

}  // namespace suture
