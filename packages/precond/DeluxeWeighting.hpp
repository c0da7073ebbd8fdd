#pragma once
#include <suture/precond/Weighting.hpp>

#include <vector>

namespace suture {

/// Deluxe weights (Dohrmann and Widlund, 2013): on every vertex, edge and face D_i = (sum_j S_j)^-1 S_i, a dense matrix made of the blocks
/// of the sharers' Schur complements there, for any number of sharers. All other unknowns (ends of edges, unknowns joined in points by
/// relations) are weighted by the diagonal of the stiffness. Robust for jumps within an entity that all sharers see. Cost: S_i as a matrix,
/// and a factorisation and a product per sharer of each entity.
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
