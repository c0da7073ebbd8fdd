#pragma once
#include <suture/base/Registry.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <string>

namespace suture {

/// Symmetric positive definite approximation of the inverse of an InterfaceOperator, as a Tpetra operator that any Krylov method can be
/// given. First initialize() with the space, then compute() with the operator; compute() again after the operator changed, and what did not
/// change is kept (local problems are compared by identity). Strategies: Neumann-Neumann; a user adds his own through
/// Registry<Preconditioner>.
class Preconditioner : public Operator {
 public:
  static const char* kind() { return "preconditioner"; }

  /// Set-up that depends on the space alone. Collective.
  void initialize(std::shared_ptr<const InterfaceSpace> space);
  /// Everything that an application needs. Collective. \throws NumericalError
  void compute(Teuchos::RCP<const InterfaceOperator> matrix);

  Teuchos::RCP<const Map> getDomainMap() const override { return space_->map(); }
  Teuchos::RCP<const Map> getRangeMap() const override { return space_->map(); }
  /// z <- alpha M^-1 r + beta z. Collective.
  void apply(const MultiVector& r, MultiVector& z, Teuchos::ETransp mode = Teuchos::NO_TRANS, double alpha = 1.0,
             double beta = 0.0) const override;
  bool hasTransposeApply() const override { return true; }  // symmetric

  const std::shared_ptr<const InterfaceSpace>& space() const { return space_; }
  const Teuchos::RCP<const InterfaceOperator>& matrix() const { return matrix_; }
  long long applications() const { return applications_; }
  double setupSeconds() const { return setupSeconds_; }
  /// Dimension of the coarse problem, 0 without one.
  virtual int coarseSize() const { return 0; }
  /// Bytes that one application reads of this rank's memory, without the coarse problem; 0 if not known. Local.
  virtual double bytesRead() const { return 0.0; }
  /// Note for the user about choices that the preconditioner made by itself; empty if there are none. Collective.
  virtual std::string remark() const { return std::string(); }

 protected:
  virtual void doInitialize() {}
  virtual void doCompute() = 0;
  /// z <- M^-1 r. It may apply matrix().
  virtual void doApply(const MultiVector& r, MultiVector& z) const = 0;

 private:
  std::shared_ptr<const InterfaceSpace> space_;
  Teuchos::RCP<const InterfaceOperator> matrix_;
  bool isComputed_ = false;  // for the space and the local problems of matrix_
  mutable long long applications_ = 0;
  double setupSeconds_ = 0.0;
};

void registerBuiltIns(Registry<Preconditioner>& registry);

/// The scene's list `Preconditioner`, and what it describes.
Schema preconditionerSchema();
Teuchos::RCP<Preconditioner> makePreconditioner(const Parameters& preconditioner);

}  // namespace suture
