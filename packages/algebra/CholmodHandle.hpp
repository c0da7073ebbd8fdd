#pragma once
#include <memory>

struct cholmod_common_struct;
struct cholmod_factor_struct;

namespace suture {

/// CHOLMOD's settings, and a factor made with them, freed together. Local.
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

  const std::unique_ptr<cholmod_common_struct> common;
  cholmod_factor_struct* factor = nullptr;
};

}  // namespace suture
