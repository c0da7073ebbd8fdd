#pragma once
#include <suture/base/Types.hpp>

#include <string>

namespace suture {

/// Names of the scene's units, for printing: Suture never converts.
struct Units {
  std::string length = "m", force = "N", stress = "Pa";
};

/// From the scene's `Units` ("m, N, Pa": length, force, stress); a missing one is called by its quantity ("length"). Local.
Units unitsOf(const Parameters& scene);

}  // namespace suture
