#pragma once
#include <suture/precond/Weighting.hpp>

#include <vector>

namespace suture {

/// Deluxe weights (Dohrmann and Widlund, 2013): on every vertex, edge and face D_i = (sum_j S_j)^-1 S_i with the blocks of the sharers'
/// Schur complements there, a dense matrix, for any number of sharers. Elsewhere (ends of edges, unknowns that relations join in points) by
/// the diagonal of the stiffness matrix. Robust for jumps within the entity that all sharers see. Cost: S_i as a matrix, a factorisation
/// and a product for each sharer of each entity.
class DeluxeWeighting : public StiffnessDiagonalWeighting {
 protected:
  void doSetup(const InterfaceSpace& space, const LocalProblems& locals) override;
  void doApply(int i, LocalView trace) const override;
  void doApplyTranspose(int i, LocalView flux) const override;

 private:
  struct Block {
    std::vector<int> rows;
    Matrix weights;
  };
  std::vector<std::vector<Block>> blocks_;  // blocks of each local problem
};

}  // namespace suture
