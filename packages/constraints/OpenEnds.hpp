#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/pairing/ContactSurface.hpp>

#include <vector>

namespace suture {

/// Sets the pieces' openEnds: pairs at the rim of their contact, beyond which the boundaries of the bodies go on free and without a corner.
/// Bodies that are closed up to there may touch beyond, where the scene knows no contact. A pair counts if each face whose rim it is on
/// goes on so; free is a side in no contact and no condition. Local (rank 0).
void findOpenEnds(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactSurface>& contacts,
                  Constraints& constraints);

}  // namespace suture
