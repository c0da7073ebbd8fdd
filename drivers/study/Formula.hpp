#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace suture::study {

/// A cell of a study's table: a number, a text, or nothing (a run that ended before it had the figure).
struct TableCell {
  enum class Kind { Empty, Integer, Real, Text } kind = Kind::Empty;
  double number = 0.0;  ///< of Integer and Real
  std::string text;     ///< of Text
  bool isNumber() const { return kind == Kind::Integer || kind == Kind::Real; }
};

/// A formula over the figures of summary.json: numbers, paths with dots ("outer.pcg_total"), the operators + - * / (a minus behind a name
/// has a blank on both sides, since names may contain hyphens and blanks), parentheses, norm(path of a vector), and the functions of
/// base/Expression, which calculates: abs(x), max(x, y, ...), sqrt(x), ...
class Formula {
 public:
  /// \throws InputError  says what was expected where; the path of the problem is empty. Local.
  explicit Formula(const std::string& text);

  /// All paths in it, in the order of the text.
  std::vector<std::string> paths() const;
  /// Replaces a path by a formula wherever it stands, but for a vector of norm().
  void substitute(const std::string& path, const Formula& meaning);
  /// Empty where a figure is missing or not finite. A single path may also have a text or true/false as its value. An integer if all that
  /// it is made of are integers, without a quotient. Local.
  TableCell evaluate(const nlohmann::ordered_json& summary) const;

 private:
  /// A part of the text: as it stands, or a figure that a value stands for.
  struct Piece {
    enum class Kind { Plain, Figure, Norm } kind = Kind::Plain;
    std::string text;
  };
  std::vector<Piece> pieces_;
  bool integer_ = true;  // nothing but the figures can make it a fraction
};

/// The entry that a path names, or null (the C++ one). Names with dots in them cannot be reached. Local.
const nlohmann::ordered_json* findEntry(const nlohmann::ordered_json& summary, const std::string& path);

}  // namespace suture::study
