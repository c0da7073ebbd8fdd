// Expressions of a scene: the last line is one; lines before it are functions f0, f1, ... of place, each of which may use those above it.
#include "Fuzz.hpp"

#include <suture/base/Expression.hpp>

#include <Teuchos_ParameterList.hpp>
#include <cmath>

using namespace suture;

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  Parameters functions("Functions");
  int count = 0;
  for (std::size_t end; count < 8 && (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
    functions.set("f" + std::to_string(count++), text.substr(0, end));
  Constants constants{{"A", -2.5}, {"kappa", 1.8}};
  Problems problems;
  fuzz::accepts([&] { readFunctions(functions, constants, problems); });
  fuzz::accepts([&] {
    const Expression expression(text, constants, "Load/Expression x");
    for (const Point& point : {Point{0, 0, 0}, Point{1, -1, 0}, Point{1e300, 1e-300, 0}})
      fuzz::accepts([&] { fuzz::require(std::isfinite(expression.at(point))); });
  });
  return 0;
}
