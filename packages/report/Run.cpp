#include <suture/base/AgreedDimension.hpp>
#include <suture/report/Run.hpp>

namespace suture {

int dimensionOf(const Run& run) { return agreedDimensionOf(run.comm, run.subdomains); }

}  // namespace suture
