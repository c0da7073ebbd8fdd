#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace suture {

class SceneCompletion;

/// Allowed interval of a number; an open end excludes its value.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowOpen = false;
  bool highOpen = false;
  std::string note;  ///< appended to the error, e.g. "an incompressible body needs a mixed element"

  static Range any() { return {}; }
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false, {}}; }
  static Range atLeast(double low) { return {low, std::numeric_limits<double>::infinity(), false, false, {}}; }
  bool contains(double x) const { return (lowOpen ? x > low : x >= low) && (highOpen ? x < high : x <= high); }
  std::string text() const;  ///< "> 0", "in [0, 0.5)"
};

/// Description of a parameter list, from which the strict reader, the documentation (suture_schema), the defaults and the messages all
/// follow. A class that takes parameters has `static Schema schema()`; a package composes those of its classes.
///
/// Built by chaining:  Schema("what this list is").real("Tolerance", 1e-8, "...", Range::positive()).list("Amesos2", ...);
class Schema {
 public:
  enum class Kind { Integer, Real, Boolean, Text, Reals, Integers, Texts };
  using Value = std::variant<long long, double, bool, std::string, std::vector<double>, std::vector<int>, std::vector<std::string>>;

  struct Parameter {
    std::string name;
    Kind kind = Kind::Text;
    std::optional<Value> fallback;  ///< the default; without one the parameter is required (or optional, below)
    bool optional = false;          ///< may be absent, without a default
    std::string doc;
    std::string unit;                  ///< "length", "stress", "" for none
    Range range;                       ///< range of a number, and of each entry of Reals / Integers
    std::vector<std::string> allowed;  ///< names that a Text may have; empty means any
    std::vector<std::string> allowedDocs;
    std::vector<std::string> words;  ///< Text that may also be a number in `range` ("None | Automatic | value"): the words
    bool numberToo = false;
    bool orOne = false;                                           ///< Texts that may be one text, see Schema::orOne
    bool choice = false;                                          ///< Text whose allowed names each have a sublist, see Schema::choice
    std::optional<std::pair<std::string, std::string>> with;      ///< used only with this value of that choice in the same list
    std::function<std::string(const Parameters& whole)> fitting;  ///< derives the default of a Text from the scene; see fittingDefault()
  };

  explicit Schema(std::string doc = "") : doc_(std::move(doc)) {}

  Schema& integer(const std::string& name, std::optional<int> fallback, const std::string& doc, Range range = Range::any());
  Schema& real(const std::string& name, std::optional<double> fallback, const std::string& doc, Range range = Range::any(),
               const std::string& unit = "");
  Schema& boolean(const std::string& name, std::optional<bool> fallback, const std::string& doc);
  Schema& text(const std::string& name, std::optional<std::string> fallback, const std::string& doc);
  Schema& oneOf(const std::string& name, std::optional<std::string> fallback, const std::vector<std::string>& allowed,
                const std::string& doc);
  /// One of `words`, or a number in `range`; stored as text.
  Schema& wordOrNumber(const std::string& name, const std::string& fallback, const std::vector<std::string>& words, Range range,
                       const std::string& doc);
  Schema& reals(const std::string& name, std::optional<std::vector<double>> fallback, const std::string& doc, const std::string& unit = "",
                Range range = Range::any());
  Schema& integers(const std::string& name, std::optional<std::vector<int>> fallback, const std::string& doc, Range range = Range::any());
  Schema& texts(const std::string& name, std::optional<std::vector<std::string>> fallback, const std::string& doc);
  /// The parameter added last, Texts, may also be a single text without braces, which is not parsed and keeps the type string.
  Schema& orOne();
  /// The parameter added last may be absent (has no default, is not required).
  Schema& optional();
  /// The parameter added last, a Text with a default, takes its value from `find` if the scene does not give one. `find` gets the whole
  /// scene, resolved with the default; it is not called for a scene with problems.
  Schema& fittingDefault(std::function<std::string(const Parameters& whole)> find);

  /// A sublist with a fixed name. A required one must be present in the scene; the others are filled with defaults.
  /// \throws InternalError  if a parameter or list of this name exists (as all functions here that add a name).
  Schema& list(const std::string& name, Schema schema, bool required = false);
  /// Sublists that the user names, all of the same form ("Bodies/<name>"), at least `least` of them.
  Schema& each(const std::string& placeholder, Schema schema, int least = 0);
  /// Parameters that the user names, all real ("Mesh/Constants/<name>").
  Schema& eachReal(const std::string& placeholder, const std::string& doc);
  /// The same, all texts ("Functions/<name>").
  Schema& eachText(const std::string& placeholder, const std::string& doc);

  /// `Type` plus a sublist of the same name with that choice's own parameters. Sublists of choices not taken are checked, too. A parameter
  /// without a default in a choice's list is required only if that choice is taken.
  /// \param fallback  the default; "" makes the parameter required
  /// \param names  choice -> its schema (documentation in its doc)
  /// \param beside  a choice whose parameters are in this list, next to `parameter`, instead of in a sublist; they, too, are checked
  /// but not
  ///                used if another choice is taken
  /// \param bare  choices without parameters that have no sublist
  Schema& choice(const std::string& parameter, const std::string& fallback, const std::map<std::string, Schema>& names,
                 const std::string& doc, const std::string& beside = "", const std::vector<std::string>& bare = {});

  /// Entries from other files complete a scene of this schema before it is checked. Only for the schema of a whole file.
  Schema& completedBy(std::shared_ptr<const SceneCompletion> completion);

  const std::string& doc() const { return doc_; }
  /// Or null.
  const SceneCompletion* completion() const { return completion_.get(); }
  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::vector<std::pair<std::string, Schema>>& lists() const { return lists_; }
  bool requiredList(const std::string& name) const;
  const Schema* userLists() const { return userLists_.get(); }
  const std::string& userListPlaceholder() const { return userListPlaceholder_; }
  int leastUserLists() const { return leastUserLists_; }
  /// Parameter whose name the user chooses, with a placeholder as its name; or null.
  const Parameter* userParameter() const { return userParameter_ ? &*userParameter_ : nullptr; }
  /// Parameter or null.
  const Parameter* find(const std::string& name) const;
  const Schema* findList(const std::string& name) const;

 private:
  Parameter& add(const std::string& name, Kind kind, const std::string& doc);
  void claim(const std::string& name) const;

  std::string doc_;
  std::vector<Parameter> parameters_;
  std::vector<std::pair<std::string, Schema>> lists_;
  std::vector<std::string> requiredLists_;
  std::shared_ptr<const Schema> userLists_;
  std::string userListPlaceholder_;
  int leastUserLists_ = 0;
  std::optional<Parameter> userParameter_;
  std::shared_ptr<const SceneCompletion> completion_;
};

/// "int", "double", "bool", "string", "Array(double)", ...: the `type` attribute of a parameter of this kind.
std::string typeName(Schema::Kind kind);

/// A default as it is written in the value attribute: "1e-08", "{1, 0}", "true". Numbers are the shortest text that reads back exactly.
std::string valueText(const Schema::Value& value);

}  // namespace suture
