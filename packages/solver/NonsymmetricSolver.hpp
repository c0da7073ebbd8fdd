#pragma once
#include <suture/solver/InnerSolver.hpp>

namespace suture {

/// x <- approximation of A^-1 b, from x = 0, by GMRES (Belos) in the norm of the preconditioner: it makes sqrt(r.M r), the stopping norm,
/// as small as any combination of its iterates can. For the tangents of Coulomb friction, with the symmetric preconditioner of the operator
/// without it. Without restart below kRestart iterations. Collective.
/// \param most  iterations at most;  \param reference  norm that the tolerance refers to; 0: that of b
/// \throws NumericalError  breakdown
InnerResult solveNonsymmetric(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                              const MultiVector& b, MultiVector& x, double tolerance, double reference, int most);

}  // namespace suture
