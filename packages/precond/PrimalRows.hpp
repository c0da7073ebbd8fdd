#pragma once
#include <suture/precond/PrimalConstraints.hpp>

#include <Eigen/SparseCore>
#include <vector>

namespace suture {

/// The primal constraints of one local problem in BDDC: rows C_i on its trace, and the value of each row in primal unknowns, which
/// neighbours share. A row selects an unknown that is primal alone, or combines unknowns of an entity.
struct PrimalRows {
  struct Term {
    GlobalId key;  ///< unique key of a primal unknown, the same on all ranks
    double coefficient;
  };
  /// Sparse: most rows touch only one entity.
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  Rows rows;                                       ///< constraints x trace
  std::vector<std::vector<Term>> terms;            ///< per row: C_i x = sum of coefficients times primal unknowns
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< unknowns in the terms, ascending by key, and how they move; only on request
};

/// For each row of `now`, the identical row of `old`, or -1.
std::vector<int> rowsIn(const PrimalRows::Rows& old, const PrimalRows::Rows& now);

class MortarRows;

/// Primal constraints of each local problem of this rank. Local.
/// \param withUnknowns  also fill `unknowns`, for a further level
/// \param mortar        constraints across the mortars of a broken space; null: none
std::vector<PrimalRows> primalRows(const InterfaceSpace& space, const PrimalChoice& choice, bool withUnknowns,
                                   const MortarRows* mortar = nullptr);

/// Key of an unknown that is primal alone.
GlobalId aloneKey(const InterfaceSpace& space, int place);
/// A combination of unknowns as a primal unknown, with its motion about their centre. \param coefficients  one row
InterfaceLayout::Unknown combinedUnknown(const InterfaceSpace& space, GlobalId key, const std::vector<int>& places,
                                         const Matrix& coefficients);

}  // namespace suture
