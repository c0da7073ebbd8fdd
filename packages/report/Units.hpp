#pragma once
#include <suture/base/Types.hpp>

#include <string>

namespace suture {

/// Names of the scene's units, for printing; Suture never converts values.
struct Units {
  std::string length = "m", force = "N", stress = "Pa";
};

/// Reads the scene's `Units` ("m, N, Pa": length, force, stress); a missing unit is named after its quantity ("length"). Local.
Units unitsOf(const Parameters& scene);

}  // namespace suture
