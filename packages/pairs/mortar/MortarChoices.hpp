#pragma once
#include <map>
#include <optional>
#include <set>

namespace suture {

/// Decisions of a mortar that are not continuous in the shapes of its faces. While the shapes of a load step are found in rounds, a
/// decision that changed with each round would leave no shapes that reproduce themselves: it changes only if the faces move beyond the
/// limit at which it was made by kBand. Local.
struct MortarChoices {
  std::optional<bool> onA;  ///< face A carries the conditions; nothing: no decision has been made yet
  std::set<int> whole;      ///< sides that count as covered entirely
  std::set<int> reached;    ///< nodes that carry a condition

  /// Width of a limit for covered parts of sides: more than strains change them, less than elements of any use. Not critical.
  static constexpr double kBand = 0.02;
  /// The limit that a decision must pass now. \param limit  without earlier decisions \param was  the earlier one
  double limit(double limit, bool was) const { return onA && !was ? limit + kBand : limit; }
};

/// Choices of several contacts, by their numbers.
using KeptChoices = std::map<int, MortarChoices>;

}  // namespace suture
