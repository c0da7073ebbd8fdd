#pragma once
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// Order of the error in elements at singular vertices: that of u ~ r^1/2, the strongest singularity of an elastic body.
constexpr double kSingularOrder = 0.5;

/// Singular vertex of each element, or -1: a vertex of triangles whose squared errors are on average more than eight times those in the
/// ring of elements around them. For smooth solutions the ratio is near 1; at u ~ r^a, second-order triangles of one size have r^(2 a - 6).
/// In 3D singular edges prevail, and no vertex counts. Local (rank 0). \param squares  of each element
std::vector<int> singularVertices(const Mesh& mesh, const std::vector<double>& squares);

}  // namespace suture
