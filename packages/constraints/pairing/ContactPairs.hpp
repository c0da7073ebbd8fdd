#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/ContactLine.hpp>

#include <string>
#include <vector>

namespace suture {

/// The pairs of one contact line, with ids from 0, in the order of the nodes that carry them.
struct PairedLine {
  std::vector<ContactPair> pairs;
  std::vector<double> gapDoubts;  ///< estimated error of each pair's gap by the shape of the elements, with its sign [length]; or empty
  struct Chain {
    int first, count;
    bool closed;
  };
  std::vector<Chain> chains;      ///< connected stretches
  std::vector<AxisPoint> onAxis;  ///< carrying nodes without a pair
};

/// The conditions of a contact line: with a rigid obstacle (obstacleLine), between sides whose nodes match (matchingLine), or by mortar
/// (mortarLine). Coupling = Automatic chooses mortar where nodes do not match. Local.
/// \param problems  gets the reasons if that is impossible;  \param notes  gets the choice, if it is not the simplest
PairedLine pairLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes);

}  // namespace suture
