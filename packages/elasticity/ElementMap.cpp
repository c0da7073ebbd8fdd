#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElementMap.hpp>

namespace suture {

void ElementMap::failFolded(double determinant) const {
  std::ostringstream text;
  text << "element " << element_ << " of shape " << cellInfo(block_.cells[element_]).name << " is inverted or folded near (" << x_[0][0]
       << ", " << x_[0][1] << "): the determinant of its map is " << determinant << ", it must be positive";
  throw InputError("Mesh", text.str());
}

}  // namespace suture
