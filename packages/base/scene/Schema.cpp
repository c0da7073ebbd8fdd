#include "Schema.hpp"

#include <algorithm>
#include <cmath>

#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>

namespace suture {
namespace {

template <typename T>
std::string braced(const std::vector<T>& values) {
  std::string all = "{";
  for (std::size_t i = 0; i < values.size(); ++i) {
    all += i > 0 ? ", " : "";
    if constexpr (std::is_same_v<T, std::string>)
      all += values[i];
    else if constexpr (std::is_same_v<T, double>)
      all += realText(values[i]);
    else
      all += std::to_string(values[i]);
  }
  return all + "}";
}

}  // namespace

std::string Range::text() const {
  const bool below = std::isfinite(low), above = std::isfinite(high);
  if (!below && !above) return "any";
  if (!above) return (lowOpen ? "> " : ">= ") + realText(low);
  if (!below) return (highOpen ? "< " : "<= ") + realText(high);
  return std::string("in ") + (lowOpen ? "(" : "[") + realText(low) + ", " + realText(high) + (highOpen ? ")" : "]");
}

std::string typeName(Schema::Kind kind) {
  switch (kind) {
    case Schema::Kind::Integer:
      return "int";
    case Schema::Kind::Real:
      return "double";
    case Schema::Kind::Boolean:
      return "bool";
    case Schema::Kind::Text:
      return "string";
    case Schema::Kind::Reals:
      return "Array(double)";
    case Schema::Kind::Integers:
      return "Array(int)";
    case Schema::Kind::Texts:
      return "Array(string)";
  }
  throw InternalError("a parameter without a kind");
}

std::string valueText(const Schema::Value& value) {
  return std::visit(
      [](const auto& held) -> std::string {
        using T = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<T, std::string>)
          return held;
        else if constexpr (std::is_same_v<T, bool>)
          return held ? "true" : "false";
        else if constexpr (std::is_same_v<T, double>)
          return realText(held);
        else if constexpr (std::is_same_v<T, long long>)
          return std::to_string(held);
        else
          return braced(held);
      },
      value);
}

void Schema::claim(const std::string& name) const {
  if (find(name) || findList(name)) throw InternalError("a schema (" + doc_ + ") has two entries named '" + name + "'");
  if (name.empty() || name.find('/') != std::string::npos || name.find('=') != std::string::npos || name.find("->") != std::string::npos)
    throw InternalError("'" + name + "' is not a valid parameter name: a path cannot address it");
}

Schema::Parameter& Schema::add(const std::string& name, Kind kind, const std::string& doc) {
  claim(name);
  Parameter parameter;
  parameter.name = name;
  parameter.kind = kind;
  parameter.doc = doc;
  parameters_.push_back(parameter);
  return parameters_.back();
}

Schema& Schema::integer(const std::string& name, std::optional<int> fallback, const std::string& doc, Range range) {
  Parameter& added = add(name, Kind::Integer, doc);
  if (fallback) added.fallback = static_cast<long long>(*fallback);
  added.range = range;
  return *this;
}

Schema& Schema::real(const std::string& name, std::optional<double> fallback, const std::string& doc, Range range,
                     const std::string& unit) {
  Parameter& added = add(name, Kind::Real, doc);
  if (fallback) added.fallback = *fallback;
  added.range = range;
  added.unit = unit;
  return *this;
}

Schema& Schema::boolean(const std::string& name, std::optional<bool> fallback, const std::string& doc) {
  Parameter& added = add(name, Kind::Boolean, doc);
  if (fallback) added.fallback = *fallback;
  return *this;
}

Schema& Schema::text(const std::string& name, std::optional<std::string> fallback, const std::string& doc) {
  Parameter& added = add(name, Kind::Text, doc);
  if (fallback) added.fallback = *fallback;
  return *this;
}

Schema& Schema::oneOf(const std::string& name, std::optional<std::string> fallback, const std::vector<std::string>& allowed,
                      const std::string& doc) {
  text(name, fallback, doc);
  parameters_.back().allowed = allowed;
  if (fallback && std::find(allowed.begin(), allowed.end(), *fallback) == allowed.end())
    throw InternalError("the default '" + *fallback + "' of '" + name + "' is not one of its names: " + joinNames(allowed));
  return *this;
}

Schema& Schema::wordOrNumber(const std::string& name, const std::string& fallback, const std::vector<std::string>& words, Range range,
                             const std::string& doc) {
  text(name, fallback, doc);
  parameters_.back().words = words;
  parameters_.back().numberToo = true;
  parameters_.back().range = range;
  return *this;
}

Schema& Schema::reals(const std::string& name, std::optional<std::vector<double>> fallback, const std::string& doc, const std::string& unit,
                      Range range) {
  Parameter& added = add(name, Kind::Reals, doc);
  if (fallback) added.fallback = *fallback;
  added.unit = unit;
  added.range = range;
  return *this;
}

Schema& Schema::integers(const std::string& name, std::optional<std::vector<int>> fallback, const std::string& doc, Range range) {
  Parameter& added = add(name, Kind::Integers, doc);
  if (fallback) added.fallback = *fallback;
  added.range = range;
  return *this;
}

Schema& Schema::texts(const std::string& name, std::optional<std::vector<std::string>> fallback, const std::string& doc) {
  Parameter& added = add(name, Kind::Texts, doc);
  if (fallback) added.fallback = *fallback;
  return *this;
}

Schema& Schema::completedBy(std::shared_ptr<const SceneCompletion> completion) {
  completion_ = std::move(completion);
  return *this;
}

Schema& Schema::orOne() {
  if (parameters_.empty() || parameters_.back().kind != Kind::Texts) throw InternalError("Schema::orOne() must follow texts()");
  parameters_.back().orOne = true;
  return *this;
}

Schema& Schema::optional() {
  if (parameters_.empty()) throw InternalError("Schema::optional() before any parameter");
  parameters_.back().optional = true;
  parameters_.back().fallback.reset();
  return *this;
}

Schema& Schema::fittingDefault(std::function<std::string(const Parameters& whole)> find) {
  if (parameters_.empty() || parameters_.back().kind != Kind::Text || !parameters_.back().fallback)
    throw InternalError("Schema::fittingDefault() must follow a text with a default");
  parameters_.back().fitting = std::move(find);
  return *this;
}

Schema& Schema::list(const std::string& name, Schema schema, bool required) {
  claim(name);
  lists_.emplace_back(name, std::move(schema));
  if (required) requiredLists_.push_back(name);
  return *this;
}

Schema& Schema::each(const std::string& placeholder, Schema schema, int least) {
  userLists_ = std::make_shared<const Schema>(std::move(schema));
  userListPlaceholder_ = placeholder;
  leastUserLists_ = least;
  return *this;
}

Schema& Schema::eachReal(const std::string& placeholder, const std::string& doc) {
  Parameter parameter;
  parameter.name = placeholder;
  parameter.kind = Kind::Real;
  parameter.doc = doc;
  userParameter_ = std::move(parameter);
  return *this;
}

Schema& Schema::eachText(const std::string& placeholder, const std::string& doc) {
  eachReal(placeholder, doc);
  userParameter_->kind = Kind::Text;
  return *this;
}

Schema& Schema::choice(const std::string& parameter, const std::string& fallback, const std::map<std::string, Schema>& names,
                       const std::string& doc, const std::string& beside, const std::vector<std::string>& bare) {
  std::vector<std::string> allowed, docs;
  for (const auto& [name, schema] : names) {
    allowed.push_back(name);
    docs.push_back(schema.doc());
  }
  oneOf(parameter, fallback.empty() ? std::nullopt : std::optional<std::string>(fallback), allowed, doc);
  parameters_.back().allowedDocs = docs;
  parameters_.back().choice = true;
  for (const auto& [name, schema] : names)
    if (name != beside && std::find(bare.begin(), bare.end(), name) == bare.end()) list(name, schema);
  if (const auto found = names.find(beside); found != names.end())
    for (const Parameter& own : found->second.parameters()) {
      claim(own.name);
      parameters_.push_back(own);
      parameters_.back().with = {parameter, beside};
    }
  return *this;
}

bool Schema::requiredList(const std::string& name) const {
  return std::find(requiredLists_.begin(), requiredLists_.end(), name) != requiredLists_.end();
}

const Schema::Parameter* Schema::find(const std::string& name) const {
  for (const Parameter& parameter : parameters_) {
    if (parameter.name == name) return &parameter;
  }
  return nullptr;
}

const Schema* Schema::findList(const std::string& name) const {
  for (const auto& [known, schema] : lists_) {
    if (known == name) return &schema;
  }
  return nullptr;
}

}  // namespace suture
