// The only source that includes muParser.
#include "Expression.hpp"

#include <muParser.h>

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <suture/base/scene/SceneReader.hpp>
#include <suture/base/scene/Schema.hpp>
#include "Errors.hpp"
#include "Numbers.hpp"

namespace suture {
namespace {

bool isName(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && letter(text[0]) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

template <typename Map>
std::vector<std::string> namesOf(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

double zero(const double*, int) { return 0.0; }

// Indexed by Constants::dimension: variables, formulas in them, their values.
const std::string kVariables[] = {"", "t", "xy", "xyz"};
const char* const kFormula[] = {"", "t, such as min(t, 1)", "x and y, such as 0.1 * x^2 + sin(pi * y)",
                                "x, y and z, such as 0.1 * x^2 + z"};
const char* const kPlace[] = {"", "t = %.10g", "(x, y) = (%.10g, %.10g)", "(x, y, z) = (%.10g, %.10g, %.10g)"};

}  // namespace

struct Expression::Compiled {
  /// A user's function that this one uses, and the storage from which the parser reads its value.
  struct Used {
    std::shared_ptr<const Compiled> function;
    mutable double value = 0.0;
  };

  mutable Point place{0, 0, 0};  // variables: the parser holds pointers to them, so the object is never copied
  const int dimension;           // number of variables, or components of `place`
  std::map<std::string, Used> used;
  mu::Parser parser;
  std::string text, path;

  Compiled(const std::string& given, const Constants& constants, const std::string& where)
      : dimension(constants.dimension), text(trimmed(given)), path(where) {
    parser.ClearConst();
    parser.DefineConst("pi", 3.14159265358979323846);
    for (const auto& [name, value] : constants.numbers) parser.DefineConst(name, value);
    for (int k = 0; k < dimension; ++k) parser.DefineVar(kVariables[dimension].substr(k, 1), &place[k]);
    for (const auto& [name, function] : constants.functions) {
      Used& use = used[name];
      use.function = function.compiled_;
      parser.DefineVar(name, &use.value);
    }
    compile();
    const auto names = parser.GetUsedVar();
    for (auto use = used.begin(); use != used.end();) {
      if (names.count(use->first)) {
        ++use;
        continue;
      }
      parser.RemoveVar(use->first);
      use = used.erase(use);
    }
  }

  /// May be nan or infinite: a function need not be defined at points where it is not used.
  double at(const Point& point) const {
    place = point;
    for (const auto& entry : used) entry.second.value = entry.second.function->at(point);
    try {
      return parser.Eval();
    } catch (const mu::ParserError&) {  // some builds of muParser throw where a function is undefined
      return std::nan("");
    }
  }
  Compiled(const Compiled&) = delete;

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(path, "'" + text + "': " + what); }

  // Each unknown name is defined as a dummy, so that the remaining unknown names are found, too.
  void compile() {
    const std::vector<std::string> known[] = {namesOf(parser.GetVar()), namesOf(parser.GetConst()), namesOf(parser.GetFunDef())};
    std::vector<std::string> all;
    for (const auto& names : known) all.insert(all.end(), names.begin(), names.end());
    std::string unknown;
    refuseAssignment();
    for (;;) try {
        parser.SetExpr(text);
        parser.Eval();
        break;
      } catch (const mu::ParserError& error) {
        const std::string token = error.GetToken();
        if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN || !isName(token)) fail(syntax(error));
        if (parser.GetFunDef().count(token)) fail("the function " + token + " needs its arguments in parentheses");
        const std::string nearest = token.size() > 1 ? nearestName(token, all) : "";  // any letter is close to any other
        unknown += (unknown.empty() ? "" : ", ") + ("'" + token + "'") + (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)");
        const std::size_t next = text.find_first_not_of(' ', error.GetPos() + token.size());
        if (next != std::string::npos && text[next] == '(')
          parser.DefineFun(token, zero);
        else
          parser.DefineConst(token, 0.0);
      }
    if (!unknown.empty())
      fail("unknown: " + unknown + ". Variables: " + joinNames(known[0]) + ". Constants: " + joinNames(known[1]) +
           ". Functions: " + joinNames(known[2]));
    if (parser.GetNumResults() != 1) fail("has " + std::to_string(parser.GetNumResults()) + " values separated by commas, expected one");
  }

  // muParser would assign to the variable.
  void refuseAssignment() const {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '=') continue;
      const bool comparison = (i > 0 && std::string("=<>!").find(text[i - 1]) != std::string::npos) || text[i + 1] == '=';
      if (!comparison) fail("'=' at character " + std::to_string(i + 1) + ": to compare, write ==");
    }
  }

  std::string syntax(const mu::ParserError& error) const {
    const std::size_t position = error.GetPos() < 0 ? text.size() : std::min<std::size_t>(error.GetPos(), text.size());
    const std::string rest = position < text.size() ? " ('" + text.substr(position) + "')" : " (the end)";
    std::string why = error.GetMsg();
    const std::size_t place = std::min(why.find(" found at position"), why.find(" at "));  // counted from 0; our message counts from 1
    if (place != std::string::npos) why.resize(place);
    return (text.empty() ? "is empty" : "not an expression at character " + std::to_string(position + 1) + rest + ": " + why) +
           "; expected a formula in " + kFormula[dimension];
  }
};

Expression::Expression(const std::string& text, const Constants& constants, const std::string& path)
    : compiled_(std::make_shared<Compiled>(text, constants, path)) {}

Expression::Expression(const std::string& text) : Expression(text, Constants()) {}

Expression::Expression(std::function<double(const Point&)> function) : function_(std::move(function)) {
  const auto named = std::make_shared<Compiled>("0", Constants(), "");
  named->text = "a function of the program";
  compiled_ = named;
}

double Expression::at(const Point& point) const {
  const Compiled& c = *compiled_;
  const double value = function_ ? function_(point) : c.at(point);
  if (!std::isfinite(value)) {
    char place[120];
    std::snprintf(place, sizeof place, kPlace[c.dimension], point[0], point[1], point[2]);
    throw InputError(c.path, "'" + c.text + "' is " + (std::isnan(value) ? "not a number (nan)" : "infinite") + " at " + place);
  }
  return value;
}

const std::string& Expression::text() const { return compiled_->text; }

std::vector<std::string> Expression::functions() { return namesOf(mu::Parser().GetFunDef()); }

std::string Expression::libraryVersion() { return mu::Parser().GetVersion(mu::pviBRIEF); }

Schema constantsSchema() {
  return Schema("Numbers for the expressions of this scene, named by the user. pi is predefined.")
      .eachReal("constant", "value of the name in every expression");
}

Schema functionsSchema() {
  return Schema("Functions of x and y (in 3D also z) for expressions, named by the user: r = sqrt(x^2 + y^2), or mu = E/(2*(1 + nu)).")
      .eachText("function", "an expression, which may use Constants and the functions above it; other expressions may use its name");
}

namespace {

bool isUsable(const Parameters& list, const std::string& name, const Constants& before, Problems& problems) {
  static const mu::Parser standard;
  if (!isName(name))
    problems.add(pathOf(list, name), "'" + name + "' cannot be used in an expression: expected letters, digits and _, a letter first");
  else if (name == "x" || name == "y" || (name == "z" && before.dimension == 3) || name == "pi" || standard.GetFunDef().count(name) ||
           before.has(name))
    problems.add(pathOf(list, name), "'" + name + "' already has a meaning in expressions: choose another name");
  else
    return true;
  return false;
}

}  // namespace

Constants readConstants(const Parameters& list, Problems& problems, int dimension) {
  Constants constants;
  constants.dimension = dimension;
  for (auto entry = list.begin(); entry != list.end(); ++entry)
    if (isUsable(list, list.name(entry), constants, problems)) constants.numbers[list.name(entry)] = list.get<double>(list.name(entry));
  return constants;
}

void readFunctions(const Parameters& list, Constants& constants, Problems& problems) {
  for (auto entry = list.begin(); entry != list.end(); ++entry) {
    const std::string& name = list.name(entry);
    if (!isUsable(list, name, constants, problems)) continue;
    if (const auto function = readExpression(list, name, constants, problems)) constants.functions.emplace(name, *function);
  }
}

Constants sceneConstants(const Parameters& scene) {
  Problems problems;
  Constants constants;
  if (scene.isType<std::string>("Model") && scene.get<std::string>("Model") == "Solid") constants.dimension = 3;
  if (scene.isSublist("Constants")) constants = readConstants(scene.sublist("Constants"), problems, constants.dimension);
  if (scene.isSublist("Functions")) readFunctions(scene.sublist("Functions"), constants, problems);
  problems.throwIfAny();
  return constants;
}

std::optional<Expression> readExpression(const Parameters& list, const std::string& parameter, const Constants& constants,
                                         Problems& problems) {
  if (!list.isType<std::string>(parameter)) return std::nullopt;
  try {
    return Expression(list.get<std::string>(parameter), constants, pathOf(list, parameter));
  } catch (const InputError& error) {
    problems.add(error);
    return std::nullopt;
  }
}

}  // namespace suture
