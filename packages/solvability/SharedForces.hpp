#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace suture {

/// One amplitude of a contact force and the nodal forces that a unit of it causes, in free unknowns.
struct ForceColumn {
  int pair = -1;
  std::vector<std::pair<GlobalId, double>> entries;
};

/// Amplitudes that equilibrium does not determine: any combination of `basis` may be added, and no nodal force changes.
struct SharedForces {
  std::vector<int> columns;  ///< places in the list of columns, ascending
  Matrix basis;              ///< columns.size() x dimension; orthonormal
};

/// The null space of the nodal forces, in parts that have no pair in common: by a sparse QR decomposition that finds the rank. A column
/// counts as dependent where less than 1e-10 of the largest column is left of it. Local.
std::vector<SharedForces> sharedForces(const std::vector<ForceColumn>& columns);

/// A half space of amplitudes that a law allows: normal . x >= bound. `columns`: places in SharedForces::columns.
struct ForceCut {
  std::vector<std::pair<int, double>> normal;
  double bound = 0.0;
};

/// The least amplitudes, by the sum of their squares, with the same nodal forces. Laws of contact are convex sets: half spaces that touch
/// them are added where amplitudes violate them, until none does. The given amplitudes are allowed, up to the accuracy of a solver.
/// \param violated  half spaces that leave out the given amplitudes; empty: they are allowed. Local.
Vector leastAmplitudes(const SharedForces& shared, const Vector& amplitudes,
                       const std::function<std::vector<ForceCut>(const Vector& amplitudes)>& violated);

}  // namespace suture
