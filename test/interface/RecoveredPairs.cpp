#include <interface/RecoveredPairs.hpp>

namespace suture::blocks {

std::vector<Vector> displacements(const Blocks& all, const InterfaceProblem::Recovered& found) {
  std::vector<Vector> result;
  for (std::size_t i = 0; i < all.subdomains.size(); ++i) result.push_back(all.subdomains[i]->cartesian(found.freeValues[i]));
  return result;
}

std::vector<PairResult> pairsOf(const Blocks& all, const InterfaceProblem::Recovered& found) {
  std::vector<const SubdomainMesh*> meshes;
  for (std::size_t i = 0; i < all.subdomains.size(); ++i) meshes.push_back(&all.meshes[i]);
  return pairResults(*world(), meshes, displacements(all, found), found.pairs);
}

}  // namespace suture::blocks
