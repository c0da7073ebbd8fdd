#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/constraints/ConditionForm.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text = names[0];
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

}  // namespace

const std::vector<std::string>& expressionNames() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    for (const ConditionForm& form : conditionForms())
      for (const int dimension : {2, 3})
        for (const std::string& name : form.expressions(dimension))
          if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return names;
  }();
  return all;
}

ConditionData readConditionData(const Parameters& condition, const Constants& constants, Problems& problems, int dimension) {
  const auto type = condition.get<std::string>("Type");
  const ConditionForm& form = formNamed(type);
  const std::string components = form.isPartial() ? condition.get<std::string>("Components") : "All";
  const bool isDirected =
      form.type == Condition::Type::Displacement && (condition.isParameter("Direction") || condition.isParameter("Along"));
  const std::vector<std::string> names = isDirected ? std::vector<std::string>{"Expression"} : form.expressions(dimension, components);
  if (names.empty()) return {};  // 3D components in 2D, which readConditions() reports
  const std::string alternative = form.varies ? ", or " + joined(names) : "";
  const bool valued = condition.isParameter("Value");
  ConditionData data;
  std::vector<std::string> given;
  for (const std::string& name : expressionNames()) {
    if (!condition.isParameter(name)) continue;
    given.push_back(name);
    if (!form.varies)
      problems.add(pathOf(condition, name), "not a parameter of this " + type + ": expected numbers in Value");
    else if (std::find(names.begin(), names.end(), name) == names.end())
      problems.add(pathOf(condition, name), "not a parameter of this " + type + ": expected " + joined(names));
  }
  if (valued && !given.empty()) {
    problems.add(pathOf(condition, "Value"), "'Value' and '" + given[0] + "' are both given; expected only one of them");
  } else if (!given.empty()) {
    if (!form.varies) return data;
    for (const std::string& name : names)
      if (!condition.isParameter(name))
        problems.add(pathOf(condition, name), "is missing: this " + type + " needs " + joined(names) + "; write 0 for a zero component");
      else if (const auto expression = readExpression(condition, name, constants, problems))
        data.expressions.push_back(*expression);
  } else {
    if (valued) data.values = condition.get<Teuchos::Array<double>>("Value").toVector();
    const std::size_t wanted = names.size();
    if (data.values.size() == wanted) return data;
    std::string example = "{0.0";
    for (std::size_t i = 1; i < wanted; ++i) example += ", 0.0";
    const std::string expected = std::to_string(wanted) + (wanted == 1 ? " value" : " values, as in " + example + "}") + alternative;
    problems.add(pathOf(condition, "Value"),
                 (valued ? std::to_string(data.values.size()) + " values" : "is missing") + "; this " + type + " needs " + expected);
  }
  return data;
}

}  // namespace suture
