#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/mesh/CellGeometry.hpp>

namespace suture {

template <int D>
void ElementMap<D>::failFolded(double determinant) const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " is inverted or folded at "
       << placeText(place(), D) << ": the determinant of its map is " << determinant << ", it must be positive";
  throw InputError("Mesh", text.str());
}

template <int D>
void ElementMap<D>::failAcrossAxis() const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " reaches across the axis of the axisymmetric "
       << "scene at " << placeText(place(), D) << ": x is the radius, it must be positive";
  throw InputError("Mesh", text.str());
}

template class ElementMap<2>;
template class ElementMap<3>;

}  // namespace suture
