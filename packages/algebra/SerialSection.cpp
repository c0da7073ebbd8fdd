#include <omp.h>
#include <suture/algebra/SerialSection.hpp>

namespace suture {

SerialSection::SerialSection() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
SerialSection::~SerialSection() { omp_set_max_active_levels(levels_); }

}  // namespace suture
