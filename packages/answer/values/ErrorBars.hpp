#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/base/Types.hpp>
#include <suture/pairs/ContactPiece.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Estimated errors of forces, from the error of the displacements in the energy norm; which extremes have no finite exact value.
///
/// The force of a support or contact is a functional Q of the solution u. With its dual solution z, the displacements if the support moves
/// by one unit (a contact: its sides move apart by one unit),
///   |Q(u) - Q(u_h)| <= |u - u_h| |z - z_h|  in energy norms.
/// If both errors have the same relative size r, the error of the force is r^2 times a force. Example: one prescribed displacement d and
/// linear contact, J = F d / 2; J_h - J = |u - u_h|^2 / 2 gives F_h - F = r^2 F.
///
/// Forces share nodes if two conditions hold a common direction at a node, or a support holds a contact node along its normal. How much of
/// the force at such a node each of the two has depends on a stress that can be unbounded there: z has infinite energy, and the error is of
/// first order, r times a force.
///
/// On curved contacts the mesh changes the normals, hence the directions of contact forces, by a part of the angle by which an element
/// turns: the energy norm does not measure this error.
///
/// The algebraic error is of first order in both cases: the computed displacements are not Galerkin-orthogonal to z.
struct ErrorBars {
  double discretisation = 0.0;                        ///< r, relative to the energy norm of the solution
  double algebraic = 0.0;                             ///< likewise
  double turning = 0.0;                               ///< largestTurning() of the contacts [radians], on rank 0
  std::vector<int> sharedConditions, sharedContacts;  ///< numbers of those whose forces share nodes with others, ascending
  /// Extremes whose exact value is unbounded, with the reason: see singularExtremes().
  std::map<std::string, std::string> singular{};

  /// Estimated error (norm of the force vector) of the force of a condition or contact. On rank 0. \param largest  largest
  /// resultant of all conditions and contacts [force]
  double ofCondition(int condition, double largest) const;
  double ofContact(int contact, double largest) const;
  /// Estimated error of a mean displacement. \param largest  largest displacement [length]
  double ofDisplacement(double largest) const { return bar(false, largest); }

  /// True if the error of the force is of first order in the error of the displacements, else of second order.
  bool isLinear(bool isContact, int number) const;

  /// Factors measured in random scenes in 2D (test/drivers/force_bars.py) against meshes four times finer, r from recovered stresses
  /// (ErrorEstimate), F the largest resultant: 95 % of the errors were below 1.7 r^2 F and 0.5 r F, the largest 2.7 and 0.9; cylinders on
  /// planes had up to 0.4 turning F.
  static constexpr double kSquare = 2.0, kLinear = 1.0, kTurning = 0.5;

 private:
  double bar(bool shares, double largest) const;
};

/// The largest angle between the normals of two pairs of a cell (an element's side) with a closed pair: zero for plane contacts. Local, on
/// rank 0. [radians]
double largestTurning(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs);

/// Fills sharedConditions and sharedContacts. The same on all ranks. Collective.
void findSharedNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, ErrorBars& bars);

}  // namespace suture
