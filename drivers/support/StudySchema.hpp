#pragma once
#include <suture/base/Schema.hpp>

namespace suture {

/// The study file: what its reader accepts and suture_schema prints for it. Local.
Schema studySchema();

}  // namespace suture
