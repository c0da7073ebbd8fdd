#pragma once
#include <suture/base/Registry.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Partition of unity on the interface, D_i of eq. (22)-(25): the share of each local problem in a common unknown.
///
/// Invariant, tested for every implementation:  sum_i R_i^T D_i R_i = I. Strategies: Multiplicity, Young, Stiffness Diagonal, Deluxe;
/// Registry<Weighting> adds user strategies.
class Weighting {
 public:
  static const char* kind() { return "weighting"; }
  virtual ~Weighting() = default;

  /// Collective. `locals` are the local problems that share the interface, in the order of the space's couplings: all for S, only those of
  /// T^M for S_0 (eq. 33-36; null entries do not share). \throws NumericalError  if an unknown has no positive weight; the message gives
  /// its coordinates.
  void setup(const InterfaceSpace& space, const LocalProblems& locals);

  /// trace <- D_i trace. Local. `trace`: displacements [length], unknowns of local problem i on the interface x right-hand sides.
  void apply(int i, LocalView trace) const { doApply(i, trace); }

  /// flux <- D_i^T flux. Local. `flux`: forces [force], same shape as in apply().
  void applyTranspose(int i, LocalView flux) const { doApplyTranspose(i, flux); }

 protected:
  virtual void doSetup(const InterfaceSpace& space, const LocalProblems& locals) = 0;
  virtual void doApply(int i, LocalView trace) const = 0;
  virtual void doApplyTranspose(int i, LocalView flux) const = 0;
};

void registerBuiltIns(Registry<Weighting>& registry);

/// Weights rho_i / sum of rho_j at each unknown. Subclasses implement density(): rho_i > 0 on the boundary of a local problem.
class DiagonalWeighting : public Weighting {
 protected:
  virtual Vector density(const LocalProblem& local) const = 0;

  void doSetup(const InterfaceSpace& space, const LocalProblems& locals) override;
  void doApply(int i, LocalView trace) const override { trace = weights_[i].asDiagonal() * trace; }
  void doApplyTranspose(int i, LocalView flux) const override { flux = weights_[i].asDiagonal() * flux; }

 private:
  std::vector<Vector> weights_;
};

/// One over the number of sharing local problems. Robust only without jumps in stiffness.
class MultiplicityWeighting : public DiagonalWeighting {
 protected:
  Vector density(const LocalProblem& local) const override { return Vector::Ones(local.size()); }
};

/// By Young's modulus, as in the paper; one for local problems without this hint.
class YoungWeighting : public DiagonalWeighting {
 protected:
  Vector density(const LocalProblem& local) const override {
    const Matrix& young = local.hint(Hint::kYoungModulus);
    return young.cols() > 0 ? Vector(young.col(0)) : Vector::Ones(local.size());
  }
};

/// By the diagonal of the stiffness matrix; follows jumps and element sizes.
class StiffnessDiagonalWeighting : public DiagonalWeighting {
 protected:
  Vector density(const LocalProblem& local) const override { return local.stiffnessDiagonal(); }
};

}  // namespace suture
