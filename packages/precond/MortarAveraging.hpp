#pragma once
#include <suture/interface/InterfaceOperator.hpp>

namespace suture {

/// How both sides of closed rows of several terms (a mortar) share their displacements in BDDC. In the torn space, where local problems
/// share with others of their own body only, X = T w, X_s = M X_m for the rows' expressed unknowns s and those m that express them. Values
/// that have been averaged within the bodies leave a jump X_s - M X_m; both sides take their parts of it:
///
///     B X = X_m + G (X_s - M X_m),   G ~ (Delta_m + M^T Delta_s M)^-1 M^T Delta_s,
///
/// Delta the diagonals of the stiffness, summed within the bodies. B T = I whatever G is, so that BDDC stays symmetric with no eigenvalue
/// below one; of matching nodes it is the weighting by the stiffness. Each column of G is found on a patch: the unknowns of its row and
/// some layers of neighbours, more where stiffness jumps; in space, where rows name many nodes, by one factor of the whole on each rank
/// unless there are thousands of unknowns.
class MortarAveraging {
 public:
  /// \param torn  the torn space, or the space itself where a rank has none; \param locals  in the order of its couplings. Collective.
  MortarAveraging(const InterfaceSpace& space, const InterfaceSpace& torn, const LocalProblems& locals);

  /// values <- B values: sums within the bodies in, a trace of the space out (its expressed unknowns are zero). Collective.
  void apply(MultiVector& values) const;
  /// values <- B^T values: a flux of the space in, one of the torn space out. Collective.
  void applyTranspose(MultiVector& values) const;

 private:
  using Crs = Tpetra::CrsMatrix<>;
  void makeWork(std::size_t columns) const;
  Teuchos::RCP<Crs> jump_;      // (1, -M): rows of the expressed unknowns, the others are empty
  Teuchos::RCP<Crs> parts_;     // G^T: rows of s, columns of m
  std::vector<int> expressed_;  // owned rows
  mutable MultiVectorPtr work_;
};

}  // namespace suture
