#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/mesh/CellGeometry.hpp>

namespace suture {

template <int D>
void ElementMap<D>::failFolded(double determinant) const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " is inverted or folded at "
       << placeText(place(), D) << ": the determinant of its Jacobian is " << determinant << ", but must be positive";
  throw InputError("Mesh", text.str());
}

template <int D>
void ElementMap<D>::failAcrossAxis() const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " crosses the axis of the axisymmetric "
       << "scene at " << placeText(place(), D) << ": x is the radius and must be positive";
  throw InputError("Mesh", text.str());
}

template class ElementMap<2>;
template class ElementMap<3>;

}  // namespace suture
