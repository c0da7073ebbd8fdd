#pragma once
#include <suture/pairs/ContactPair.hpp>

#include <string>
#include <vector>

namespace suture {

/// A connected component of Gamma_c.
struct ContactPiece {
  std::string name;         ///< name of the contact; "<contact> 2" for its second component, "a + b" for contacts that touch
  std::vector<int> pairs;   ///< ids
  std::vector<int> bodies;  ///< ascending
  /// Cells between the nodes that carry pairs, by ids of the pairs: segments in 2D, triangles and quadrilaterals in 3D; several per
  /// second-order side.
  std::vector<std::vector<int>> cells;
  double pressureDoubt = 0.0;  ///< estimated error of nodal pressures where straight elements represent curved sides [stress]
  std::vector<AxisPoint> onAxis;
  std::vector<int> openEnds{};   ///< ids of pairs at the rim, beyond which the boundaries continue free and without a corner
  bool isWithinOneBody = false;  ///< both sides are of the same body: the piece holds no body

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.name), each(self.pairs), each(self.bodies), each(self.cells), each(self.pressureDoubt), each(self.onAxis);
    each(self.openEnds), each(self.isWithinOneBody);
  }
};

}  // namespace suture
