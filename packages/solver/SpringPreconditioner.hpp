#pragma once
#include <suture/precond/Preconditioner.hpp>

#include <vector>

namespace suture {

/// Preconditioner of operators in which only springs hold some rigid motions Z (FrictionTangent::motions): M^-1 = M_0^-1 + Z E^-1 Z^T, with
/// E the energy of the springs in these motions. M_0 is another preconditioner, without springs, of the space in which as many unknowns
/// vanish as there are motions; the unknowns that determine the motions best are chosen. Without such motions M = M_0. Set up again only if
/// the space, its local problems or these unknowns change.
class SpringPreconditioner : public Preconditioner {
 public:
  explicit SpringPreconditioner(Teuchos::RCP<Preconditioner> other) : other_(std::move(other)) {}

  int coarseSize() const override { return other_->coarseSize(); }
  double leastEigenvalue() const override { return motions_.is_null() ? other_->leastEigenvalue() : 0.0; }
  double bytesRead() const override { return other_->bytesRead(); }
  std::string remark() const override { return other_->remark(); }

 protected:
  void doCompute() override;
  void doApply(const MultiVector& r, MultiVector& z) const override;

 private:
  std::vector<GlobalId> telling(const MultiVector& motions) const;

  Teuchos::RCP<Preconditioner> other_;
  std::shared_ptr<const InterfaceSpace> madeFor_;
  LocalProblems madeOf_;
  std::vector<GlobalId> vanishing_;
  MultiVectorPtr motions_;  // null: none
  Matrix inverse_;          // inverse of the energy
};

}  // namespace suture
