#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace suture {

/// One amplitude of a contact force, and the nodal forces on free unknowns per unit amplitude.
struct ForceColumn {
  int pair = -1;
  std::vector<std::pair<GlobalId, double>> entries;
};

/// Amplitudes that equilibrium does not determine: combinations of `basis` change no nodal force.
struct SharedForces {
  std::vector<int> columns;  ///< places in the list of columns, ascending
  Matrix basis;              ///< columns.size() x dimension; orthonormal
};

/// The null space of the nodal forces, split into parts without common pairs, by a rank-revealing sparse QR decomposition. A column is
/// dependent if less than 1e-10 of the largest column remains of it. Local.
std::vector<SharedForces> sharedForces(const std::vector<ForceColumn>& columns);

/// A half space of amplitudes that a law admits: normal . x >= bound. `columns`: places in SharedForces::columns.
struct ForceCut {
  std::vector<std::pair<int, double>> normal;
  double bound = 0.0;
};

/// The least amplitudes (sum of squares) with the same nodal forces. Contact laws are convex sets: half spaces that touch them are added
/// where amplitudes violate them, until none does. The given amplitudes must be admissible up to the accuracy of a solver.
/// \param violated  half spaces that exclude the given amplitudes; empty: the amplitudes are admissible. Local.
Vector leastAmplitudes(const SharedForces& shared, const Vector& amplitudes,
                       const std::function<std::vector<ForceCut>(const Vector& amplitudes)>& violated);

}  // namespace suture
