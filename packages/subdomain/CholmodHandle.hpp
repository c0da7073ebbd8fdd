#pragma once
#include <cholmod.h>

namespace suture {

/// CHOLMOD's settings, and a factor made with them, freed together. For the sources that call CHOLMOD; no header includes this one. Local.
struct CholmodHandle {
  CholmodHandle();
  ~CholmodHandle();
  CholmodHandle(const CholmodHandle&) = delete;
  CholmodHandle& operator=(const CholmodHandle&) = delete;

  /// After every call: CHOLMOD prints nothing and returns.
  /// \param what  was being done
  /// \throws EnvironmentError  out of memory, or more entries than 32-bit numbers count
  /// \throws InternalError     anything else
  void check(const char* what) const;

  cholmod_common common{};
  cholmod_factor* factor = nullptr;
};

}  // namespace suture
