#pragma once
#include <support/Blocks.hpp>
#include <suture/answer/PairResult.hpp>
#include <suture/interface/InterfaceProblem.hpp>

namespace suture::blocks {

/// Displacements of a formulation's result, Cartesian, of each subdomain of this rank.
std::vector<Vector> displacements(const Blocks& all, const InterfaceProblem::Recovered& found);

/// All pairs of a formulation's result, on rank 0. Collective.
std::vector<PairResult> pairsOf(const Blocks& all, const InterfaceProblem::Recovered& found);

}  // namespace suture::blocks
