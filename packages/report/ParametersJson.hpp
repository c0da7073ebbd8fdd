#pragma once
#include <suture/base/Types.hpp>

#include <nlohmann/json_fwd.hpp>

namespace suture {

/// Resolved parameters as nested JSON, names and order as in the scene; arrays become arrays. Local.
/// \throws InternalError  for a value of a type that no schema has
nlohmann::ordered_json toJson(const Parameters& parameters);

}  // namespace suture
