#include "Formula.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>

namespace suture::study {

using Json = nlohmann::ordered_json;

struct Formula::Node {
  enum class Kind { Number, Path, Operation, Function } kind = Kind::Number;
  double number = 0.0;
  std::string name;  // the path, the operator's sign, or the function's name
  std::vector<std::shared_ptr<const Node>> arguments;
};

namespace {

using Node = Formula::Node;
using NodePtr = std::shared_ptr<const Node>;

NodePtr makeNode(Node::Kind kind, const std::string& name, std::vector<NodePtr> arguments) {
  return std::make_shared<Node>(Node{kind, 0.0, name, std::move(arguments)});
}

// One token after the other: "(", ")", ",", an operator with its blanks, or what stands between them.
class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  NodePtr all() {
    const NodePtr root = sum();
    if (at_ < text_.size()) fail("an operator or the end");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw InputError("",
                     "'" + text_ + "': expected " + expected + (at_ < text_.size() ? " at '" + text_.substr(at_) + "'" : " at the end"));
  }

  void skipBlanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  bool take(char wanted) {
    skipBlanks();
    if (at_ >= text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  // A sign is an operator only with a blank after it and after what stands before it; otherwise it belongs to a name or a number.
  bool isOperator(std::size_t at) const {
    return std::string("+-*/").find(text_[at]) != std::string::npos && at > 0 && (text_[at - 1] == ' ' || text_[at - 1] == ')') &&
           (at + 1 == text_.size() || text_[at + 1] == ' ' || text_[at + 1] == '(');
  }

  std::optional<char> takeOperator(const std::string& signs) {
    skipBlanks();
    if (at_ >= text_.size() || !isOperator(at_) || signs.find(text_[at_]) == std::string::npos) return std::nullopt;
    return text_[at_++];
  }

  NodePtr sum() {
    return chain("+-", [this] { return product(); });
  }
  NodePtr product() {
    return chain("*/", [this] { return factor(); });
  }

  template <typename Next>
  NodePtr chain(const std::string& signs, const Next& next) {
    NodePtr left = next();
    while (const auto sign = takeOperator(signs)) left = makeNode(Node::Kind::Operation, std::string(1, *sign), {left, next()});
    return left;
  }

  NodePtr factor() {
    if (take('(')) {
      const NodePtr inner = sum();
      if (!take(')')) fail("')'");
      return inner;
    }
    skipBlanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::string("(),").find(text_[at_]) == std::string::npos && !isOperator(at_)) ++at_;
    const std::string word = trimmed(text_.substr(begin, at_ - begin));
    if (word.empty()) fail("a number, a figure or '('");
    if (take('(')) return function(word);
    if (const auto number = parseReal(word)) return std::make_shared<Node>(Node{Node::Kind::Number, *number, "", {}});
    return makeNode(Node::Kind::Path, word, {});
  }

  NodePtr function(const std::string& name) {
    static const std::vector<std::string> known{"abs", "max", "norm", "sqrt"};
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError("", "'" + text_ + "': " + unknownName("function", name, known));
    std::vector<NodePtr> arguments{sum()};
    while (take(',')) arguments.push_back(sum());
    if (!take(')')) fail("')'");
    if (name != "max" && arguments.size() != 1) throw InputError("", "'" + text_ + "': " + name + " has one argument");
    if (name == "norm" && arguments[0]->kind != Node::Kind::Path)
      throw InputError("", "'" + text_ + "': the argument of norm is the path of a vector");
    return makeNode(Node::Kind::Function, name, arguments);
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

void collect(const Node& node, std::vector<std::string>& paths) {
  if (node.kind == Node::Kind::Path) paths.push_back(node.name);
  for (const NodePtr& argument : node.arguments) collect(*argument, paths);
}

NodePtr replaced(const NodePtr& node, const std::string& path, const NodePtr& by) {
  if (node->kind == Node::Kind::Path) return node->name == path ? by : node;
  Node copy = *node;
  for (NodePtr& argument : copy.arguments) argument = replaced(argument, path, by);
  return std::make_shared<Node>(copy);
}

TableCell finite(double value, bool integer) {
  if (!std::isfinite(value)) return {};
  return {integer ? TableCell::Kind::Integer : TableCell::Kind::Real, value, ""};
}

TableCell entryCell(const Json* entry) {
  if (!entry) return {};
  if (entry->is_number()) return finite(entry->get<double>(), entry->is_number_integer());
  if (entry->is_boolean()) return {TableCell::Kind::Text, 0.0, entry->get<bool>() ? "true" : "false"};
  if (entry->is_string()) return {TableCell::Kind::Text, 0.0, entry->get<std::string>()};
  return {};
}

TableCell norm(const Json* vector) {
  if (!vector || !vector->is_array()) return {};
  double squares = 0.0;
  for (const Json& component : *vector) squares += component.is_number() ? std::pow(component.get<double>(), 2) : std::nan("");
  return finite(std::sqrt(squares), false);
}

TableCell operation(char sign, const TableCell& a, const TableCell& b) {
  const bool integer = a.kind == TableCell::Kind::Integer && b.kind == TableCell::Kind::Integer;
  switch (sign) {
    case '+':
      return finite(a.number + b.number, integer);
    case '-':
      return finite(a.number - b.number, integer);
    case '*':
      return finite(a.number * b.number, integer);
    default:
      return finite(a.number / b.number, false);
  }
}

TableCell value(const Node& node, const Json& summary) {
  if (node.kind == Node::Kind::Path) return entryCell(findEntry(summary, node.name));
  if (node.kind == Node::Kind::Number) return finite(node.number, node.number == std::floor(node.number));
  if (node.name == "norm") return norm(findEntry(summary, node.arguments[0]->name));
  std::vector<TableCell> arguments;
  for (const NodePtr& argument : node.arguments) {
    arguments.push_back(value(*argument, summary));
    if (!arguments.back().isNumber()) return {};
  }
  if (node.kind == Node::Kind::Operation) return operation(node.name[0], arguments[0], arguments[1]);
  TableCell result = arguments[0];
  if (node.name == "abs") result.number = std::abs(result.number);
  if (node.name == "sqrt") {
    result.kind = TableCell::Kind::Real;
    result.number = std::sqrt(result.number);
  }
  for (const TableCell& other : arguments)
    if (node.name == "max" && other.number > result.number) result = other;
  return result;
}

}  // namespace

const Json* findEntry(const Json& summary, const std::string& path) {
  const Json* at = &summary;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const std::string name = path.substr(begin, end - begin);
    begin = end + 1;
    if (at->is_array()) {
      const auto index = parseInteger(name);
      if (!index || *index < 0 || std::size_t(*index) >= at->size()) return nullptr;
      at = &(*at)[std::size_t(*index)];
    } else {
      if (!at->is_object() || !at->contains(name)) return nullptr;
      at = &(*at)[name];
    }
  }
  return at;
}

Formula::Formula(const std::string& text) : root_(Parser(text).all()) {}

std::vector<std::string> Formula::paths() const {
  std::vector<std::string> all;
  collect(*root_, all);
  return all;
}

void Formula::substitute(const std::string& path, const Formula& meaning) { root_ = replaced(root_, path, meaning.root_); }

TableCell Formula::evaluate(const Json& summary) const { return value(*root_, summary); }

}  // namespace suture::study
