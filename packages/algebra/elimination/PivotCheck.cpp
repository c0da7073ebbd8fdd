#include <suture/algebra/elimination/PivotCheck.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace suture {

std::string PivotCheck::brokeDown() const {
  return "Cholesky factorisation broke down: the matrix (" + std::to_string(size_) + " dofs, " + std::to_string(trailing_) +
         " of them ordered last) is singular ";
}

void PivotCheck::judge() const {
  // Measured on floating squares: up to n eps / 10. Legitimate pivots can be small, too: (thickness / length)^3 of a beam, the ratio of
  // Young's moduli around a stiff inclusion. The cap therefore accepts large singular matrices rather than refuse such regular ones.
  const double rounding = std::min(1e-13, size_ * std::numeric_limits<double>::epsilon());
  if (smallest_ > rounding) return;
  std::ostringstream message;
  message << brokeDown() << "to working precision; the pivot of dof " << unknown_ << " is " << smallest_ << " of its diagonal entry";
  throw NumericalError(message.str());
}

void PivotCheck::notPositive(int unknown, int step) const {
  throw NumericalError(brokeDown() + "or indefinite; the pivot of dof " + std::to_string(unknown) + ", step " + std::to_string(step) +
                       ", is not positive");
}

}  // namespace suture
