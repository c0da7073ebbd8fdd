#pragma once
#include <map>
#include <optional>
#include <set>

namespace suture {

/// Decisions of a mortar that are not continuous in the shapes of its faces. While the shapes of a load step are found in rounds, decisions
/// that change with each round would leave no shapes that reproduce themselves: mortarPairs() changes an earlier decision only if the faces
/// have moved by some per cent of a side beyond the limit of the decision. Local.
struct MortarChoices {
  std::optional<bool> onA;  ///< face A carries the conditions; nothing: no decision has been made yet
  std::set<int> whole;      ///< sides of the carrying face that count as covered entirely
  std::set<int> reached;    ///< nodes that carry a condition
};

/// Choices of several contacts, by ContactSurface::number.
using KeptChoices = std::map<int, MortarChoices>;

}  // namespace suture
