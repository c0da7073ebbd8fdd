#pragma once
#include <suture/contact/ContactGroup.hpp>
#include <suture/interface/PairForces.hpp>

namespace suture {

/// The pairs of a group at its answer. \param moved  addition of rigid motions to the rows; empty: none
std::vector<PairForces> pairForces(const ContactGroup& group, const ContactGroup::Response& response, const Vector& moved);

/// Stiffness of each row: of both sides' own elements in series; zero for one that cannot change. [force / length]
Vector rowStiffness(const ContactGroup& group);

}  // namespace suture
