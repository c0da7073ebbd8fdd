#pragma once
#include <suture/condensed/ContactGroup.hpp>
#include <suture/interface/PairForces.hpp>

namespace suture {

/// Forces and displacements of the pairs in a group's response. \param moved  contribution of rigid motions to the rows; empty: none
std::vector<PairForces> pairForces(const ContactGroup& group, const ContactGroup::Response& response, const Vector& moved);

/// Stiffness of each row: both sides' own elements in series; zero if the row cannot change. [force / length]
Vector rowStiffness(const ContactGroup& group);

}  // namespace suture
