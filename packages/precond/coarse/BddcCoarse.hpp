#pragma once
#include <suture/algebra/LocalInverse.hpp>
#include <suture/precond/PrimalRows.hpp>
#include <suture/precond/coarse/CoarseOptions.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Coarse problem of BDDC: numbers the primal unknowns over all ranks, holds the map A_i from them to the constraint values of each local
/// problem of this rank, and solves with the sum of A_i^T Phi_i^T S_i Phi_i A_i.
class BddcCoarse {
 public:
  /// Inverse of each local problem of this rank under its constraints; null for a null local problem.
  using Inverses = std::vector<const LocalInverse*>;

  /// \param ids          id of each local problem of this rank
  /// \param constraints  of each local problem; only their terms and unknowns are read
  /// \param locals       local problems of all ranks
  /// Collective. \throws NumericalError  if the coarse matrix is not positive definite
  BddcCoarse(const CommPtr& comm, int dimension, const std::vector<int>& ids, const Inverses& inverses, std::vector<PrimalRows> constraints,
             int locals, CoarseOptions levels);

  /// Primal unknowns: over all ranks, and those of this rank's local problems.
  int size() const { return solver_->size(); }
  int sizeHere() const { return static_cast<int>(names_.size()); }
  /// True if rows of several terms rule out a further level that the number of local problems calls for.
  bool isExactInstead() const { return exactInstead_; }
  /// As CoarseSolve::remark().
  std::string remark() const { return solver_->remark(); }
  /// True if a solve reproduces a given vector; false if the factorisation accepted a pivot that is only round-off. A coarse problem with
  /// several levels reports this itself. Collective. \param inverses  as given to the constructor
  bool isRegular(const Inverses& inverses) const;

  /// primal <- primal + A_i^T values. Local.
  void addToPrimal(std::size_t i, const Vector& values, Vector& primal) const {
    for (const Value& value : valuesOf(i)) primal(value.place) += value.coefficient * values(value.row);
  }
  /// values <- values + A_i primal. Local.
  void addToValues(std::size_t i, const Vector& primal, Vector& values) const {
    for (const Value& value : valuesOf(i)) values(value.row) += value.coefficient * primal(value.place);
  }
  /// Primal unknowns of this rank for the sum of `primal` over the ranks, valid until the next call. Collective.
  const Vector& solve(const Vector& primal) const { return solver_->solve(primal); }

 private:
  // An entry of A_i.
  struct Value {
    int row;    // constraint of the local problem
    int place;  // position of the primal unknown in names_
    double coefficient;
  };
  Span<const Value> valuesOf(std::size_t i) const { return {values_.data() + valuesFrom_[i], valuesFrom_[i + 1] - valuesFrom_[i]}; }
  bool number(const std::vector<int>& ids, const Inverses& inverses, std::vector<PrimalRows> constraints, CoarseElements& coarse);
  CoarseElement element(std::size_t i, const Matrix& energy) const;

  CommPtr comm_;
  std::vector<int> names_;               // primal unknowns of this rank's local problems, as in CoarseSolve::solve
  std::vector<Value> values_;            // A_i of all local problems, one after the other
  std::vector<std::size_t> valuesFrom_;  // where the entries of each local problem begin
  std::unique_ptr<CoarseSolve> solver_;
  bool exactInstead_ = false;
};

}  // namespace suture
