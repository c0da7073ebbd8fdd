#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/ContactLine.hpp>

#include <string>
#include <vector>

namespace suture {

/// The pairs of one contact line, with ids from 0, in the order of the nodes that carry them.
struct PairedLine {
  std::vector<ContactPair> pairs;
  std::vector<double>
      gapDoubts;  ///< of each pair: estimated error of its gap by the shape of the elements, with its sign [length]; or empty
  struct Chain {
    int first, count;
    bool closed;
  };
  std::vector<Chain> chains;      ///< connected stretches
  std::vector<AxisPoint> onAxis;  ///< carrying nodes without a pair
};

/// The conditions of a contact line: of a rigid obstacle (obstacleLine), of sides whose nodes match (matchingLine), or mortar (mortarLine);
/// what the scene leaves open (Coupling = Automatic) is mortar where nodes do not match. Local. \param problems  gets what makes that
/// impossible;  \param notes  what was chosen, if not the simplest
PairedLine pairLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes);

}  // namespace suture
