#include <suture/subdomain/AutomaticSchurComplement.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

Schema AutomaticSchurComplement::schema() {
  Schema schema("Explicit or Implicit, for each subdomain what takes less time; summary.json counts them.");
  schema.integer("Expected Iterations", 40, "Applications of each S_i that the choice reckons with.", Range::atLeast(1));
  schema.real("Memory Limit", 256.0, "For the dense matrix of one subdomain; above it, Implicit.", Range::positive(), "MB");
  return schema;
}

AutomaticSchurComplement::AutomaticSchurComplement(const Parameters& own)
    : AutomaticSchurComplement(own.get<int>("Expected Iterations"), own.get<double>("Memory Limit")) {}

void AutomaticSchurComplement::doCompute(const SchurData& data) {
  const double n = std::max<double>(2.0, data.stiffness.rows()), b = static_cast<double>(data.boundary.size());
  const double bytes = 4.4 * b * b, factor = 8.0 * n * std::log2(n);
  const double dense = 2.0 / 3.0 * b * b * b / 5e9 + iterations_ * bytes / 8e9, sparse = iterations_ * 16.0 * factor / 3e9;
  if (dense <= sparse && bytes <= megabytes_ * (1 << 20)) {
    name_ = "Explicit";
    own_ = std::make_unique<ExplicitSchurComplement>();
  } else {
    name_ = "Implicit";
    own_ = std::make_unique<ImplicitSchurComplement>();
  }
  own_->compute(data);
}

}  // namespace suture
