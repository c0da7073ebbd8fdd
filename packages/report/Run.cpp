#include <Teuchos_CommHelpers.hpp>
#include <suture/report/Run.hpp>

namespace suture {

int dimensionOf(const Run& run) {
  const int mine = run.subdomains.empty() ? 0 : run.subdomains.front().dimension;
  int all = 0;
  Teuchos::reduceAll(run.comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace suture
