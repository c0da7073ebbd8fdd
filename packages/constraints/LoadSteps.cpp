#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/constraints/LoadSteps.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

constexpr const char* kTimes = "Times";
constexpr const char* kFactors = "Factors";
constexpr double kLargestChange = 0.2;  // fraction of the pairs: if more change in one step, their order may be wrong
constexpr int kHalvings = 6;

/// Condition types that have nothing to multiply, or an amount that the solution determines.
const std::set<std::string> kWithoutAmount = {"Bilateral", "Elastic Support", "Mean Displacement", "Preload"};

}  // namespace

Schema LoadSteps::schema() {
  Schema steps("Load steps, for contact whose solution depends on the order of the loads. Without Times: one step, without history.");
  steps.reals(kTimes, std::vector<double>(), "Ends of the steps; the path starts at 0 with undeformed bodies.");
  steps.real(
      "Largest Change", kLargestChange,
      "Fraction of the contact pairs that may open, close or begin to slip in one step with friction; if more do, the step is halved.",
      {0.0, 1.0, true, false, {}});
  steps.integer("Halvings", kHalvings, "How often a step may be halved, because it failed or because of Largest Change.",
                {0.0, 30.0, false, false, {}});
  steps.list(kFactors, Schema("Factors of boundary conditions, by name; all other conditions act in full from the first step on.")
                           .eachText("condition",
                                     "an expression in the time t, such as min(t, 1), or values at Times, {0.5, 1, 1}, linear between "
                                     "Times and from 0 at time 0"));
  steps.list("Removed", Schema("Bodies and regions of bodies that are removed, as by an excavation, by name. The forces by which a removed "
                               "part held the others fall to zero in the next load step.")
                            .eachReal("part", "the last time at which it exists: 0 or one of Times"));
  steps.list(
      "Release",
      Schema("Forces of removed parts that are released over several load steps, by the name of the part: a lining placed "
             "between them carries the rest. Without an entry all are released in the next step.")
          .eachText("part", "fractions released by the ends of the steps after its removal, ascending to 1, linear between: {0.4, 1}"));
  steps.list("Placed", Schema("Bodies that are placed later, such as a lining, by name; a placed body fits to the deformed sides of its "
                              "contacts and has no stress until these move on.")
                           .eachReal("body", "the time at which it is placed: one of Times"));
  return steps;
}

LoadSteps::LoadSteps(const Parameters& list, const std::vector<Named>& conditions, const Constants& constants)
    : largestChange_(list.get<double>("Largest Change")), halvings_(list.get<int>("Halvings")) {
  Problems problems;
  const auto times = list.get<Teuchos::Array<double>>(kTimes);
  times_.assign(times.begin(), times.end());
  for (std::size_t i = 0; i < times_.size(); ++i)
    if (const double before = i > 0 ? times_[i - 1] : 0.0; !(times_[i] > before))
      problems.add(pathOf(list, kTimes),
                   "time " + realText(times_[i]) + " after " + realText(before) + "; expected ascending times above 0");
  const Parameters& factors = list.sublist(kFactors);
  if (times_.empty() && factors.numParams() > 0)
    problems.add(pathOf(list, kTimes), "is empty, but Factors are given; expected the ends of the load steps, such as {0.5, 1}");
  std::vector<std::string> names;
  for (const Named& condition : conditions) names.push_back(condition.first);
  std::map<std::string, int> known;  // texts of functions
  for (auto entry = factors.begin(); entry != factors.end(); ++entry) {
    const std::string& name = factors.name(entry);
    const auto condition = std::find_if(conditions.begin(), conditions.end(), [&](const Named& one) { return one.first == name; });
    if (condition == conditions.end()) {
      problems.add(pathOf(factors, name), unknownName("boundary condition", name, names));
      continue;
    }
    if (kWithoutAmount.count(condition->second)) {
      problems.add(pathOf(factors, name), "is a factor of " + withArticle(condition->second) +
                                              ", which has no amount to multiply; expected a load or a Displacement");
      continue;
    }
    const auto [found, isNew] = known.emplace(trimmed(factors.get<std::string>(name)), this->factors());
    if (isNew) functions_.push_back(readFunction(factors, name, constants, problems));
    factorOf_[name] = found->second;
  }
  problems.throwIfAny();
}

LoadSteps::Function LoadSteps::readFunction(const Parameters& list, const std::string& name, const Constants& constants,
                                            Problems& problems) const {
  Function function;
  const std::string text = trimmed(list.get<std::string>(name));
  if (text.empty() || text.front() != '{') {
    Constants ofTime;
    ofTime.numbers = constants.numbers;
    ofTime.dimension = 1;
    if (const auto expression = readExpression(list, name, ofTime, problems)) function.expression.push_back(*expression);
    return function;
  }
  const auto entries = parseEntries(text);
  for (const std::string& entry : entries ? *entries : std::vector<std::string>())
    if (const auto value = parseReal(entry)) function.table.push_back(*value);
  if (!entries || function.table.size() != entries->size() || function.table.size() != times_.size())
    problems.add(pathOf(list, name),
                 "'" + text + "'; expected a number for each of the " + std::to_string(times_.size()) + " Times, or an expression in t");
  return function;
}

int LoadSteps::factorOf(const std::string& condition) const {
  const auto found = factorOf_.find(condition);
  return found == factorOf_.end() ? 0 : found->second;
}

std::vector<double> LoadSteps::at(double time) const {
  std::vector<double> all{1.0};
  for (const Function& function : functions_) {
    if (!function.expression.empty()) {
      all.push_back(function.expression.front().at({time, 0, 0}));
      continue;
    }
    const auto next = std::lower_bound(times_.begin(), times_.end(), time);
    const auto i = static_cast<std::size_t>(std::min(next, times_.end() - 1) - times_.begin());
    const double begin = i > 0 ? times_[i - 1] : 0.0, first = i > 0 ? function.table[i - 1] : 0.0;
    const double part = std::min(1.0, (time - begin) / (times_[i] - begin));
    all.push_back(part == 1.0 ? function.table[i] : first + part * (function.table[i] - first));
  }
  return all;
}

}  // namespace suture
