#pragma once
#include <suture/interface/InterfaceOperator.hpp>

namespace suture {

/// Averaging in BDDC across closed rows of several terms (a mortar). In the torn space, local problems share unknowns only with others of
/// the same body, and X = T w means X_s = M X_m, with s the expressed unknowns of the rows and m the unknowns that express them. Values
/// averaged within the bodies leave a jump X_s - M X_m, which is distributed to both sides:
///
///     B X = X_m + G (X_s - M X_m),   G ~ (Delta_m + M^T Delta_s M)^-1 M^T Delta_s,
///
/// with Delta the diagonals of the stiffness, summed within the bodies. B T = I for every G, so BDDC stays symmetric with no eigenvalue
/// below one; for matching nodes B is the weighting by the stiffness. Each column of G is computed on a patch: the unknowns of its row and
/// some layers of neighbours, more if the stiffness jumps. In 3D, where rows name many nodes, each rank factors the whole matrix instead
/// unless there are thousands of unknowns.
class MortarAveraging {
 public:
  /// \param torn  the torn space, or the space itself on ranks without one; \param locals  in the order of its couplings. Collective.
  MortarAveraging(const InterfaceSpace& space, const InterfaceSpace& torn, const LocalProblems& locals);

  /// values <- B values. In: sums within the bodies; out: a trace of the space, zero at its expressed unknowns. Collective.
  void apply(MultiVector& values) const;
  /// values <- B^T values. In: a flux of the space; out: a flux of the torn space. Collective.
  void applyTranspose(MultiVector& values) const;

 private:
  using Crs = Tpetra::CrsMatrix<>;
  void makeWork(std::size_t columns) const;
  Teuchos::RCP<Crs> jump_;      // (1, -M): rows of the expressed unknowns; other rows are empty
  Teuchos::RCP<Crs> parts_;     // G^T: rows s, columns m
  std::vector<int> expressed_;  // owned rows
  mutable MultiVectorPtr work_;
};

}  // namespace suture
