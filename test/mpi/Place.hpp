#pragma once
#include <cstdint>

namespace mpiorder {

/// Calling place of an MPI function: the functions on the stack that are neither in the system's libraries nor in this one.
struct Place {
  std::uint64_t hash = 0;  ///< the same in every process of the program
  std::uint32_t text = 0;  ///< the innermost of them by name, see Board::keep()
};

Place placeOfCall();

}  // namespace mpiorder
