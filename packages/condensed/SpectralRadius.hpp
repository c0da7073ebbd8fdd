#pragma once
#include <suture/interface/InterfaceOperator.hpp>

#include <functional>

namespace suture {

/// Largest eigenvalue of A^-1 B for symmetric A > 0, B >= 0, by Lanczos' method in the A inner product with full reorthogonalisation, until
/// it changes by less than `relative` twice in succession. Collective. \param solveA  x <- A^-1 b;  \param start  any vector with a
/// component along the eigenvector; not changed
double largestEigenvalue(const Operator& b, const std::function<void(const MultiVector&, MultiVector&)>& solveA, const MultiVector& start,
                         double relative = 1e-3, int most = 60);

/// Why S_0 (an operator with null entries) is singular, or "" if it is regular: unknowns that belong to none of its local problems, or
/// motions of subdomains that only contact groups restrain. Collective.
std::string whySingular(const InterfaceOperator& withoutContact);

}  // namespace suture
