#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/ExactSolution.hpp>

namespace suture {
namespace {

const std::vector<std::string> inPlane{"Displacement x", "Displacement y"}, inSpace{"Displacement x", "Displacement y", "Displacement z"};
const std::vector<std::string> stressInPlane{"Stress xx", "Stress yy", "Stress xy"},
    stressInSpace{"Stress xx", "Stress yy", "Stress zz", "Stress xy", "Stress yz", "Stress xz"};

void addFields(Schema& schema) {
  for (const std::string& name : inSpace)
    schema
        .text(name, std::nullopt,
              name == inSpace.back() ? "the same, in 3D only"
                                     : "an expression in x and y (3D: x, y and z), the position in the undeformed body [length]")
        .optional();
  for (const std::string& name : stressInSpace) {
    const bool across = name == "Stress zz", onlyInSpace = name == "Stress yz" || name == "Stress xz";
    schema
        .text(name, std::nullopt,
              across        ? "in 3D, or the hoop stress of an axisymmetric scene; in 2D it follows from the Model"
              : onlyInSpace ? "the same, in 3D only"
                            : "an expression of position, tension positive [stress]")
        .optional();
  }
}

// All of the names or none of them; `elsewhere`: default if the list does not define the field.
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

std::vector<Expression> readStress(const Parameters& list, int dimension, const Constants& constants,
                                   const std::vector<Expression>& elsewhere, Problems& problems) {
  if (dimension == 3) return readField(list, stressInSpace, constants, elsewhere, problems);
  std::vector<Expression> field = readField(list, stressInPlane, constants, elsewhere, problems);
  if (const auto across = readExpression(list, "Stress zz", constants, problems)) {
    if (field.size() == stressInPlane.size())
      field.push_back(*across);
    else if (field.size() == stressInPlane.size() + 1)
      field.back() = *across;
  }
  return field;
}

// Fields of a list; fields that it does not define are taken from `elsewhere`.
ExactFields readFields(const Parameters& list, int dimension, const Constants& constants, const ExactFields& elsewhere,
                       Problems& problems) {
  if (dimension == 2)
    for (const char* name : {"Displacement z", "Stress yz", "Stress xz"})
      if (list.isParameter(name)) problems.add(pathOf(list, name), "needs a 3D scene (Model = Solid); this one is 2D");
  ExactFields fields;
  fields.displacement = readField(list, dimension == 2 ? inPlane : inSpace, constants, elsewhere.displacement, problems);
  fields.stress = readStress(list, dimension, constants, elsewhere.stress, problems);
  return fields;
}

void requireAllBodies(const ExactSolution& exact, std::vector<Expression> ExactFields::*field, const std::string& what,
                      const Parameters& list, const std::vector<std::string>& bodies, Problems& problems) {
  std::vector<std::string> known, unknown;
  for (std::size_t body = 0; body < bodies.size(); ++body) ((exact.ofBody[body].*field).empty() ? unknown : known).push_back(bodies[body]);
  if (!known.empty() && !unknown.empty())
    problems.add(pathOf(list), "the exact " + what + " is given for " + joinNames(known) + " but not for " + joinNames(unknown) +
                                   "; errors need it for every body");
}

}  // namespace

Schema exactSolutionSchema() {
  Schema schema(
      "The exact solution, as far as it is known. Errors against it are computed in the L2 norm and in the energy norm, and reported.");
  addFields(schema);
  schema
      .text("Pressure", std::nullopt,
            "an expression of position: the pressure on all contact lines (3D: surfaces), > 0 compressive [stress]")
      .optional();
  Schema body("fields of one body, instead of those above");
  addFields(body);
  return schema.list("Bodies", Schema("Exact solutions that differ between bodies.").each("<body>", body));
}

ExactSolution readExactSolution(const Parameters& list, const std::vector<std::string>& bodies, int dimension, const Constants& constants,
                                Problems& problems) {
  const std::size_t before = problems.list().size();
  const ExactFields common = readFields(list, dimension, constants, {}, problems);
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
    exact.ofBody[body - bodies.begin()] = readFields(own.sublist(name), dimension, constants, common, problems);
  }
  if (problems.list().size() > before) return exact;
  requireAllBodies(exact, &ExactFields::displacement, "displacement", list, bodies, problems);
  requireAllBodies(exact, &ExactFields::stress, "stress", list, bodies, problems);
  return exact;
}

}  // namespace suture
