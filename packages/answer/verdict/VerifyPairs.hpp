#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/answer/verdict/Findings.hpp>

#include <vector>

namespace suture {

/// One end of a pair, on the rank that counts its node. Trivially copyable.
struct PairEndShare {
  int pair, end, body;
  double closing;    ///< weight x normal . u [length]
  double moved;      ///< |weight| x |u| [length]
  double lifted;     ///< |weight| x |rigid motion that was taken out| [length]
  double weight;     ///< weight of the end in the pair
  double stiffness;  ///< stiffness of the node, summed over its subdomains [force / length]
  double rounding;   ///< round-off of the node's internal force [force]
  double gap;        ///< initial [length]
  Point place;       ///< ContactPair::position
  Point normal;
  Point shift;    ///< weight x displacement if the law restricts sliding, minus the earlier slip of the pair, else zero [length]
  PairKind kind;  ///< properties of the pair's law
  Point jump;     ///< weight x displacement, including the rigid motion that was taken out [length]
  Point arm;      ///< weight x position of the node [length]
  double cell;    ///< longest edge tangential to the contact, of the elements at the node [length]
};

/// Sets the force scales of bodies by ForceScale: for idle bodies also a fraction of their neighbours' force. On rank 0.
/// \param now  forces on each body;  \param past  largest of these on the previous path of load steps, or empty
void scaleForces(const std::vector<PairEndShare>& ends, const std::vector<BodyForces>& now, const std::vector<BodyForces>& past,
                 std::vector<BodyScale>& bodies);

/// Penetration, tension, complementarity, status, friction, slip and dissipation of all pairs: gaps and slips computed from the ends alone,
/// and converted to forces by the stiffness of the facing nodes. On rank 0. \param ends  of all ranks;  \param pairs  results of the run;
/// \param tolerance  of the solution
void verifyPairs(std::vector<PairEndShare> ends, const std::vector<PairResult>& pairs, const std::vector<BodyScale>& bodies,
                 double tolerance, Findings& findings);

}  // namespace suture
