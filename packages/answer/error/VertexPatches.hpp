#pragma once
#include <suture/base/Types.hpp>
#include <suture/elasticity/ElasticModel.hpp>

#include <vector>

namespace suture {

/// The vertices of a block, one patch per material of the adjacent elements, because stresses may jump between materials. In the order of
/// the elements.
struct VertexPatches {
  struct Patch {
    int node;
    double young, poisson;
    int material;  ///< Material::number
  };
  std::vector<Patch> all;
  std::vector<int> first{0}, ofVertices;  ///< patch of each vertex of each element

  VertexPatches() = default;
  /// Local. A lambda for the materials must declare `-> const Material&`.
  VertexPatches(const CellBlock& block, const std::function<const Material&(int element)>& materialOf);

  int count() const { return static_cast<int>(all.size()); }
  /// Patches of the element's vertices.
  Span<const int> of(int element) const { return {ofVertices.data() + first[element], std::size_t(first[element + 1] - first[element])}; }
};

}  // namespace suture
