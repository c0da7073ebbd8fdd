#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <vector>

namespace suture {

/// Sets the pieces' openEnds: pairs at the rim of their contact, beyond which the boundaries of the bodies continue free and without a
/// corner. Bodies that are closed up to the rim may touch beyond it, where the scene defines no contact. A pair counts if every face whose
/// rim it is on continues like this; a side is free if it is in no contact and no condition. Local (rank 0).
void findOpenEnds(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<ContactSurface>& contacts,
                  Constraints& constraints);

}  // namespace suture
