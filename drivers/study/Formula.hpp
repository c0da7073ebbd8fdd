#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace suture::study {

/// A cell of a study's table: a number, a text, or empty (the run ended before it had the figure).
struct TableCell {
  enum class Kind { Empty, Integer, Real, Text } kind = Kind::Empty;
  double number = 0.0;  ///< value of Integer and Real
  std::string text;     ///< value of Text
  bool isNumber() const { return kind == Kind::Integer || kind == Kind::Real; }
};

/// A formula over the figures of summary.json: numbers, paths with dots ("outer.pcg_total"), the operators + - * / (a minus after a name
/// needs a blank on both sides, since names may contain hyphens and blanks), parentheses, norm(path of a vector), sum(list.key) and
/// count(list) over a list such as "accuracy.levels", and the functions of base/Expression, which evaluates it: abs(x), max(x, y, ...), ...
class Formula {
 public:
  /// \throws InputError  describes what was expected and where; the path of the problem is empty. Local.
  explicit Formula(const std::string& text);

  /// All paths in it, except those of lists, in the order of the text.
  std::vector<std::string> paths() const;
  /// Paths in sum(): a list and a key of its entries, "accuracy.levels.unknowns".
  std::vector<std::string> sums() const { return pathsOf(Piece::Kind::Sum); }
  /// Paths of lists in count(), "accuracy.levels".
  std::vector<std::string> counts() const { return pathsOf(Piece::Kind::Count); }
  /// Replaces a path by a formula wherever it occurs, except in norm(), sum() and count().
  void substitute(const std::string& path, const Formula& meaning);
  /// Empty if a figure is missing or not finite. A single path may also give a text or true/false. The result is an integer if all operands
  /// are integers and there is no quotient. Local.
  TableCell evaluate(const nlohmann::ordered_json& summary) const;

 private:
  /// A part of the formula: plain text, or a figure to be replaced by its value.
  struct Piece {
    enum class Kind { Plain, Figure, Norm, Sum, Count } kind = Kind::Plain;
    std::string text;
  };
  std::vector<std::string> pathsOf(Piece::Kind kind) const;
  static TableCell valueOf(const Piece& piece, const nlohmann::ordered_json& summary);
  std::vector<Piece> pieces_;
  bool integer_ = true;  // false: fractions may result even from integer figures
};

/// The entry of a path, or nullptr. Names that contain dots cannot be addressed. Local.
const nlohmann::ordered_json* findEntry(const nlohmann::ordered_json& summary, const std::string& path);

}  // namespace suture::study
