#pragma once
#include <suture/pairs/ContactPair.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <string>
#include <vector>

namespace suture {

/// Pairs of one contact, with ids from 0, in the order of their carrying nodes (inOrder).
struct PairedSurface {
  std::vector<ContactPair> pairs;
  std::vector<double> gapDoubts;        ///< estimated error of each pair's gap due to the element shape, signed [length]; or empty
  std::vector<std::vector<int>> cells;  ///< cells between pairs, by pair ids: ContactPiece::cells
  std::vector<AxisPoint> onAxis;        ///< carrying nodes without a pair
};

/// Builds the conditions of a contact: with a rigid obstacle (obstaclePairs), between faces with matching nodes (matchingPairs), or by
/// mortar (mortarPairs). Coupling = Automatic chooses mortar where nodes do not match. Local.
/// \param problems  receives the reasons if no pairs can be built;  \param notes  receives the choice if it is not the simplest one
PairedSurface pairSurface(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes);

/// Cells of a surface between nodes that carry pairs: sides, or linear parts of sides, all of whose nodes carry pairs. Ascending in 2D.
/// Local.
std::vector<std::vector<int>> cellsOf(const Surface& surface, const std::vector<ContactPair>& pairs);

}  // namespace suture
