#pragma once
#include <cstdint>

namespace mpiorder {

/// Where the program called an MPI function: the functions on the stack that are neither of the system's libraries nor of this one.
struct Place {
  std::uint64_t hash = 0;  ///< the same in every process of the program
  std::uint32_t text = 0;  ///< the innermost of them by name, see Board::keep()
};

Place placeOfCall();

}  // namespace mpiorder
