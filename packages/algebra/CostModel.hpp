#pragma once

namespace suture {

/// Cost of sparse and dense algebra of one subdomain, in 2D and 3D. Used for the choice of Schur complements and local inverses, the memory
/// of groups and of Monolithic, the number of subdomains, and the balance of ranks. (The memory of a decomposed run is fitted to whole
/// runs: MemoryEstimate.)
///
/// Factors: entries and operations of CHOLMOD on square and cubic grids of displacement elements (ordering AMD in 2D, METIS in 3D), within
/// a third from 900 unknowns on (test algebra.CostModel):
///
///     2D   4.5 n log2 n entries,   55 n^1.5 operations        3D   15.5 n^(4/3) entries,   17.5 n^2 operations
///
/// Rates are those of a core while the other cores are busy: they decide between forms whose costs differ by factors. Local.
class CostModel {
 public:
  explicit CostModel(int dimension) : dimension_(dimension) {}

  /// Nonzeros of the Cholesky factor of n unknowns.
  double factorEntries(double unknowns) const;
  /// Operations of this factorisation.
  double factorFlops(double unknowns) const;
  /// Seconds of a forward and a backward substitution, one right-hand side.
  double solveSeconds(double unknowns) const;
  /// Seconds to form a dense matrix of b boundary unknowns by an elimination that stops there, in addition to that of the interior.
  double denseSeconds(double boundary) const;
  /// Bytes of a packed symmetric matrix, and the seconds of a product with it.
  double denseBytes(double boundary) const;
  double productSeconds(double boundary) const;

  /// Memory while a matrix of n unknowns is factored. `anEntry`: bytes per entry of the factor in total (8 for the value, the index,
  /// CHOLMOD's temporary memory; measured for each use). [bytes]
  double factorBytes(double unknowns, double anEntry) const { return anEntry * factorEntries(unknowns); }

  /// Work on a subdomain from assembly to solution, in nodes; used to balance the ranks. Dense work on the b interface nodes grows with b^2
  /// or b^3: b^2 / 16 fits the times of the 268 subdomains of tunnel and Hertz at 1M unknowns (3600 nodes, 120 to 340 on the interface;
  /// single times scatter by 15 %, whole halves of a scene differ by a tenth). In 3D boundaries stay sparse, and the operations of a factor
  /// grow with the square of the nodes; at some 500 nodes they are half of the time.
  long long work(long long nodes, long long interfaceNodes) const {
    return dimension_ == 2 ? nodes + interfaceNodes * interfaceNodes / 16 : nodes + nodes * nodes / 500;
  }

  /// Elements of a subdomain for which a 2D scene takes the least time: the tunnel at 1M unknowns, two ranks, is equally fast with 64 to
  /// 160 subdomains, a seventh slower with 256, a quarter with 512.
  static constexpr int kElements = 7200;
  /// Nodes of a subdomain for which a 3D scene takes the least time.
  static constexpr int kNodesInSpace = 700;

  static constexpr double kFactorRate = 3e9;  ///< operations per second of a sparse factorisation

 private:
  int dimension_;
};

}  // namespace suture
