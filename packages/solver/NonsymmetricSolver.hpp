#pragma once
#include <suture/solver/InnerSolver.hpp>

namespace suture {

/// x <- approximation of A^-1 b, from x = 0, by GMRES (Belos) in the norm of the preconditioner: it minimises the stopping norm sqrt(r.M^-1
/// r) over the Krylov space. Used for the tangents of Coulomb friction, with the symmetric preconditioner of the frictionless operator.
/// Restarts after kRestart iterations. Collective.
/// \param most  maximum number of iterations;  \param reference  reference norm of the tolerance; 0: that of b
/// \throws NumericalError  breakdown
InnerResult solveNonsymmetric(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                              const MultiVector& b, MultiVector& x, double tolerance, double reference, int most);

}  // namespace suture
