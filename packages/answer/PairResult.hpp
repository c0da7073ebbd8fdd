#pragma once
#include <suture/base/Point.hpp>
#include <suture/pairs/ContactPiece.hpp>
#include <suture/pairs/PairForce.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <array>
#include <vector>

namespace suture {

/// Fraction of a pair's weights up to which their sum counts as zero up to round-off, as in takeOutRigidMotions().
constexpr double kBalanced = 1e-12;

/// Properties of a pair's law, independent of the pair's state.
struct PairKind {
  bool separates = true;          ///< ContactLaw::separates
  bool restrictsSliding = false;  ///< ContactRow::restrictsSliding

  PairKind() = default;
  explicit PairKind(const ContactRow& row) : separates(row.separates), restrictsSliding(row.restrictsSliding()) {}
  PairKind(const ContactLaw& law, int dimension) : separates(law.separates()), restrictsSliding(law.rows(dimension) > 1) {}
};

/// State of a contact pair at the end of a run: gap > 0 open, pressure and force > 0 compressive.
struct PairResult {
  int id = -1;
  GlobalId node = -1;  ///< carrying node, on a coating the node under it: number in the mesh
  int line = -1;
  int piece = -1;
  std::array<int, 2> bodies{{-1, -1}};  ///< bodies of sides A and B; -1: a rigid obstacle
  ContactState state;                   ///< as determined by the law of its contact
  bool touching = false;                ///< open with zero gap
  double initialGap = 0.0;              ///< [length]
  double gap = 0.0;                     ///< initial gap - (u_A - u_B).n [length]
  double force = 0.0;                   ///< along the normal, on B; per unit thickness in 2D, of the whole circle if axisymmetric [force]
  double pressure = 0.0;                ///< force / tributary length (axisymmetric: area) [stress]
  double length = 0.0;                  ///< tributary length, axisymmetric: area [length or area]
  double arc = 0.0;                     ///< arc length along the line [length]
  Point position{0, 0, 0};              ///< point where its force acts, undeformed
  Point displacement{0, 0, 0};          ///< displacement of the carrying node
  double shortening = 0.0;              ///< shortening of a softened contact's coating along the normal [length]
  Point normal{0, 0, 0};
  PairKind kind;
  Point tangential{0, 0, 0};  ///< tangential force on B [force]
  Point slip{0, 0, 0};        ///< tangential part of u_A - u_B [length]
  ContactPair::Past past;     ///< at the beginning of the load step
  double bound = 0.0;         ///< largest tangential force of the state; 0 if the law has no limit [force]
  double dissipated = 0.0;    ///< work of the tangential force during sliding, over all load steps [energy]

  /// Slip of the load step.
  Point stepSlip() const { return minus(slip, past.slip); }
  /// The whole contact force on B.
  Point onB() const { return plus(scaled(force, normal), tangential); }
  /// True if a bound limits the tangential force of the pair in its current state.
  bool isBounded() const { return kind.restrictsSliding && state.closed() && (kind.separates || state.status == PairStatus::Slip); }
  /// Opens the pair and clears its forces.
  void open();
};

/// The only function that creates a PairResult. Local. \param ofEnds  displacement of each of the pair's ends, in their order
/// \param ofLift  rigid motion of each end that was taken out of `ofEnds` and the gap; empty: none
PairResult pairResult(const ContactPair& pair, const PairForce& force, const std::vector<Point>& ofEnds, const PairKind& kind = {},
                      const std::vector<Point>& ofLift = {});

/// Jump u_A - u_B of a pair along its sides. Zero if both sides move alike, although the weights of a mortar sum to zero only up to
/// round-off.
Point slipOf(const ContactPair& pair, const std::vector<Point>& ofEnds);

/// The pair of each of `now` at an earlier time: of the same contact and node, since bodies that move far have other pairs in every step;
/// null: a new one. Local, on rank 0.
std::vector<const PairResult*> predecessors(const std::vector<PairResult>& before, const std::vector<PairResult>& now);

/// Results at points on the axis of revolution, which carry no force: pressure and gap follow from the nearest pairs, the state is that of
/// the nearest pair. Local, on rank 0. \param pairs  all, by id
std::vector<PairResult> axisResults(const std::vector<ContactPiece>& pieces, const std::vector<PairResult>& pairs);

/// All pairs on rank 0, by id. Collective.
/// \param displacement  of each mesh of this rank, without its lift, node-major, Cartesian
/// \param forces  of this rank; each pair on one rank
/// \throws InternalError  for a pair without force, or a force without pair
std::vector<PairResult> pairResults(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes,
                                    const std::vector<Vector>& displacement, const std::vector<PairForce>& forces);

}  // namespace suture
