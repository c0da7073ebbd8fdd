#pragma once
#include <support/Blocks.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/quality/PairResult.hpp>

namespace suture::blocks {

/// Displacements of a formulation's result, Cartesian, of each subdomain of this rank.
inline std::vector<Vector> displacements(const Blocks& all, const InterfaceProblem::Recovered& found) {
  std::vector<Vector> result;
  for (std::size_t i = 0; i < all.subdomains.size(); ++i) result.push_back(all.subdomains[i]->cartesian(found.freeValues[i]));
  return result;
}

/// All pairs of a formulation's result, on rank 0. Collective.
inline std::vector<PairResult> pairsOf(const Blocks& all, const InterfaceProblem::Recovered& found) {
  std::vector<const SubdomainMesh*> meshes;
  for (std::size_t i = 0; i < all.subdomains.size(); ++i) meshes.push_back(&all.meshes[i]);
  return pairResults(*world(), meshes, displacements(all, found), found.pairs);
}

}  // namespace suture::blocks
