#include "SceneResolver.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <map>

#include <suture/base/Numbers.hpp>

namespace suture {
namespace {

using Kind = Schema::Kind;

/// Expected form of a value of this kind, with its allowed names or its range.
std::string expectation(const Schema::Parameter& parameter) {
  static const std::map<Kind, std::string> forms{{Kind::Integer, "an integer"},
                                                 {Kind::Real, "a number"},
                                                 {Kind::Boolean, "true or false"},
                                                 {Kind::Text, "a text"},
                                                 {Kind::Reals, "numbers as in {1.0, 2.0}"},
                                                 {Kind::Integers, "integers as in {1, 2}"},
                                                 {Kind::Texts, "names as in {a, b}"}};
  std::string text = parameter.orOne ? "a name, or several as in {a, b}" : forms.at(parameter.kind);
  const bool number = parameter.kind != Kind::Text && parameter.kind != Kind::Texts && parameter.kind != Kind::Boolean;
  if (number && parameter.range.text() != "any") text += ", " + parameter.range.text();
  if (!parameter.allowed.empty()) text = "one of: " + joinNames(parameter.allowed);
  if (parameter.numberToo)
    text =
        "one of: " + joinNames(parameter.words) + ", or a number" + (parameter.range.text() == "any" ? "" : " " + parameter.range.text());
  return text;
}

/// A choice that decides whether parameters have an effect, and the value of the choice that they belong to.
struct Owner {
  std::string list, choice, value;  // path of the list, name of its choice, value of the choice
};

using Owners = std::vector<Owner>;  // the outermost first

/// A given parameter that belongs to choices. Whether these are taken is known only after fitDefaults().
struct Candidate {
  std::string path;
  Owners owners;
};

/// Message about a number outside its range: "0.5 is not below 0.5 (note)"; "" for a number inside.
std::string outside(double value, const std::string& written, const Range& range) {
  if (range.contains(value)) return "";
  std::string text = written + " is not ";
  const bool tooLow = range.lowOpen ? value <= range.low : value < range.low;
  if (tooLow)
    text += (range.lowOpen ? "above " : "at least ") + realText(range.low);
  else
    text += (range.highOpen ? "below " : "at most ") + realText(range.high);
  if (std::isfinite(range.low) && std::isfinite(range.high)) text += ", it must lie " + range.text();
  return range.note.empty() ? text : text + " (" + range.note + ")";
}

/// The `type` attributes accepted for a kind: an int is accepted as a double, a scalar as an array of one entry, and a number as a text (an
/// expression may be a constant) unless the text is one of several names.
const std::vector<std::string>& typesFor(const Schema::Parameter& parameter) {
  static const std::vector<std::string> integer{"int"}, real{"double", "int"}, boolean{"bool"}, name{"string"},
      text{"string", "double", "int", "Array(double)", "Array(int)"}, word{"string", "double", "int"},
      reals{"Array(double)", "Array(int)", "double", "int"}, integers{"Array(int)", "int"},
      texts{"Array(string)", "string", "Array(double)", "Array(int)", "double", "int"};
  switch (parameter.kind) {
    case Kind::Integer:
      return integer;
    case Kind::Real:
      return real;
    case Kind::Boolean:
      return boolean;
    case Kind::Text:
      return parameter.numberToo ? word : parameter.allowed.empty() ? text : name;
    case Kind::Reals:
      return reals;
    case Kind::Integers:
      return integers;
    case Kind::Texts:
      return texts;
  }
  throw InternalError("a parameter without a kind");
}

class Resolver {
 public:
  explicit Resolver(Problems& problems) : problems_(problems) {}

  /// `demanded`: parameters without a default must be given; false inside a choice that is not taken. `owners`: choices that the list
  /// belongs to, taken or not.
  void list(const RawList& raw, const Schema& schema, const std::string& path, bool demanded, Parameters& resolved,
            const Owners& owners = {}) {
    refuseUnknown(raw, schema, path);
    for (const Schema::Parameter& parameter : schema.parameters()) {
      const std::string here = joinPath(path, parameter.name);
      if (raw.list(parameter.name)) {
        problems_.add(here, "is a parameter, not a list: expected " + expectation(parameter));
      } else if (const RawParameter* given = raw.parameter(parameter.name)) {
        value(*given, parameter, here, resolved);
        Owners own = owners;
        if (parameter.with) own.push_back({path, parameter.with->first, parameter.with->second});
        if (!own.empty() && !given->isAdded) remember(parameter, here, resolved, own);
      } else if (parameter.fallback) {
        store(*parameter.fallback, parameter.name, true, resolved);
        if (parameter.fitting) fitting_.push_back({path, &parameter});
      } else if (demanded && !parameter.optional &&
                 (!parameter.with || hasValue(*schema.find(parameter.with->first), parameter.with->second, raw))) {
        problems_.add(here, "is missing and has no default: " + parameter.doc + " (expected " + expectation(parameter) + ")");
      }
    }
    if (schema.userParameter()) userParameters(raw, schema, path, resolved);
    for (const auto& [name, inner] : schema.lists()) {
      const std::string here = joinPath(path, name);
      const RawList* given = raw.list(name);
      if (raw.parameter(name)) {
        problems_.add(here, "is a list of parameters, not a parameter");
      } else if (!given && schema.requiredList(name)) {
        // One message for the list, without further messages for its entries.
        if (demanded) problems_.add(here, "this list is missing: " + inner.doc());
        list(RawList(), inner, here, false, resolved.sublist(name));
      } else {
        const Schema::Parameter* choice = choiceOf(name, schema);
        Owners own = owners;
        if (choice) own.push_back({path, choice->name, name});
        list(given ? *given : RawList(), inner, here, demanded && (!choice || hasValue(*choice, name, raw)), resolved.sublist(name), own);
      }
    }
    if (schema.userLists()) userLists(raw, schema, path, demanded, resolved, owners);
  }

  /// Sets the defaults that depend on the rest of the scene, after everything else.
  void fitDefaults(Parameters& whole) const {
    for (const auto& [path, parameter] : fitting_) store(parameter->fitting(whole), parameter->name, true, listAt(whole, path));
  }

  /// Notes on parameters of choices that are not taken; call after fitDefaults().
  std::vector<std::string> unused(Parameters& whole) const {
    std::vector<std::string> notes;
    for (const auto& [path, owners] : candidates_)
      for (const Owner& owner : owners) {
        const Parameters& list = listAt(whole, owner.list);
        const std::string taken = list.isParameter(owner.choice) ? list.get<std::string>(owner.choice) : "";
        if (taken == owner.value) continue;
        notes.push_back(path + " has no effect: " + joinPath(owner.list, owner.choice) + " is '" + taken + "', not '" + owner.value + "'");
        break;
      }
    return notes;
  }

 private:
  static Parameters& listAt(Parameters& whole, const std::string& path) {
    Parameters* list = &whole;
    for (std::size_t begin = 0; begin < path.size();) {
      const std::size_t end = std::min(path.find('/', begin), path.size());
      list = &list->sublist(path.substr(begin, end - begin));
      begin = end + 1;
    }
    return *list;
  }

  /// The choice that has a list of this name, or null.
  static const Schema::Parameter* choiceOf(const std::string& name, const Schema& schema) {
    for (const Schema::Parameter& parameter : schema.parameters())
      if (parameter.choice && std::find(parameter.allowed.begin(), parameter.allowed.end(), name) != parameter.allowed.end())
        return &parameter;
    return nullptr;
  }

  /// Adds a candidate, except for a value equal to the default, which may come from --print-defaults.
  void remember(const Schema::Parameter& parameter, const std::string& path, const Parameters& resolved, const Owners& owners) {
    Parameters fallback;
    if (parameter.fallback) store(*parameter.fallback, parameter.name, true, fallback);
    const Teuchos::ParameterEntry* given = resolved.getEntryPtr(parameter.name);
    const Teuchos::ParameterEntry* usual = fallback.getEntryPtr(parameter.name);
    if (given && !(usual && given->getAny() == usual->getAny())) candidates_.push_back({path, owners});
  }

  /// True if `value` is the given value or, if none is given, the default.
  static bool hasValue(const Schema::Parameter& choice, const std::string& value, const RawList& raw) {
    if (const RawParameter* given = raw.parameter(choice.name)) return given->value == value;
    return choice.fallback && std::get<std::string>(*choice.fallback) == value;
  }

  void userParameters(const RawList& raw, const Schema& schema, const std::string& path, Parameters& resolved) {
    for (const RawParameter& given : raw.parameters) {
      if (!schema.find(given.name) && !schema.findList(given.name))
        value(given, *schema.userParameter(), joinPath(path, given.name), resolved);
    }
  }

  void userLists(const RawList& raw, const Schema& schema, const std::string& path, bool demanded, Parameters& resolved,
                 const Owners& owners) {
    int count = 0;
    for (const RawList& given : raw.lists) {
      if (schema.find(given.name) || schema.findList(given.name)) continue;
      ++count;
      list(given, *schema.userLists(), joinPath(path, given.name), demanded, resolved.sublist(given.name), owners);
    }
    if (demanded && count < schema.leastUserLists()) {
      problems_.add(path, "has " + std::to_string(count) + " lists <" + schema.userListPlaceholder() + ">, expected at least " +
                              std::to_string(schema.leastUserLists()) + ": " + schema.userLists()->doc());
    }
  }

  void refuseUnknown(const RawList& raw, const Schema& schema, const std::string& path) {
    std::vector<std::string> parameters, lists;
    for (const Schema::Parameter& parameter : schema.parameters()) parameters.push_back(parameter.name);
    for (const auto& entry : schema.lists()) lists.push_back(entry.first);
    for (const RawParameter& given : raw.parameters) {
      if (schema.find(given.name) || schema.findList(given.name) || schema.userParameter()) continue;
      std::string message = "no such parameter." + suggestion(given.name, parameters);
      const std::string home = homeOf(given.name, schema, "");
      if (!home.empty()) message += ". A parameter of this name exists in " + home;
      problems_.add(joinPath(path, given.name), message);
    }
    for (const RawList& given : raw.lists) {
      if (schema.find(given.name) || schema.findList(given.name) || schema.userLists()) continue;
      problems_.add(joinPath(path, given.name), "no such list." + suggestion(given.name, lists));
    }
  }

  /// List below this one that has a parameter of this name: a correct name at the wrong level is a common mistake.
  static std::string homeOf(const std::string& name, const Schema& schema, const std::string& path) {
    for (const auto& [inner, below] : schema.lists()) {
      const std::string here = joinPath(path, inner);
      if (below.find(name)) return here;
      const std::string deeper = homeOf(name, below, here);
      if (!deeper.empty()) return deeper;
    }
    return "";
  }

  void value(const RawParameter& given, const Schema::Parameter& parameter, const std::string& path, Parameters& resolved) {
    if (!given.hasValue || !typeFits(given, parameter, path)) return;
    switch (parameter.kind) {
      case Kind::Integer:
        if (const auto number = integer(given.value, parameter, path)) store(static_cast<long long>(*number), given.name, false, resolved);
        break;
      case Kind::Real:
        if (const auto number = real(given.value, parameter, path)) store(*number, given.name, false, resolved);
        break;
      case Kind::Boolean:
        boolean(given, parameter, path, resolved);
        break;
      case Kind::Text:
        text(given, parameter, path, resolved);
        break;
      case Kind::Reals:
        if (const auto all = entries<double>(given, parameter, path, &Resolver::real)) store(*all, given.name, false, resolved);
        break;
      case Kind::Integers:
        if (const auto all = entries<int>(given, parameter, path, &Resolver::integer)) store(*all, given.name, false, resolved);
        break;
      case Kind::Texts:
        if (parameter.orOne && trimmed(given.value).substr(0, 1) != "{")
          store(given.value, given.name, false, resolved);
        else if (const auto all = split(given, parameter, path))
          store(*all, given.name, false, resolved);
        break;
    }
  }

  /// Checks that the `type` attribute exists and suits the parameter and, if it is int, the value.
  bool typeFits(const RawParameter& given, const Schema::Parameter& parameter, const std::string& path) {
    if (given.type.empty()) return true;
    static const std::vector<std::string> known{"int", "double", "bool", "string", "Array(double)", "Array(int)", "Array(string)"};
    if (std::find(known.begin(), known.end(), given.type) == known.end()) {
      problems_.add(path, unknownName("type", given.type, known));
      return false;
    }
    const std::vector<std::string>& fitting = typesFor(parameter);
    if (std::find(fitting.begin(), fitting.end(), given.type) == fitting.end()) {
      problems_.add(
          path, "is of type " + given.type + " ('" + given.value + "'), expected type " + fitting.front() + ": " + expectation(parameter));
      return false;
    }
    const bool isText = parameter.kind == Kind::Text || parameter.kind == Kind::Texts;
    const bool isWhole = given.type == "int" || given.type == "Array(int)",
               isReal = given.type == "double" || given.type == "Array(double)";
    // Values stored as numbers are parsed later.
    if (!isWhole && !(isReal && isText)) return true;
    const auto all = parseEntries(given.value);
    const bool fits = all && std::all_of(all->begin(), all->end(), [&](const std::string& entry) {
                        return isWhole ? parseInteger(entry).has_value() : parseReal(entry).has_value();
                      });
    if (!fits) problems_.add(path, "'" + given.value + "' is not of its type " + given.type);
    return fits;
  }

  std::optional<int> integer(const std::string& written, const Schema::Parameter& parameter, const std::string& path) {
    const std::optional<int> number = parseInteger(written);
    if (!number) problems_.add(path, "'" + written + "' is not an integer: expected " + expectation(parameter));
    return number && inRange(*number, written, parameter, path) ? number : std::nullopt;
  }

  std::optional<double> real(const std::string& written, const Schema::Parameter& parameter, const std::string& path) {
    const std::optional<double> number = parseReal(written);
    if (!number) problems_.add(path, "'" + written + "' is not a (finite) number: expected " + expectation(parameter));
    return number && inRange(*number, written, parameter, path) ? number : std::nullopt;
  }

  bool inRange(double number, const std::string& written, const Schema::Parameter& parameter, const std::string& path) {
    const std::string wrong = outside(number, trimmed(written), parameter.range);
    if (!wrong.empty()) problems_.add(path, wrong);
    return wrong.empty();
  }

  std::optional<std::vector<std::string>> split(const RawParameter& given, const Schema::Parameter& parameter, const std::string& path) {
    auto all = parseEntries(given.value);
    if (!all) problems_.add(path, "'" + given.value + "' cannot be read: expected " + expectation(parameter));
    return all;
  }

  template <typename T>
  std::optional<std::vector<T>> entries(const RawParameter& given, const Schema::Parameter& parameter, const std::string& path,
                                        std::optional<T> (Resolver::*one)(const std::string&, const Schema::Parameter&,
                                                                          const std::string&)) {
    const auto written = split(given, parameter, path);
    if (!written) return std::nullopt;
    std::vector<T> all;
    for (const std::string& entry : *written) {
      if (const std::optional<T> number = (this->*one)(entry, parameter, path)) all.push_back(*number);
    }
    return all.size() == written->size() ? std::optional<std::vector<T>>(std::move(all)) : std::nullopt;
  }

  void boolean(const RawParameter& given, const Schema::Parameter& parameter, const std::string& path, Parameters& resolved) {
    const std::string written = trimmed(given.value);
    if (written == "true" || written == "false")
      store(written == "true", given.name, false, resolved);
    else
      problems_.add(path, "'" + given.value + "' is not a boolean: expected " + expectation(parameter));
  }

  void text(const RawParameter& given, const Schema::Parameter& parameter, const std::string& path, Parameters& resolved) {
    const std::vector<std::string>& names = parameter.numberToo ? parameter.words : parameter.allowed;
    const bool known = std::find(names.begin(), names.end(), given.value) != names.end();
    if (parameter.numberToo && !known) {
      if (const std::optional<double> number = parseReal(given.value)) {
        if (!inRange(*number, given.value, parameter, path)) return;
        store(trimmed(given.value), given.name, false, resolved);
        return;
      }
      problems_.add(path, "'" + given.value + "' is neither a known word nor a number: expected " + expectation(parameter) +
                              didYouMean(given.value, names));
      return;
    }
    if (!known && !names.empty()) {
      problems_.add(path, "no such name '" + given.value + "'." + suggestion(given.value, names));
      return;
    }
    store(given.value, given.name, false, resolved);
  }

  static std::string didYouMean(const std::string& name, const std::vector<std::string>& names) {
    const std::string nearest = nearestName(name, names);
    return nearest.empty() ? "" : ". Did you mean '" + nearest + "'?";
  }

  static void store(const Schema::Value& value, const std::string& name, bool isDefault, Parameters& resolved) {
    std::visit(
        [&](const auto& held) {
          using T = std::decay_t<decltype(held)>;
          if constexpr (std::is_same_v<T, long long>)
            resolved.setEntry(name, Teuchos::ParameterEntry(static_cast<int>(held), isDefault));
          else if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, std::vector<int>> ||
                             std::is_same_v<T, std::vector<std::string>>)
            resolved.setEntry(name, Teuchos::ParameterEntry(Teuchos::Array<typename T::value_type>(held), isDefault));
          else
            resolved.setEntry(name, Teuchos::ParameterEntry(held, isDefault));
        },
        value);
  }

  Problems& problems_;
  std::vector<std::pair<std::string, const Schema::Parameter*>> fitting_;  // path of the list; parameter whose default depends on the scene
  std::vector<Candidate> candidates_;
};

}  // namespace

std::vector<std::string> resolve(const RawList& tree, const Schema& schema, Parameters& resolved, Problems& problems) {
  Resolver resolver(problems);
  resolver.list(tree, schema, "", true, resolved);
  if (!problems.empty()) return {};
  resolver.fitDefaults(resolved);
  return resolver.unused(resolved);
}

}  // namespace suture
