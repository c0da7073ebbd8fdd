#pragma once
#include <suture/base/Registry.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Symmetric positive definite approximation of the inverse of an InterfaceOperator, as a Tpetra operator for any Krylov method. Call
/// initialize() with the space, then compute() with the operator. Call compute() again after the operator changed; unchanged local problems
/// (compared by identity) are not set up again. Strategies: BDDC, Neumann-Neumann; Registry<Preconditioner> adds user strategies.
class Preconditioner : public Operator {
 public:
  static const char* kind() { return "preconditioner"; }

  /// Set-up that depends only on the space. Collective.
  void initialize(std::shared_ptr<const InterfaceSpace> space);
  /// Sets up everything that apply() needs. Collective. \throws NumericalError
  void compute(Teuchos::RCP<const InterfaceOperator> matrix);

  Teuchos::RCP<const Map> getDomainMap() const override { return space_->map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return space_->map(); }
  /// z <- alpha M^-1 r + beta z. Collective.
  void apply(const MultiVector& r, MultiVector& z, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1.0,
             double beta = 0.0) const override;
  bool hasTransposeApply() const override { return true; }  // symmetric
  /// Traces w_i of the local problems, which differ where these meet, whose forces balance a residual: sum_i R_i^T S_i w_i = r, up to the
  /// accuracy of the coarse solve and of stored inverses (repeat for the rest). In BDDC with an exact coarse solve they are the local
  /// solutions before averaging, and sum_i w_i.S_i w_i = r.M^-1 r. Nothing if the strategy has no such traces. Collective.
  /// \param r  one column
  std::optional<std::vector<Vector>> brokenCorrection(const MultiVector& r) const;

  const std::shared_ptr<const InterfaceSpace>& space() const { return space_; }
  const Teuchos::RCP<const InterfaceOperator>& matrix() const { return matrix_; }
  long long applications() const { return applications_; }
  double setupSeconds() const { return setupSeconds_; }
  /// Dimension of the coarse problem; 0 if there is none.
  virtual int coarseSize() const { return 0; }
  /// Lower bound of the eigenvalues of M^-1 S that theory gives, up to approximate coarse solves and stored inverses; 0: unknown. Local.
  virtual double leastEigenvalue() const { return 0.0; }
  /// Bytes of this rank's memory read per application, without the coarse problem; 0 if unknown. Local.
  virtual double bytesRead() const { return 0.0; }
  /// Note for the user about automatic choices; empty if there are none. Collective.
  virtual std::string remark() const { return std::string(); }

 protected:
  virtual void doInitialize() {}
  virtual void doCompute() = 0;
  /// z <- M^-1 r. Implementations may apply matrix().
  virtual void doApply(const MultiVector& r, MultiVector& z) const = 0;
  /// See brokenCorrection().
  virtual std::optional<std::vector<Vector>> doBrokenCorrection(const MultiVector& r) const { return (void)r, std::nullopt; }

 private:
  std::shared_ptr<const InterfaceSpace> space_;
  Teuchos::RCP<const InterfaceOperator> matrix_;
  bool isComputed_ = false;  // valid for space_ and the local problems of matrix_
  mutable long long applications_ = 0;
  double setupSeconds_ = 0.0;
};

void registerBuiltIns(Registry<Preconditioner>& registry);

/// Schema of the scene's list `Preconditioner`, and the preconditioner made from such a list.
Schema preconditionerSchema();
Teuchos::RCP<Preconditioner> makePreconditioner(const Parameters& preconditioner);

}  // namespace suture
