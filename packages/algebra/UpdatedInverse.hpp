#pragma once
#include <suture/algebra/InverseWithBasis.hpp>
#include <suture/algebra/dense/PackedColumns.hpp>

#include <memory>
#include <vector>

namespace suture {

/// BDDC's inverse for modified constraints, with some rows removed and some added, as in a contact search:
///     P' = P + Phi_R E_RR^-1 Phi_R^T - W G^-1 W^T,   W = (P + Phi_R E_RR^-1 Phi_R^T) D^T,   G = D W,
/// where R are the rows removed, D those added, and E = Phi^T S Phi the energies. Rows are removed first: the traces that vanish in the
/// remaining rows are those that vanish in all rows plus the span of Phi_R, which is S-orthogonal to them. Exact, at the cost of one
/// product with P per row added instead of a factorisation; P is not modified. For low-rank updates of an inverse in general see Hager,
/// Updating the inverse of a matrix, SIAM Review 31 (1989). Local.
class UpdatedInverse : public InverseWithBasis {
 public:
  /// \param base         an inverse under constraints
  /// \param from         for each new row, the equal row of `base`, or -1
  /// \param constraints  the new rows x trace
  /// \return null if P' would be inaccurate: the remaining rows hold the trace badly or not at all, new rows nearly depend on
  /// others, or they stop a motion that the base leaves to a soft support
  static std::unique_ptr<UpdatedInverse> make(std::shared_ptr<const LocalInverse> base, const std::vector<int>& from,
                                              const Matrix& constraints);

  void apply(ConstLocalView flux, LocalView trace) const override;
  double bytesRead() const override;

 private:
  bool cancels(int size) const;
  UpdatedInverse() = default;

  std::shared_ptr<const LocalInverse> base_;
  PackedColumns plus_, minus_;  // Phi_R E_RR^-1/2, W G^-1/2
  mutable Vector gain_, loss_;  // work space
};

/// The inverse for other constraints: the base itself if they are the same in the same order, else UpdatedInverse::make(), which may return
/// null. Local. \param rows  number of the base's constraints;  \param from, constraints  as for UpdatedInverse::make()
std::shared_ptr<const LocalInverse> inverseUnder(const std::shared_ptr<const LocalInverse>& base, int rows, const std::vector<int>& from,
                                                 const Matrix& constraints);

}  // namespace suture
