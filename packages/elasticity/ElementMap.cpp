#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/mesh/CellGeometry.hpp>

namespace suture {

void ElementMap::failFolded(double determinant) const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " is inverted or folded at "
       << placeText(place()) << ": the determinant of its map is " << determinant << ", it must be positive";
  throw InputError("Mesh", text.str());
}

void ElementMap::failAcrossAxis() const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " reaches across the axis of the axisymmetric "
       << "scene at " << placeText(place()) << ": x is the radius, it must be positive";
  throw InputError("Mesh", text.str());
}

}  // namespace suture
