#pragma once
#include <suture/quality/Findings.hpp>
#include <suture/quality/SeamExchange.hpp>
#include <suture/quality/Verify.hpp>

namespace suture {

/// Judges what was taken out of a scene (SubdomainMesh::lift): that it is a rigid motion, the same on both sides of seams, and that it and
/// what remains make up the prescribed values and gaps of before. Found as `prescribed`. Collective; costs nothing without a lift.
void verifyLift(const Comm& comm, const Answer& answer, const SeamExchange& seams, Findings& findings);

}  // namespace suture
