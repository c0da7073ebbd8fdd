#pragma once
#include <suture/base/scene/Schema.hpp>

namespace suture::study {

/// The study file: what its reader accepts and suture_schema prints for it. Local.
Schema studySchema();

}  // namespace suture::study
