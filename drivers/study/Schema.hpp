#pragma once
#include <suture/base/scene/Schema.hpp>

namespace suture::study {

/// Schema of the study file, for its reader and suture_schema. Local.
Schema studySchema();

}  // namespace suture::study
