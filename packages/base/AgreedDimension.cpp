#include "AgreedDimension.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "Errors.hpp"

namespace suture {

int agreedDimension(const Comm& comm, int mine) {
  constexpr int kUnknown = 99;
  const int own[] = {mine, mine == 0 ? -kUnknown : -mine};  // maximum, and minus the minimum over the ranks that know it
  int all[] = {0, 0};
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, own, all);
  if (all[0] > 0 && all[0] != -all[1])
    throw InternalError("two ranks know different dimensions of the scene: " + std::to_string(-all[1]) + " and " + std::to_string(all[0]));
  return all[0];
}

}  // namespace suture
