#include <suture/answer/verdict/Findings.hpp>
#include <suture/answer/verdict/Verification.hpp>

#include <algorithm>
#include <cstdio>

namespace suture {

namespace {

double share(const Check& check) {
  if (!check.holds()) return check.bound > 0.0 && check.value > check.bound ? check.value / check.bound : 1e300;
  // The slide is a property of the scene: Doubts warns of it early, and the accuracy of the solution does not depend on it.
  if (check.name == nameOf(Quantity::Slide) || check.name == nameOf(Quantity::Offset)) return 0.0;
  // Round-off bounds these two in every run, so their share says nothing about the accuracy of the solution.
  if (check.name == nameOf(Quantity::Prescribed) || check.name == nameOf(Quantity::Seams)) return 0.0;
  return check.bound > 0.0 ? check.value / check.bound : 0.0;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1e", value);
  return text;
}

}  // namespace

bool Verification::holds() const {
  return !checks.empty() && std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.holds(); });
}

const Check* Verification::worst() const {
  const auto at = std::max_element(checks.begin(), checks.end(), [](const Check& a, const Check& b) { return share(a) < share(b); });
  return at == checks.end() ? nullptr : &*at;
}

std::string Verification::failure() const {
  std::string text;
  std::vector<std::string> advice;
  for (const Check& check : checks) {
    if (check.holds()) continue;
    text += (text.empty() ? "" : "; ") + check.name + " " + number(check.value) + " exceeds " + number(check.bound) +
            (check.where.empty() ? "" : " (" + check.where + ")");
    if (!check.advice.empty() && std::find(advice.begin(), advice.end(), check.advice) == advice.end()) advice.push_back(check.advice);
  }
  for (const std::string& sentence : advice) text += ". " + sentence;
  return text;
}

}  // namespace suture
