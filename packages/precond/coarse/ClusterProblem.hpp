#pragma once
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>
#include <suture/subdomain/LocalProblem.hpp>

namespace suture {

/// A cluster of local problems, seen from the coarse problem that they share: the sum of their terms in the coarse matrix. To the next
/// level it is a local problem like any other: coarse unknowns of its own are eliminated, those that it shares with other clusters are its
/// boundary. One sparse factorisation, interior first (CholmodFactor), gives the Schur complement and the interior. Local.
class ClusterProblem : public LocalProblem {
 public:
  /// \param boundary  coarse unknowns that other clusters touch, too
  /// \param elements  matrices of its members; they name all of `boundary`
  /// \param motions   values of the boundary under rigid motions, size() x their number
  /// \throws NumericalError  the interior is singular
  ClusterProblem(int id, std::vector<GlobalId> boundary, const std::vector<CoarseElement>& elements, const Matrix& motions);

  void applySchur(ConstLocalView trace, LocalView flux) const override;
  Vector condensedLoad() const override { return Vector::Zero(size()); }
  double constantEnergy() const override { return 0.0; }
  const Vector& stiffnessDiagonal() const override { return diagonal_; }
  /// Rigid motions without energy: elements have no others (Bddc makes no level where they have), and members fix each other.
  const Matrix& kernel() const override { return kernel_; }
  using LocalProblem::inverse;
  /// From the eigenvalues of S.
  std::unique_ptr<LocalInverse> inverse() const override;
  Matrix schur() const override { return schur_; }

  /// Coarse unknowns of its own, ascending.
  const std::vector<int>& interior() const { return interior_; }
  /// Flux that the boundary, held, exerts against loads in the interior.
  /// \param interior  in: the loads; lost
  void condense(LocalView interior, LocalView flux) const;
  /// \param interior  in: the loads; out: the values under them and with this trace
  void recover(ConstLocalView trace, LocalView interior) const;

 protected:
  /// A cluster has no material: for Young's modulus its diagonal again, which follows jumps in the same way.
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
