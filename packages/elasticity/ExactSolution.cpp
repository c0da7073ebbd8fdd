#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/ExactSolution.hpp>

namespace suture {
namespace {

const std::vector<std::string> displacementNames{"Displacement x", "Displacement y"}, stressNames{"Stress xx", "Stress yy", "Stress xy"};

void addFields(Schema& schema) {
  for (const std::string& name : displacementNames)
    schema.text(name, std::nullopt, "an expression in x and y, the place on the undeformed body [length]").optional();
  for (const std::string& name : stressNames)
    schema.text(name, std::nullopt, "an expression in x and y, tension positive [stress]").optional();
  schema.text("Stress zz", std::nullopt, "the hoop stress of an axisymmetric scene; in the plane it follows from the Model").optional();
}

// All of the names or none of them; `elsewhere` is what the field is where the list says nothing.
std::vector<Expression> readField(const Parameters& list, const std::vector<std::string>& names, const Constants& constants,
                                  const std::vector<Expression>& elsewhere, Problems& problems) {
  const auto given = [&](const std::string& name) { return list.isParameter(name); };
  if (std::none_of(names.begin(), names.end(), given)) return elsewhere;
  std::vector<Expression> field;
  for (const std::string& name : names) {
    if (!given(name))
      problems.add(pathOf(list, name), "is missing: expected all of " + joinNames(names) + ", or none");
    else if (const auto expression = readExpression(list, name, constants, problems))
      field.push_back(*expression);
  }
  return field;
}

std::vector<Expression> readStress(const Parameters& list, const Constants& constants, const std::vector<Expression>& elsewhere,
                                   Problems& problems) {
  std::vector<Expression> field = readField(list, stressNames, constants, elsewhere, problems);
  if (const auto across = readExpression(list, "Stress zz", constants, problems)) {
    if (field.size() == stressNames.size())
      field.push_back(*across);
    else if (field.size() == stressNames.size() + 1)
      field.back() = *across;
  }
  return field;
}

void requireAllBodies(const ExactSolution& exact, std::vector<Expression> ExactFields::*field, const std::string& what,
                      const Parameters& list, const std::vector<std::string>& bodies, Problems& problems) {
  std::vector<std::string> known, unknown;
  for (std::size_t body = 0; body < bodies.size(); ++body) ((exact.ofBody[body].*field).empty() ? unknown : known).push_back(bodies[body]);
  if (!known.empty() && !unknown.empty())
    problems.add(pathOf(list), "the exact " + what + " is given for " + joinNames(known) + " but not for " + joinNames(unknown) +
                                   "; errors need it of every body");
}

}  // namespace

Schema exactSolutionSchema() {
  Schema schema(
      "The exact solution, as far as it is known: errors are measured against it, in the norm of L2 and in the energy norm, and "
      "reported.");
  addFields(schema);
  schema.text("Pressure", std::nullopt, "an expression in x and y: the contact pressure on all contact lines, > 0 compressive [stress]")
      .optional();
  Schema body("of one body: instead of those above");
  addFields(body);
  return schema.list("Bodies", Schema("Where bodies differ.").each("<body>", body));
}

ExactSolution readExactSolution(const Parameters& list, const std::vector<std::string>& bodies, const Constants& constants,
                                Problems& problems) {
  const std::size_t before = problems.list().size();
  ExactFields common;
  common.displacement = readField(list, displacementNames, constants, {}, problems);
  common.stress = readStress(list, constants, {}, problems);
  ExactSolution exact;
  exact.pressure = readExpression(list, "Pressure", constants, problems);
  exact.ofBody.assign(bodies.size(), common);
  const Parameters& own = list.sublist("Bodies");
  for (const std::string& name : sublistNames(own)) {
    const auto body = std::find(bodies.begin(), bodies.end(), name);
    if (body == bodies.end()) {
      problems.add(pathOf(own, name), unknownName("body", name, bodies));
      continue;
    }
    ExactFields& fields = exact.ofBody[body - bodies.begin()];
    fields.displacement = readField(own.sublist(name), displacementNames, constants, common.displacement, problems);
    fields.stress = readStress(own.sublist(name), constants, common.stress, problems);
  }
  if (problems.list().size() > before) return exact;
  requireAllBodies(exact, &ExactFields::displacement, "displacement", list, bodies, problems);
  requireAllBodies(exact, &ExactFields::stress, "stress", list, bodies, problems);
  return exact;
}

}  // namespace suture
