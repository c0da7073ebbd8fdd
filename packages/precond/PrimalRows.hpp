#pragma once
#include <suture/precond/PrimalConstraints.hpp>

#include <Eigen/SparseCore>
#include <vector>

namespace suture {

/// The primal constraints of one local problem in BDDC: rows C_i on its trace, and the value of each row in primal unknowns, which
/// neighbours share. A row picks an unknown that is primal alone, or combines unknowns of an entity.
struct PrimalRows {
  struct Term {
    GlobalId key;  ///< key of a primal unknown: the same on all ranks, each its own
    double coefficient;
  };
  /// By rows: most of them touch one entity of many.
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  Rows rows;                                       ///< constraints x trace
  std::vector<std::vector<Term>> terms;            ///< terms of each row: C_i x = sum of coefficients times primal unknowns
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< those that the terms name, by key, ascending: how they move; if asked for
};

/// For each row of `now`, the row of `old` that is the same, or -1.
std::vector<int> rowsIn(const PrimalRows::Rows& old, const PrimalRows::Rows& now);

class MortarRows;

/// Primal constraints of each local problem of this rank. Local.
/// \param withUnknowns  true: also `unknowns`, for a further level
/// \param mortar        of a torn space, what its two sides have in common; null: nothing
std::vector<PrimalRows> primalRows(const InterfaceSpace& space, const PrimalChoice& choice, bool withUnknowns,
                                   const MortarRows* mortar = nullptr);

/// Key of an unknown that is primal alone.
GlobalId aloneKey(const InterfaceSpace& space, int place);
/// A combination of unknowns as a primal unknown: how it moves about their centre. \param coefficients  one row
InterfaceLayout::Unknown combinedUnknown(const InterfaceSpace& space, GlobalId key, const std::vector<int>& places,
                                         const Matrix& coefficients);

}  // namespace suture
