#pragma once
#include <suture/partition/SubdomainMesh.hpp>

namespace suture {

/// Rotation of a subdomain from the drawn body, which fits its nodes best: dimension x dimension. The identity, exactly, for bodies that do
/// not move far and for rotations that are round-off. Local.
Matrix turnFromDrawn(const SubdomainMesh& mesh);

}  // namespace suture
