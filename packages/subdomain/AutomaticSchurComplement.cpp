#include <suture/algebra/CostModel.hpp>
#include <suture/subdomain/AutomaticSchurComplement.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Schema AutomaticSchurComplement::schema() {
  Schema schema("Explicit or Implicit, whichever is faster for each subdomain; summary.json counts the choices.");
  schema.integer("Expected Iterations", 40, "Expected number of applications of each S_i, used by the choice.", Range::atLeast(1));
  schema.real("Memory Limit", 256.0, "Limit for the dense matrix of one subdomain; above it, Implicit.", Range::positive(), "MB");
  return schema;
}

AutomaticSchurComplement::AutomaticSchurComplement(const Parameters& own)
    : AutomaticSchurComplement(own.get<int>("Expected Iterations"), own.get<double>("Memory Limit")) {}

void AutomaticSchurComplement::doCompute(const SchurData& data) {
  const CostModel cost(data.dimension);
  const auto b = static_cast<double>(data.boundary.size());
  const double dense = cost.denseSeconds(b) + iterations_ * cost.productSeconds(b);
  if (dense <= iterations_ * cost.solveSeconds(data.stiffness.rows()) && cost.denseBytes(b) <= megabytes_ * (1 << 20)) {
    name_ = "Explicit";
    own_ = std::make_unique<ExplicitSchurComplement>();
  } else {
    name_ = "Implicit";
    // In 3D factors take most of the memory; in 2D they are small.
    own_ = std::make_unique<ImplicitSchurComplement>(data.dimension == 3 ? ImplicitSchurComplement::Precision::Single
                                                                         : ImplicitSchurComplement::Precision::Double);
  }
  own_->compute(data);
}

}  // namespace suture
