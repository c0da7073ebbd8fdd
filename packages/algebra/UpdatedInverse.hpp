#pragma once
#include <suture/algebra/InverseWithBasis.hpp>
#include <suture/algebra/dense/PackedColumns.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The inverse of BDDC under other constraints than those it was made for, some rows removed, some added, as in a contact search:
///     P' = P + Phi_R E_RR^-1 Phi_R^T - W G^-1 W^T,   W = (P + Phi_R E_RR^-1 Phi_R^T) D^T,   G = D W,
/// R the rows removed, D those added, E = Phi^T S Phi the energies. The removal comes first: traces with no value in the rows left are
/// those with none in all rows and the span of Phi_R, which is S-orthogonal to them. Exact, by a product with P for each row added instead
/// of a factorisation, and P is not touched. Low-rank updates of an inverse in general: Hager, Updating the inverse of a matrix, SIAM
/// Review 31 (1989). Local.
class UpdatedInverse : public InverseWithBasis {
 public:
  /// \param base         an inverse under constraints
  /// \param from         row of `base` that each new row is, or -1
  /// \param constraints  the new rows x trace
  /// \return null where P' would be inaccurate: the rows left hold the trace badly or not at all, or new rows nearly follow from others
  static std::unique_ptr<UpdatedInverse> make(std::shared_ptr<const LocalInverse> base, const std::vector<int>& from,
                                              const Matrix& constraints);

  void apply(ConstLocalView flux, LocalView trace) const override;
  double bytesRead() const override;

 private:
  UpdatedInverse() = default;

  std::shared_ptr<const LocalInverse> base_;
  PackedColumns plus_, minus_;  // Phi_R E_RR^-1/2, W G^-1/2
  mutable Vector gain_, loss_;  // work space
};

/// The inverse under other constraints: the base itself where they are the same in the same order, else UpdatedInverse::make(), with its
/// null. Local. \param rows  number of the base's constraints;  \param from, constraints  as there
std::shared_ptr<const LocalInverse> inverseUnder(const std::shared_ptr<const LocalInverse>& base, int rows, const std::vector<int>& from,
                                                 const Matrix& constraints);

}  // namespace suture
