#pragma once

namespace suture {

/// Cost of sparse and dense algebra of one subdomain, in plane problems and in space. Asked by the choice of Schur complements and local
/// inverses, the memory of groups and of Monolithic, the number of subdomains, and the balance of ranks. (The memory of a decomposed run
/// is fitted to runs as a whole: MemoryEstimate.)
///
/// Factors: entries and operations of CHOLMOD's on square and cubic grids of elements of displacements (ordering AMD in the plane, METIS in
/// space), within a third from 900 unknowns on (test algebra.CostModel):
///
///     plane   4.5 n log2 n entries,   55 n^1.5 operations        space   15.5 n^(4/3) entries,   17.5 n^2 operations
///
/// Rates are those of a core among others that work: they decide between forms whose costs differ by factors. Local.
class CostModel {
 public:
  explicit CostModel(int dimension) : dimension_(dimension) {}

  /// Nonzeros of the Cholesky factor of n unknowns.
  double factorEntries(double unknowns) const;
  /// Operations that make it.
  double factorFlops(double unknowns) const;
  /// Seconds of a forward and a backward substitution, one right-hand side.
  double solveSeconds(double unknowns) const;
  /// Seconds that make a dense matrix of b boundary unknowns from an elimination that stops there, beyond that of the interior.
  double denseSeconds(double boundary) const;
  /// Bytes of a packed symmetric matrix, and the seconds of a product with it.
  double denseBytes(double boundary) const;
  double productSeconds(double boundary) const;

  /// Memory while a matrix of n unknowns is factored, by the bytes that an entry of the factor costs in all (its own 8, index, room that
  /// CHOLMOD needs meanwhile; measured for each user). [bytes]
  double factorBytes(double unknowns, double anEntry) const { return anEntry * factorEntries(unknowns); }

  /// Work on a subdomain from assembly to solution, in nodes; what ranks are balanced by. All that is done with the b interface nodes at
  /// once grows with b^2 or b^3: b^2 / 16 fits the times of the 268 subdomains of tunnel and Hertz at 1M unknowns (3600 nodes, 120 to 340
  /// on the interface; single times scatter by 15 %, whole halves of a scene differ by a tenth). In space boundaries stay sparse, and the
  /// operations of a factor grow with the square of the nodes, which at some 500 are half of the time.
  long long work(long long nodes, long long interfaceNodes) const {
    return dimension_ == 2 ? nodes + interfaceNodes * interfaceNodes / 16 : nodes + nodes * nodes / 500;
  }

  /// Elements of a subdomain for which a plane scene takes the least time: the tunnel at 1M unknowns, two ranks, is as fast with 64 to 160
  /// subdomains, a seventh slower with 256, a quarter with 512.
  static constexpr int kElements = 7200;
  /// Nodes of a subdomain for which a scene in space takes the least time.
  static constexpr int kNodesInSpace = 700;

  static constexpr double kFactorRate = 3e9;  ///< operations a second of a sparse factorisation

 private:
  int dimension_;
};

}  // namespace suture
