#include "Formula.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/Numbers.hpp>

namespace suture::study {

using Json = nlohmann::ordered_json;

namespace {

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

// The sum of the values of a key in all entries of a list; empty if an entry has no number.
TableCell sum(const Json& summary, const std::string& path) {
  const std::size_t dot = path.rfind('.');
  const Json* list = dot == std::string::npos ? nullptr : findEntry(summary, path.substr(0, dot));
  if (!list || !list->is_array()) return {};
  const std::string key = path.substr(dot + 1);
  double total = 0.0;
  bool integer = true;
  for (const Json& entry : *list) {
    const TableCell cell = entry.is_object() && entry.contains(key) ? entryCell(&entry[key]) : TableCell{};
    if (!cell.isNumber()) return {};
    total += cell.number;
    integer = integer && cell.kind == TableCell::Kind::Integer;
  }
  return finite(total, integer);
}

TableCell count(const Json* list) { return list && list->is_array() ? finite(static_cast<double>(list->size()), true) : TableCell{}; }

// True for a sign between two operands. Names contain no * or /. A + or - may belong to a number (1e-5, -1), and a - to a name
// (left-side): a minus after a name is an operator if it has a blank or a parenthesis on both sides. `word`: the text between the last mark
// and the sign.
bool isOperator(const std::string& text, std::size_t at, const std::string& word) {
  const char sign = text[at];
  if (sign == '*' || sign == '/') return true;
  if (sign != '+' && sign != '-') return false;
  const std::size_t before = at == 0 ? std::string::npos : text.find_last_not_of(' ', at - 1);
  if (before != std::string::npos && text[before] == ')') return true;
  if (trimmed(word).empty()) return false;  // the sign of a number
  if (parseReal(word)) return true;
  const bool isExponent = std::tolower(word.back()) == 'e' && parseReal(word.substr(0, word.size() - 1)).has_value();
  if (sign == '+') return !isExponent;
  const char next = at + 1 < text.size() ? text[at + 1] : ' ';
  return next == '(' || (word.back() == ' ' && next == ' ');
}

bool isMark(const std::string& text, std::size_t at, const std::string& word) {
  return std::string("(),").find(text[at]) != std::string::npos || isOperator(text, at, word);
}

// Name of a figure in the text given to Expression.
std::string standIn(std::size_t piece) { return "figure_" + std::to_string(piece); }

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

Formula::Formula(const std::string& text) {
  const auto wrong = [&text](const std::string& what) -> InputError { return InputError("", "'" + text + "': " + what); };
  std::vector<std::string> functions = Expression::functions();
  const std::map<std::string, Piece::Kind> ofPaths{{"norm", Piece::Kind::Norm}, {"sum", Piece::Kind::Sum}, {"count", Piece::Kind::Count}};
  for (const auto& [name, kind] : ofPaths) functions.push_back(name);
  std::string inside;         // the function of a path that has just begun
  int open = 0;               // parentheses
  bool isBehindWord = false;  // a word has just ended
  for (std::size_t at = 0; at < text.size();) {
    if (isBehindWord || isMark(text, at, "")) {
      isBehindWord = false;
      integer_ = integer_ && text[at] != '/';
      if (text[at] != '(') inside.clear();
      open += text[at] == '(' ? 1 : text[at] == ')' ? -1 : 0;
      if (open < 0) throw wrong("unexpected ')' at '" + text.substr(at) + "'");
      pieces_.push_back({Piece::Kind::Plain, std::string(1, text[at++])});
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && !isMark(text, end, text.substr(at, end - at))) ++end;
    const std::string word = trimmed(text.substr(at, end - at));
    at = end;
    isBehindWord = true;
    if (word.empty()) continue;
    if (at < text.size() && text[at] == '(') {
      if (std::find(functions.begin(), functions.end(), word) == functions.end()) throw wrong(unknownName("function", word, functions));
      inside = ofPaths.count(word) > 0 ? word : "";
      if (inside.empty()) pieces_.push_back({Piece::Kind::Plain, word});
      integer_ = integer_ && (word == "abs" || word == "max" || word == "min" || word == "sum" || word == "count");
    } else if (const auto number = parseReal(word)) {
      pieces_.push_back({Piece::Kind::Plain, "(" + word + ")"});
      integer_ = integer_ && *number == std::floor(*number);
    } else {
      const bool alone = !inside.empty() && at < text.size() && text[at] == ')';
      pieces_.push_back({alone ? ofPaths.at(inside) : Piece::Kind::Figure, word});
      if (alone) inside.clear();
    }
    if (!inside.empty() && (at >= text.size() || text[at] != '('))
      throw wrong("the argument of " + inside + " is the path of a " +
                  (inside == "norm"  ? "vector"
                   : inside == "sum" ? "list and a key"
                                     : "list"));
  }
  if (open > 0) throw wrong("expected ')' at the end");
  // Parse once with numbers in place of the figures to find syntax errors.
  Constants ones;
  std::string form;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].kind != Piece::Kind::Plain) ones.numbers[standIn(i)] = 1.0;
    form += pieces_[i].kind == Piece::Kind::Plain ? pieces_[i].text : standIn(i);
  }
  try {
    Expression(form, ones);
  } catch (const InputError&) {
    throw wrong(
        "is not a formula; expected numbers and figures of summary.json with + - * /, as in 2*outer.pcg_total + 1 (a minus after a name "
        "needs "
        "a blank on both sides)");
  }
}

std::vector<std::string> Formula::paths() const {
  std::vector<std::string> all;
  for (const Piece& piece : pieces_)
    if (piece.kind == Piece::Kind::Figure || piece.kind == Piece::Kind::Norm) all.push_back(piece.text);
  return all;
}

std::vector<std::string> Formula::pathsOf(Piece::Kind kind) const {
  std::vector<std::string> all;
  for (const Piece& piece : pieces_)
    if (piece.kind == kind) all.push_back(piece.text);
  return all;
}

void Formula::substitute(const std::string& path, const Formula& meaning) {
  std::vector<Piece> replaced;
  for (const Piece& piece : pieces_) {
    if (piece.kind != Piece::Kind::Figure || piece.text != path) {
      replaced.push_back(piece);
      continue;
    }
    integer_ = integer_ && meaning.integer_;
    if (pieces_.size() == 1) {  // a text stays a text
      replaced = meaning.pieces_;
      break;
    }
    replaced.push_back({Piece::Kind::Plain, "("});
    replaced.insert(replaced.end(), meaning.pieces_.begin(), meaning.pieces_.end());
    replaced.push_back({Piece::Kind::Plain, ")"});
  }
  pieces_ = std::move(replaced);
}

TableCell Formula::valueOf(const Piece& piece, const Json& summary) {
  if (piece.kind == Piece::Kind::Sum) return sum(summary, piece.text);
  const Json* entry = findEntry(summary, piece.text);
  return piece.kind == Piece::Kind::Norm ? norm(entry) : piece.kind == Piece::Kind::Count ? count(entry) : entryCell(entry);
}

TableCell Formula::evaluate(const Json& summary) const {
  if (pieces_.size() == 1 && pieces_[0].kind == Piece::Kind::Figure) return entryCell(findEntry(summary, pieces_[0].text));
  Constants figures;
  std::string form;
  bool integer = integer_;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].kind == Piece::Kind::Plain) {
      form += pieces_[i].text;
      continue;
    }
    const TableCell cell = valueOf(pieces_[i], summary);
    if (!cell.isNumber()) return {};
    integer = integer && cell.kind == TableCell::Kind::Integer;
    figures.numbers[standIn(i)] = cell.number;
    form += standIn(i);
  }
  try {
    return finite(Expression(form, figures).at({0, 0, 0}), integer);
  } catch (const InputError&) {  // not finite
    return {};
  }
}

}  // namespace suture::study
