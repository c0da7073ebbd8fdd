#include <cholmod.h>
#include <suture/algebra/CholmodHandle.hpp>
#include <suture/base/Errors.hpp>

#include <string>

namespace suture {

CholmodHandle::CholmodHandle() : common(std::make_unique<cholmod_common>()) {
  cholmod_start(common.get());
  common->print = 0;
  common->error_handler = nullptr;
  common->try_catch = 1;  // suppresses all messages; check() reads the status
}

CholmodHandle::~CholmodHandle() {
  cholmod_free_factor(&factor, common.get());
  cholmod_finish(common.get());
}

void CholmodHandle::check(const char* what) const {
  if (common->status >= CHOLMOD_OK) return;
  const std::string where = std::string("CHOLMOD, ") + what + ": ";
  if (common->status == CHOLMOD_OUT_OF_MEMORY) throw EnvironmentError(where + "out of memory");
  if (common->status == CHOLMOD_TOO_LARGE) throw EnvironmentError(where + "the factor has more entries than 32-bit numbers can count");
  if (common->status == CHOLMOD_NOT_INSTALLED) throw InternalError(where + "this CHOLMOD was built without the requested method");
  throw InternalError(where + "invalid input (status " + std::to_string(common->status) + ")");
}

}  // namespace suture
