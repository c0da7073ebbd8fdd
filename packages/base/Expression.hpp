#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

class Problems;
class Schema;

struct Constants;

/// A function of the point (x, y), in 3D (x, y, z), from a text such as "A * sqrt(x^2 + y^2)": operators + - * / ^ (-x^2 is -(x^2)),
/// comparisons, && ||, c ? a : b, the functions of muParser (sin, atan2, sqrt, exp, ln, abs, min, ...), the given constants, and pi.
///
/// The text is compiled once to byte code: an evaluation costs about as much as its operations and allocates nothing. Copies share the
/// byte code. Must not be evaluated by two threads at once.
class Expression {
 public:
  /// \param path  parameter that holds the text, for messages
  /// \throws InputError  all unknown names (with nearest and known names), or where the syntax is wrong. Local.
  Expression(const std::string& text, const Constants& constants, const std::string& path = "");
  explicit Expression(const std::string& text);
  /// A C++ function in place of a text; must not be used in Constants.
  explicit Expression(std::function<double(const Point&)> function);

  /// \throws InputError  if the value is not finite; names expression and point. Local.
  double at(const Point& point) const;

  const std::string& text() const;
  static std::string libraryVersion();
  /// Names of all functions, ascending.
  static std::vector<std::string> functions();

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
  std::function<double(const Point&)> function_;
};

/// User-defined constants and functions for the expressions of the scene.
struct Constants {
  std::map<std::string, double> numbers;
  std::map<std::string, Expression> functions;  ///< functions of the point: in another expression the name is the value there
  int dimension = 2;                            ///< 3: expressions know z; 1: a time t and no coordinates

  Constants() = default;
  Constants(std::initializer_list<std::pair<const std::string, double>> numbers) : numbers(numbers) {}
  bool has(const std::string& name) const { return numbers.count(name) > 0 || functions.count(name) > 0; }
};

/// The scene's lists `Constants` and `Functions`.
Schema constantsSchema();
Schema functionsSchema();

/// The numbers of a list `Constants`. \param problems  gets names that an expression cannot use or that are already taken there. Local.
Constants readConstants(const Parameters& list, Problems& problems, int dimension = 2);

/// Adds the functions of a list `Functions`; each may use those above it. \param problems  as above, and invalid expressions. Local.
void readFunctions(const Parameters& list, Constants& constants, Problems& problems);

/// Constants and Functions of a whole scene, if it has such lists, and its dimension (3 if its `Model` is Solid). \throws InputError with
/// all of these problems. Local.
Constants sceneConstants(const Parameters& scene);

/// The expression in a text parameter of a list; nothing if the parameter is absent or invalid (then added to `problems`). Local.
std::optional<Expression> readExpression(const Parameters& list, const std::string& parameter, const Constants& constants,
                                         Problems& problems);

}  // namespace suture
