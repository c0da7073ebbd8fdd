#pragma once
#include <suture/quality/Findings.hpp>
#include <suture/quality/PairResult.hpp>

#include <vector>

namespace suture {

/// One end of a pair, at the rank that counts its node. Plain.
struct PairEndShare {
  int pair, end, body;
  double closing;    ///< weight x normal . u [length]
  double moved;      ///< |weight| x |u| [length]
  double lifted;     ///< |weight| x the rigid motion that was taken out [length]
  double weight;     ///< weight of the end in the pair
  double stiffness;  ///< stiffness of the node, over all its subdomains [force / length]
  double rounding;   ///< rounding of the node's internal force [force]
  double gap;        ///< initial [length]
  Point place;       ///< ContactPair::position
  Point normal;
  Point shift;    ///< weight x displacement, whole where the law restricts sliding, less what the pair had slid before, else zero [length]
  PairKind kind;  ///< effects of the pair's law
  Point jump;     ///< weight x displacement, the rigid motion that was taken out included [length]
  Point arm;      ///< weight x place of the node [length]
  double cell;    ///< longest edge along the sides of the elements at the node [length]
};

/// Measures bodies by ForceScale: idle ones by a part of their neighbours' force, too. On rank 0.
/// \param now  what acts on each body;  \param past  the largest of it on the path of load steps before, or empty
void scaleForces(const std::vector<PairEndShare>& ends, const std::vector<BodyForces>& now, const std::vector<BodyForces>& past,
                 std::vector<BodyScale>& bodies);

/// Penetration, tension, complementarity, status, friction, slip and dissipation of all pairs: gaps and slips from the ends alone, and as
/// forces, by the stiffness of the nodes that meet. On rank 0. \param ends  of all ranks;  \param pairs  what the run says;  \param
/// tolerance of the answer
void verifyPairs(std::vector<PairEndShare> ends, const std::vector<PairResult>& pairs, const std::vector<BodyScale>& bodies,
                 double tolerance, Findings& findings);

}  // namespace suture
