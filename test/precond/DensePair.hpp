#pragma once
#include <interface/DenseSpace.hpp>
#include <support/Blocks.hpp>
#include <suture/precond/Preconditioner.hpp>

namespace suture::blocks {

/// S and M^-1 as dense matrices on the unknowns that are not idle; the same on any number of ranks.
struct DensePair {
  Matrix s, m;
  /// Collective.
  DensePair(const InterfaceOperator& matrix, const Preconditioner& preconditioner);
  double idle;  ///< factor of M^-1 on idle unknowns

  /// Eigenvalues of M^-1 S, ascending: those of L^T M^-1 L, S = L L^T.
  Vector eigenvalues() const;
};

}  // namespace suture::blocks
