#include <suture/base/Errors.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {

InterfaceOperator::InterfaceOperator(std::shared_ptr<const InterfaceSpace> space, LocalProblems locals,
                                     std::shared_ptr<const FrictionTangent> friction)
    : space_(std::move(space)), locals_(std::move(locals)), friction_(std::move(friction)) {
  if (static_cast<int>(locals_.size()) != space_->locals()) throw InternalError("an interface operator needs one entry per coupling");
  mostRows_ = space_->mostRows();
}

void InterfaceOperator::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double alpha, double beta) const {
  applications_ += static_cast<long long>(x.getNumVectors());
  space_->gather(x, overlap_);
  sum_.setZero(overlap_.rows(), overlap_.cols());
  trace_.resize(mostRows_, overlap_.cols());  // work space shared by all local problems
  flux_.resize(mostRows_, overlap_.cols());
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    if (!locals_[i]) continue;
    const Coupling& coupling = space_->coupling(static_cast<int>(i));
    auto trace = trace_.topRows(coupling.rows()), flux = flux_.topRows(coupling.rows());
    coupling.restrictTo(overlap_, trace);
    locals_[i]->applySchur(trace, flux);
    coupling.addTransposed(flux, sum_);
  }
  if (recording_) recorded_.push_back(sum_.col(0));
  const std::vector<InterfaceRelation>* test = friction_ && !friction_->test.empty() ? &friction_->test : nullptr;
  if (friction_)
    for (const InterfaceSpring& spring : friction_->springs) addSpring(spring);
  if (beta == 0.0) {
    space_->scatterAdd(sum_, y, test);
    if (alpha != 1.0) y.scale(alpha);
  } else {
    const auto product = space_->vector(static_cast<int>(x.getNumVectors()));
    space_->scatterAdd(sum_, *product, test);
    y.update(alpha, *product, beta);
  }
}

void InterfaceOperator::addSpring(const InterfaceSpring& spring) const {
  for (Eigen::Index column = 0; column < overlap_.cols(); ++column) {
    double along = 0.0;
    for (std::size_t k = 0; k < spring.places.size(); ++k) along += spring.coefficients[k] * overlap_(spring.places[k], column);
    for (std::size_t k = 0; k < spring.places.size(); ++k)
      sum_(spring.places[k], column) += spring.coefficients[k] * spring.stiffness * along;
  }
}

double InterfaceOperator::bytesRead() const {
  double sum = 0.0;
  for (const auto& local : locals_)
    if (local) sum += local->bytesRead();
  return sum;
}

void InterfaceOperator::record() const {
  recording_ = true;
  recorded_.clear();
}

Matrix InterfaceOperator::recorded(const std::vector<double>& coefficients) const {
  if (coefficients.size() != recorded_.size())
    throw InternalError("the number of coefficients differs from that of the recorded applications");
  Matrix sum = Matrix::Zero(space_->overlapSize(), 1);
  for (std::size_t k = 0; k < recorded_.size(); ++k) sum.col(0) += coefficients[k] * recorded_[k];
  recording_ = false;
  recorded_.clear();
  return sum;
}

MultiVectorPtr InterfaceOperator::condensedLoad() const {
  Matrix sum = Matrix::Zero(space_->overlapSize(), 1);
  for (std::size_t i = 0; i < locals_.size(); ++i)
    if (locals_[i]) {
      const Matrix load = locals_[i]->condensedLoad();
      space_->coupling(static_cast<int>(i)).addTransposed(load, sum);
    }
  const MultiVectorPtr result = space_->vector();
  space_->scatterAdd(sum, *result);
  return result;
}

GlobalId InterfaceOperator::untouched() const {
  Matrix touched = Matrix::Zero(space_->overlapSize(), 1);
  for (std::size_t i = 0; i < locals_.size(); ++i)
    if (locals_[i]) {
      const Coupling& coupling = space_->coupling(static_cast<int>(i));
      coupling.addTransposed(Matrix::Ones(coupling.rows(), 1), touched);
    }
  const MultiVectorPtr owned = space_->vector();
  space_->scatterAdd(touched, *owned);
  const auto values = localView(static_cast<const MultiVector&>(*owned));
  GlobalId mine = 0, all = 0;
  for (Eigen::Index i = 0; i < values.rows(); ++i) mine += values(i, 0) == 0.0;
  Teuchos::reduceAll(*space_->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace suture
