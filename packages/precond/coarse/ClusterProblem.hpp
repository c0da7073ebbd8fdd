#pragma once
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>
#include <suture/subdomain/LocalProblem.hpp>

namespace suture {

/// A cluster of local problems: the sum of their terms in the coarse matrix. On the next level it is a local problem like any other: coarse
/// unknowns that only this cluster has are eliminated, those shared with other clusters form its boundary. One sparse factorisation,
/// interior first (CholmodFactor), gives the Schur complement and the interior solution. Local.
class ClusterProblem : public LocalProblem {
 public:
  /// \param boundary  coarse unknowns shared with other clusters
  /// \param elements  matrices of its members; together they name all of `boundary`
  /// \param motions   values of the boundary under rigid motions, size() x their number
  /// \throws NumericalError  if the interior is singular
  ClusterProblem(int id, std::vector<GlobalId> boundary, const std::vector<CoarseElement>& elements, const Matrix& motions);

  void applySchur(ConstLocalView trace, LocalView flux) const override;
  Vector condensedLoad() const override { return Vector::Zero(size()); }
  double constantEnergy() const override { return 0.0; }
  const Vector& stiffnessDiagonal() const override { return diagonal_; }
  /// Rigid motions without energy. There are no other null vectors: Bddc makes no further level for elements that have some, and the
  /// members of a cluster are fixed to each other.
  const Matrix& kernel() const override { return kernel_; }
  using LocalProblem::inverse;
  /// Pseudo-inverse from the eigenpairs of S.
  std::unique_ptr<LocalInverse> inverse() const override;
  Matrix schur() const override { return schur_; }

  /// Coarse unknowns that only this cluster has, ascending.
  const std::vector<int>& interior() const { return interior_; }
  /// Flux of the fixed boundary that balances loads in the interior. \param interior  in: the loads; overwritten
  void condense(LocalView interior, LocalView flux) const;
  /// \param interior  in: the loads; out: the solution for these loads and this trace
  void recover(ConstLocalView trace, LocalView interior) const;

 protected:
  /// A cluster has no material: Young's modulus is replaced by the stiffness diagonal, which follows jumps in the same way.
  Matrix doHint(const std::string& name) const override {
    return name == Hint::kYoungModulus ? Matrix(diagonal_) : LocalProblem::doHint(name);
  }

 private:
  Matrix withoutEnergy(const Matrix& motions) const;

  std::vector<int> interior_;
  SparseMatrix ib_;
  std::unique_ptr<CholmodFactor> factor_;
  Matrix schur_;
  Matrix kernel_;
  Vector diagonal_;
};

}  // namespace suture
