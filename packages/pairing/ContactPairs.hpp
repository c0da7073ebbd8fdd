#pragma once
#include <suture/pairing/ContactPair.hpp>
#include <suture/pairing/ContactSurface.hpp>

#include <string>
#include <vector>

namespace suture {

/// The pairs of one contact, with ids from 0, in the order of the nodes that carry them (inOrder).
struct PairedSurface {
  std::vector<ContactPair> pairs;
  std::vector<double> gapDoubts;  ///< estimated error of each pair's gap by the shape of the elements, with its sign [length]; or empty
  std::vector<std::vector<int>> cells;  ///< between pairs, by their ids: ContactPiece::cells
  std::vector<AxisPoint> onAxis;        ///< carrying nodes without a pair
};

/// The conditions of a contact: with a rigid obstacle (obstaclePairs), between faces whose nodes match (matchingPairs), or by mortar
/// (mortarPairs). Coupling = Automatic chooses mortar where nodes do not match. Local.
/// \param problems  gets the reasons if that is impossible;  \param notes  gets the choice, if it is not the simplest
PairedSurface pairSurface(const Mesh& mesh, const ContactSurface& contact, Problems& problems, std::vector<std::string>& notes);

/// Cells of a surface between nodes that carry pairs: sides, or linear parts of them, all of whose nodes do. In the plane ascending. Local.
std::vector<std::vector<int>> cellsOf(const Surface& surface, const std::vector<ContactPair>& pairs);

}  // namespace suture
