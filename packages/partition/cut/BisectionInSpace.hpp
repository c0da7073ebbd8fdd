#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <functional>
#include <vector>

namespace suture {

/// Cuts a graph in two; true: the second half. \param share  fraction of the elements for the first half
using Bisection = std::function<std::vector<char>(const ElementGraph& graph, double share)>;

/// Cuts a graph with centres into `parts` of about equal size by recursive bisection, each time by the given bisection or by a plane,
/// whichever cuts fewer sides. Planes are normal to the axes, the principal axes, and the lines of a mesh of hexahedra. In structured
/// meshes such planes lie between layers of elements, and the parts are bricks: they have fewer faces, edges and vertices than ragged
/// parts, hence fewer primal unknowns. Parts need not be connected. Local.
std::vector<int> bisectInSpace(const ElementGraph& graph, int parts, const Bisection& bisection);

}  // namespace suture
