#pragma once
#include <suture/answer/verdict/Deformation.hpp>
#include <suture/answer/verdict/Verify.hpp>
#include <suture/answer/verdict/VerifyPairs.hpp>

#include <vector>

namespace suture {

/// Per node that is an end of a contact pair: the longest edge of the adjacent elements, projected along the pair's normal. Empty without
/// pairs. Local. [length]
std::vector<double> edgesAlongContact(const SubdomainMesh& mesh);

/// Best-fit rigid motions of the bodies, including the motions that were taken out of the scene. Equals `beside` in scenes without pairs or
/// lift. Collective. \param beside  without the motions that were taken out
std::vector<Deformation> wholeMotions(const Comm& comm, const Answer& answer, const std::vector<Deformation>& beside);

/// Input for the check that contact forces act at the deformed positions of the bodies.
struct ContactPlaces {
  std::vector<PairEndShare> ends;  ///< ends of all ranks
  const std::vector<PairResult>& pairs;
  const std::vector<ContactPiece>& pieces;
  const std::vector<BodyScale>& bodies;
  const std::vector<Deformation>& motions;  ///< wholeMotions()
  double bound;                             ///< fraction of the bodies' forces up to which a pair counts as carrying none
};

/// Contact forces act between the nodes that face each other in the undeformed mesh; checks that this is still justified. On rank 0.
///
/// `slide`: relative tangential displacement of the sides of a pair that carries a force, in elements of the finer side; and how far a body
/// that rotates on a curved side has rolled: rotation, minus what its deformation explains, times the radius of the side, at most its
/// distance from the body's centre. An open pair counts if the curvature of the sides would close its gap on the way. An obstacle is
/// infinite along directions that are tangential to it everywhere. If a pair is farther from the ends of its contact than it slides, and
/// the sides hardly turn on the way, a slide only shifts the points where forces act: it then counts relative to a twentieth of the smaller
/// body's extent, if that is larger than an element.
///
/// `offset`: moment of contact forces that act across a permanent gap (of sides that are tied in place, or whose gap is given by the
/// scene), summed over the pairs between two bodies, relative to force times extent of the smaller body.
void verifyPlaces(ContactPlaces places, Findings& findings);

}  // namespace suture
