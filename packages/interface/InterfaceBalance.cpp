#include <suture/interface/InterfaceBalance.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

namespace suture {

InterfaceBalance::InterfaceBalance(std::shared_ptr<const InterfaceSpace> space, LocalProblems locals)
    : space_(std::move(space)), apart_(Teuchos::rcp(new InterfaceOperator(space_, std::move(locals)))) {}

void InterfaceBalance::takeLoads(double constantEnergy) {
  load_ = Matrix::Zero(space_->overlapSize(), 1);
  for (std::size_t i = 0; i < locals().size(); ++i)
    space_->coupling(static_cast<int>(i)).addTransposed(locals()[i]->condensedLoad(), load_);
  space_->sum(load_);
  Teuchos::reduceAll(*space_->comm(), Teuchos::REDUCE_SUM, constantEnergy, Teuchos::outArg(constantEnergy_));
}

Matrix InterfaceBalance::forces(const MultiVector& trace) const {
  const MultiVectorPtr flux = space_->vector();
  apart_->apply(trace, *flux);
  Matrix overlap;
  space_->gather(*flux, overlap);
  return overlap;
}

Matrix InterfaceBalance::of(const InterfaceState& state, int& applications) const {
  if (state.memory) return *state.memory;
  ++applications;
  return forces(*state.trace) - load_;
}

Vector InterfaceBalance::forces(const Matrix& imbalance) const {
  Vector all = Vector::Zero(static_cast<Eigen::Index>(space_->map()->getNodeNumElements()));
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) all(at) = imbalance(place, 0) + load_(place, 0);
  return all;
}

double InterfaceBalance::energy(const Matrix& trace, const Matrix& imbalance) const {
  double mine = 0.0, all = 0.0;
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (space_->ownedRow(place) >= 0) mine += 0.5 * trace(place, 0) * (imbalance(place, 0) - load_(place, 0));
  Teuchos::reduceAll(*space_->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all + constantEnergy_;
}

MultiVectorPtr InterfaceBalance::residual(const Matrix& imbalance, const InterfaceSpace& space, const FrictionTangent* friction) const {
  Matrix folded = -imbalance;
  space.fold(folded, friction && !friction->test.empty() ? &friction->test : nullptr);
  const MultiVectorPtr result = space_->vector();
  auto owned = localView(*result);
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) owned(at, 0) = folded(place, 0);
  return result;
}

}  // namespace suture
