#pragma once
#include <suture/answer/verdict/Findings.hpp>
#include <suture/answer/verdict/SeamExchange.hpp>
#include <suture/answer/verdict/Verify.hpp>

namespace suture {

/// Verifies what was taken out of a scene (SubdomainMesh::lift): it must be a rigid motion, the same on both sides of seams, and together
/// with the remaining values it must give the original prescribed values and gaps. Reported as `prescribed`. Collective; no cost without a
/// lift.
void verifyLift(const Comm& comm, const Answer& answer, const SeamExchange& seams, Findings& findings);

}  // namespace suture
