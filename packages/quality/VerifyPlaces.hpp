#pragma once
#include <suture/quality/Deformation.hpp>
#include <suture/quality/Verify.hpp>
#include <suture/quality/VerifyPairs.hpp>

#include <vector>

namespace suture {

/// By node, where it is an end of a contact pair: the longest edge of the elements there, seen along the pair's normal. Empty without
/// pairs. Local. [length]
std::vector<double> edgesAlongContact(const SubdomainMesh& mesh);

/// Best rigid motions of the bodies, those that were taken out of the scene included. The same as `beside` in scenes without pairs or lift.
/// Collective. \param beside  without what was taken out
std::vector<Deformation> wholeMotions(const Comm& comm, const Answer& answer, const std::vector<Deformation>& beside);

/// What is needed to see whether contact forces act where the bodies are.
struct ContactPlaces {
  std::vector<PairEndShare> ends;  ///< of all ranks
  const std::vector<PairResult>& pairs;
  const std::vector<ContactPiece>& pieces;
  const std::vector<BodyScale>& bodies;
  const std::vector<Deformation>& motions;  ///< wholeMotions()
  double bound;                             ///< part of the bodies' forces up to which a pair carries none
};

/// Contact forces act between the nodes that face each other in the mesh. On rank 0.
///
/// `slide`: how far the sides of a pair that carries a force have moved along each other, in elements of the finer side; and how far a
/// body that turns on a curved side has rolled: turn, less what its deformation explains, times the radius of the side, at most its
/// distance from the body's centre. Of an open pair, where the curvature of the sides would close its gap on the way. An obstacle is
/// endless along directions that are tangential to it everywhere. Where a pair is farther from the ends of its contact than it slides, and
/// the sides hardly turn on the way, a slide moves places of forces and nothing else: it counts relative to a twentieth of the smaller
/// body, where that is more than an element.
///
/// `offset`: the moment of contact forces that act across a gap that stays (of sides that are glued as they stand, or whose gap the scene
/// gives), summed over the pairs between two bodies, by force times extent of the smaller.
void verifyPlaces(ContactPlaces places, Findings& findings);

}  // namespace suture
