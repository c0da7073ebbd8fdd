#pragma once
#include <utility>
#include <vector>

namespace suture {

/// A force below this fraction of the largest force that the body has carried is round-off.
constexpr double kRoundedForce = 1e-12;
/// Fraction of its neighbours' force by which errors of an idle body are measured.
constexpr double kLentForce = 1e-3;

/// Magnitudes of what acts on a body, or their maxima over a path of load steps. Plain.
struct BodyForces {
  double loads = 0.0;        ///< sum of the magnitudes of its loads [force]
  double prescribed = 0.0;   ///< largest displacement that is prescribed [length]
  double force = 0.0;        ///< force that passes through it [force]
  double deformation = 0.0;  ///< largest displacement after removal of a rigid motion [length]

  /// Takes the maximum of each member.
  void take(const BodyForces& other);
  /// Upper bound of twice the energy of a body with these forces and displacements. [force length]
  double energy() const { return force * deformation; }
};

/// Force by which errors of a body's forces are measured: in the stopping tests of solvers, in their searches for contact states, and in
/// the verdict.
///
/// It is the force that passes through the body. A body on which only its neighbours act is idle: the error that a solver leaves in the
/// neighbours' forces acts on it, so its scale is at least a fraction of theirs ("lent" force). An idle neighbour whose own force is below
/// its lent force passes the lent force on. Where a path of load steps returns to zero, only round-off of the largest forces remains.
struct ForceScale {
  double force = 0.0;    ///< own or lent [force]
  double lent = 0.0;     ///< part of the neighbours' force [force]
  double rounded = 0.0;  ///< round-off of the forces that it and its neighbours have carried on the path; zero if not idle [force]

  /// \param now  forces per body;  \param past  their maxima over the path so far, or empty;  \param neighbours  bodies joined by contact
  /// pairs
  static std::vector<ForceScale> of(const std::vector<BodyForces>& now, const std::vector<BodyForces>& past,
                                    const std::vector<std::pair<int, int>>& neighbours);
};

/// True for bodies on which only contact acts: loads and prescribed displacements are zero, or round-off of those on the path.
std::vector<char> idleBodies(const std::vector<BodyForces>& now, const std::vector<BodyForces>& past);

/// Largest fraction of a neighbour's value that reaches each idle body: idle neighbours with a smaller own value pass it on.
std::vector<double> lentValues(const std::vector<double>& own, const std::vector<char>& idle, double share,
                               const std::vector<std::pair<int, int>>& neighbours);

}  // namespace suture
