#pragma once
#include <utility>
#include <vector>

namespace suture {

/// Part of the largest force that a body has carried, below which a force is rounding.
constexpr double kRoundedForce = 1e-12;
/// Part of its neighbours' force by which errors of an idle body are measured.
constexpr double kLentForce = 1e-3;

/// Sizes of what acts on a body; or the largest of each on a path of load steps. Plain.
struct BodyForces {
  double loads = 0.0;        ///< sum of the magnitudes of its loads [force]
  double prescribed = 0.0;   ///< largest displacement that is prescribed [length]
  double force = 0.0;        ///< force that passes through it [force]
  double deformation = 0.0;  ///< largest displacement beside a rigid motion [length]

  /// Becomes the larger one of each.
  void take(const BodyForces& other);
  /// Twice the energy of a body of these forces and displacements, at most. [force length]
  double energy() const { return force * deformation; }
};

/// Force by which errors of a body's forces are measured: in the stopping tests of solvers, in their searches for contact states, and in
/// the verdict.
///
/// It is the force that passes through the body. A body on which nothing acts but its neighbours is idle: what a solver leaves of their
/// forces is an error for it, and so it is measured by a share of these at least. Idle neighbours that carry less than they are lent lend
/// on what they get. Where a path of load steps goes back to zero, rounding of the largest forces on the path is all that is left.
struct ForceScale {
  double force = 0.0;    ///< own or lent [force]
  double lent = 0.0;     ///< part of the neighbours' force [force]
  double rounded = 0.0;  ///< rounding of the forces that it and its neighbours have carried on the path; zero if it is not idle [force]

  /// \param now  of each body;  \param past  the largest of the path before, or empty;  \param neighbours  bodies that contact pairs join
  static std::vector<ForceScale> of(const std::vector<BodyForces>& now, const std::vector<BodyForces>& past,
                                    const std::vector<std::pair<int, int>>& neighbours);
};

/// True of bodies on which nothing acts but contact: loads and prescribed displacements are zero, or rounding of those on the path.
std::vector<char> idleBodies(const std::vector<BodyForces>& now, const std::vector<BodyForces>& past);

/// Largest share of a neighbour's value that reaches each idle body: neighbours that are idle and have less themselves pass it on.
std::vector<double> lentValues(const std::vector<double>& own, const std::vector<char>& idle, double share,
                               const std::vector<std::pair<int, int>>& neighbours);

}  // namespace suture
