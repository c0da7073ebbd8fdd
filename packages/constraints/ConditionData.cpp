#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ConditionData.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace suture {

namespace {

std::vector<std::string> expressionsOf(const Parameters& condition, const std::string& type) {
  if (type == "Pressure") return {"Expression"};
  const std::string components = type == "Displacement" ? condition.get<std::string>("Components") : "All";
  if (components == "All") return {"Expression x", "Expression y"};
  return {"Expression " + components};
}

std::string joined(const std::vector<std::string>& names) { return names.size() == 1 ? names[0] : names[0] + " and " + names[1]; }

}  // namespace

const std::vector<std::string>& expressionNames() {
  static const std::vector<std::string> all{"Expression", "Expression x", "Expression y"};
  return all;
}

ConditionData readConditionData(const Parameters& condition, const Constants& constants, Problems& problems) {
  const auto type = condition.get<std::string>("Type");
  const std::vector<std::string> names = expressionsOf(condition, type);
  const bool valued = condition.isParameter("Value");
  ConditionData data;
  std::vector<std::string> given;
  for (const std::string& name : expressionNames()) {
    if (!condition.isParameter(name)) continue;
    given.push_back(name);
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.add(pathOf(condition, name), "this " + type + " does not have it: expected " + joined(names));
  }
  if (valued && !given.empty()) {
    problems.add(pathOf(condition, "Value"), "'Value' and '" + given[0] + "' are both given: it is one or the other");
  } else if (!given.empty()) {
    for (const std::string& name : names)
      if (!condition.isParameter(name))
        problems.add(pathOf(condition, name), "is missing: this " + type + " needs " + joined(names) + "; a component that is zero is 0");
      else if (const auto expression = readExpression(condition, name, constants, problems))
        data.expressions.push_back(*expression);
  } else {
    if (valued) data.values = condition.get<Teuchos::Array<double>>("Value").toVector();
    const std::size_t wanted = names.size();
    if (data.values.size() == wanted) return data;
    const std::string expected = std::to_string(wanted) + (wanted == 1 ? " value" : " values, as in {0.0, 0.0}") + ", or " + joined(names);
    problems.add(pathOf(condition, "Value"),
                 (valued ? std::to_string(data.values.size()) + " values" : "is missing") + "; this " + type + " needs " + expected);
  }
  return data;
}

}  // namespace suture
