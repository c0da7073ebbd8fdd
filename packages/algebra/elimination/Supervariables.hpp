#pragma once
#include <suture/algebra/SparseMatrix.hpp>

#include <vector>

namespace suture {

/// Groups of consecutive unknowns with the same pattern, such as those of one node: a fill-reducing ordering of the groups gives one of the
/// unknowns (indistinguishable nodes, supervariables: George, Liu, "The evolution of the minimum degree ordering algorithm", SIAM Review
/// 31, 1989).
/// Local.
class Supervariables {
 public:
  /// \param matrix  square, compressed, rows ascending; only the lower triangle is read
  /// \param size    number of unknowns, from the first on, that are grouped; the others are left out
  Supervariables(const SparseMatrix& matrix, int size);

  int count() const { return static_cast<int>(first_.size()) - 1; }
  /// Lower triangle of the pattern between groups.
  SparseMatrix graph(const SparseMatrix& matrix) const;
  /// The order of the unknowns given by an order of the groups. \param order  position -> group; \param to  position -> unknown, of size
  /// `size`
  void expand(const std::vector<int>& order, int* to) const;

 private:
  int size_;
  std::vector<int> first_;    // first unknown of each group, and the end
  std::vector<int> groupOf_;  // group of each unknown
};

/// The lower triangle of a symmetric matrix in another order. \param matrix  its lower triangle is read; \param order  position -> unknown
SparseMatrix permutedLower(const SparseMatrix& matrix, const std::vector<int>& order);

}  // namespace suture
