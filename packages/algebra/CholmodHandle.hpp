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

  /// Checks the status; call after every CHOLMOD function, which prints nothing and returns.
  /// \param what  operation, for the message
  /// \throws EnvironmentError  out of memory, or more entries than 32-bit integers can count
  /// \throws InternalError     any other error
  void check(const char* what) const;

  const std::unique_ptr<cholmod_common_struct> common;
  cholmod_factor_struct* factor = nullptr;
};

}  // namespace suture
