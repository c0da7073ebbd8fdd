#pragma once
#include <suture/base/Types.hpp>

#include <nlohmann/json_fwd.hpp>

namespace suture {

/// Resolved parameters as nested JSON, with names and order of the scene; arrays become arrays. Local.
/// \throws InternalError  a value has a type that no schema allows
nlohmann::ordered_json toJson(const Parameters& parameters);

}  // namespace suture
