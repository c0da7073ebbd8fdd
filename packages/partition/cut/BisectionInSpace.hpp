#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <functional>
#include <vector>

namespace suture {

/// Cuts a graph in two; true: the second half. \param share  of the elements that the first half is to have
using Bisection = std::function<std::vector<char>(const ElementGraph& graph, double share)>;

/// Cuts a graph with centres into `parts` of about equal size by halving it again and again, each time by the given bisection or by a
/// plane, whichever cuts fewer sides. Planes lie across the axes, the principal axes, and the lines of a mesh of hexahedra. Of structured
/// meshes they are layers between elements, and the parts are bricks: fewer faces, edges and vertices than ragged parts have, hence
/// fewer primal unknowns. Parts need not be connected. Local.
std::vector<int> bisectInSpace(const ElementGraph& graph, int parts, const Bisection& bisection);

}  // namespace suture
