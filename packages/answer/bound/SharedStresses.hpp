#pragma once
#include <suture/answer/bound/BoundedField.hpp>
#include <suture/answer/bound/SplitSide.hpp>

#include <array>
#include <vector>

namespace suture {

/// Stresses on the sides with four vertices in 3D: the mean of both cells, the same in both, also of other subdomains; that of the cell at
/// the boundary. The forces of a cell on its nodes become those of its tetrahedra with it.
class SharedStresses {
 public:
  /// Collective.
  SharedStresses(const Comm& comm, const BoundedSolution& solution, const BoundKind& kind);

  /// About the mean of the side's vertices. Local. \param m  subdomain of this rank
  const LinearStress& at(int m, int element, int side) const {
    return sides_[numbers_[m][std::size_t(element) * kMostSides + side]].stress;
  }
  /// True if both cells have the same material.
  bool isOneMaterial(int m, int element, int side) const {
    return sides_[numbers_[m][std::size_t(element) * kMostSides + side]].isOneMaterial;
  }

 private:
  static constexpr int kMostSides = 6;
  using Key = std::array<GlobalId, 4>;  // vertices, ascending
  struct OfSide {
    Key key;
    LinearStress stress;
    double material = 0.0;  // a number that differs between materials
    bool isOneMaterial = true;
  };
  static void join(OfSide& one, const LinearStress& stress, double material);
  void joinHere();
  void exchange(const Comm& comm, const BoundedSolution& solution);

  std::vector<std::vector<int>> numbers_;  // sides of each element of each subdomain; -1: a triangle
  std::vector<OfSide> sides_;
};

}  // namespace suture
