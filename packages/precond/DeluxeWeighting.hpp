#pragma once
#include <suture/precond/EdgeSides.hpp>
#include <suture/precond/Weighting.hpp>

#include <vector>

namespace suture {

/// Deluxe weights (Dohrmann and Widlund, 2013): on an edge of two local problems D_i = (S_1 + S_2)^-1 S_i with the blocks of their Schur
/// complements there, a dense matrix; elsewhere by the diagonal of the stiffness matrix. Robust for jumps within the edge that both sides
/// see. Cost: S_i as a matrix, a factorisation and two products for each edge.
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
