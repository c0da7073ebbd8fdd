#pragma once
#include <suture/base/Registry.hpp>
#include <suture/subdomain/LocalProblem.hpp>

#include <memory>

namespace suture {

/// Traces Z_i of a local problem that the balancing coarse problem holds (eq. 28-31: the columns D_i Z_i). The traces must contain the
/// kernel of S_i if its Neumann problem is to see balanced loads only. Strategies: None, Kernels, Rigid Modes; a user adds his own through
/// Registry<CoarseSpace>. Local.
class CoarseSpace {
 public:
  static const char* kind() { return "coarse space"; }
  virtual ~CoarseSpace() = default;
  /// size() x k; columns may depend on each other (dependent ones are left out).
  virtual Matrix columns(const LocalProblem& local) const = 0;
};

void registerBuiltIns(Registry<CoarseSpace>& registry);

/// No coarse problem: the number of iterations grows with the number of subdomains.
class NoCoarseSpace : public CoarseSpace {
 public:
  Matrix columns(const LocalProblem& local) const override { return Matrix(local.size(), 0); }
};

/// Kernels of S_i and of S^0_j: the paper's Z. Subdomains that are held somewhere contribute nothing.
class KernelCoarseSpace : public CoarseSpace {
 public:
  Matrix columns(const LocalProblem& local) const override { return local.kernel(); }
};

/// All rigid modes of every original subdomain, floating or not, members of groups included.
class RigidModeCoarseSpace : public CoarseSpace {
 public:
  Matrix columns(const LocalProblem& local) const override {
    const Matrix& modes = local.hint(Hint::kCoarseModes);
    return modes.cols() > 0 ? modes : local.kernel();
  }
};

}  // namespace suture
