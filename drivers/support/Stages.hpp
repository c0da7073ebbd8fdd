#pragma once
#include <string>
#include <suture/base/Collective.hpp>
#include <suture/base/Timers.hpp>

namespace suture {

/// Returns the result of `make`; the time it takes is added to a phase.
template <typename Make>
auto timed(Timers& timers, const std::string& phase, const Make& make) {
  const Timers::Scope scope(timers, phase);
  return make();
}

/// Returns the result of `make` on rank 0, an empty object elsewhere; an exception becomes that of all ranks. Collective.
template <typename Make>
auto onRoot(const Comm& comm, const std::string& what, const Make& make) {
  decltype(make()) result{};
  collectivelyOnRoot(comm, what, [&] { result = make(); });
  return result;
}

}  // namespace suture
