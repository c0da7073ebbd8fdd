#pragma once
#include <suture/base/Registry.hpp>
#include <suture/subdomain/LocalProblem.hpp>

#include <memory>

namespace suture {

/// Traces Z_i of a local problem in the balancing coarse problem (eq. 28-31: the columns D_i Z_i). They must contain the kernel of S_i if
/// its Neumann problem is to see only balanced loads. Strategies: None, Kernels, Rigid Modes; Registry<CoarseSpace> adds user strategies.
/// Local.
class CoarseSpace {
 public:
  static const char* kind() { return "coarse space"; }
  virtual ~CoarseSpace() = default;
  /// size() x k; linearly dependent columns are allowed (and dropped).
  virtual Matrix columns(const LocalProblem& local) const = 0;
};

void registerBuiltIns(Registry<CoarseSpace>& registry);

/// No coarse problem: the number of iterations grows with the number of subdomains.
class NoCoarseSpace : public CoarseSpace {
 public:
  Matrix columns(const LocalProblem& local) const override { return Matrix(local.size(), 0); }
};

/// Kernels of S_i and of S^0_j: the paper's Z. Subdomains with supports contribute nothing.
class KernelCoarseSpace : public CoarseSpace {
 public:
  Matrix columns(const LocalProblem& local) const override { return local.kernel(); }
};

/// All rigid-body modes of every original subdomain, floating or not, including members of groups.
class RigidModeCoarseSpace : public CoarseSpace {
 public:
  Matrix columns(const LocalProblem& local) const override {
    const Matrix& modes = local.hint(Hint::kCoarseModes);
    return modes.cols() > 0 ? modes : local.kernel();
  }
};

}  // namespace suture
