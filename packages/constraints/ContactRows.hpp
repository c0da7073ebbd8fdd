#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/pairs/ContactRow.hpp>

#include <vector>

namespace suture {

struct Mesh;

/// Rows of all pairs, in their order, as many per pair as its law restricts. Cost proportional to nodes and pairs. Local (rank 0).
std::vector<ContactRow> contactRows(const Mesh& mesh, const Constraints& constraints);

}  // namespace suture
