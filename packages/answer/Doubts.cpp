#include <suture/answer/Doubts.hpp>
#include <suture/answer/verdict/Findings.hpp>

#include <cstdio>

namespace suture {

void Doubts::add(const Verification& verdict, const std::string& when) {
  for (const Check& check : verdict.checks) {
    if (!check.holds()) continue;  // reported by the verdict
    const auto [at, isNew] = worst_.try_emplace(check.name, check);
    if (!isNew && check.value <= at->second.value) continue;
    at->second = check;
    at->second.where += when;
  }
}

void Doubts::add(const Doubts& others) {
  for (const auto& [name, check] : others.worst_) {
    const auto [at, isNew] = worst_.try_emplace(name, check);
    if (!isNew && check.value > at->second.value) at->second = check;
  }
}

std::vector<std::string> Doubts::warnings() const {
  std::vector<std::string> all;
  for (const Quantity quantity : {Quantity::Slide, Quantity::Offset}) {
    const auto at = worst_.find(nameOf(quantity));
    if (at == worst_.end() || at->second.value < doubtOf(quantity)) continue;
    const Check& check = at->second;
    char numbers[60];
    std::snprintf(numbers, sizeof numbers, " %.2g (limit %.2g) at ", check.value, check.bound);
    all.push_back("warning: " + check.name + numbers + check.where + ". " + check.advice);
  }
  return all;
}

}  // namespace suture
