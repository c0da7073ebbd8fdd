#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/solver/SpringPreconditioner.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <limits>

namespace suture {

namespace {
constexpr double kNearlyBest = 0.9;  // unknowns above this fraction of the largest motion are equivalent; the lowest id is taken
constexpr double kTellsNone = 1e-8;  // motions below this are zero
}  // namespace

/// Unknowns whose values determine the motions, chosen greedily; the same on all ranks. Collective.
std::vector<GlobalId> SpringPreconditioner::telling(const MultiVector& motions) const {
  std::vector<char> inRows(static_cast<std::size_t>(space()->overlapSize()), 0);
  for (const InterfaceRelation& relation : space()->relations())
    if (relation.others.size() > 1)
      for (const int place : relation.others) inRows[static_cast<std::size_t>(place)] = 1;
  Matrix rest = localView(motions);
  std::vector<GlobalId> idOf(static_cast<std::size_t>(rest.rows()), -1);
  for (int place = 0; place < space()->overlapSize(); ++place)
    if (const int at = space()->ownedRow(place); at >= 0) {
      idOf[static_cast<std::size_t>(at)] = space()->id(place);
      if (space()->relation(place) || inRows[static_cast<std::size_t>(place)]) rest.row(at).setZero();
    }
  std::vector<GlobalId> chosen;
  for (Eigen::Index k = 0; k < rest.cols(); ++k) {
    const Vector size = rest.rowwise().norm();
    const double mine = size.size() > 0 ? size.maxCoeff() : 0.0;
    double most = 0.0;
    Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(most));
    if (!(most > kTellsNone)) break;
    GlobalId lowest = std::numeric_limits<GlobalId>::max(), first = lowest;
    Eigen::Index own = -1;
    for (Eigen::Index i = 0; i < size.size(); ++i)
      if (size(i) >= kNearlyBest * most && idOf[static_cast<std::size_t>(i)] < lowest) lowest = idOf[static_cast<std::size_t>(i)], own = i;
    Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MIN, lowest, Teuchos::outArg(first));
    Vector direction = Vector::Zero(rest.cols()), all = direction;
    if (own >= 0 && lowest == first) direction = rest.row(own).transpose();
    Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, static_cast<int>(direction.size()), direction.data(), all.data());
    all.normalize();
    rest -= (rest * all) * all.transpose();
    chosen.push_back(first);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

void SpringPreconditioner::doCompute() {
  const FrictionTangent* friction = matrix()->friction();
  motions_ = friction ? friction->motions : Teuchos::null;
  std::vector<GlobalId> vanishing;
  if (!motions_.is_null()) {
    vanishing = telling(*motions_);
    const Eigenpairs pairs = symmetricEigenpairs(friction->motionEnergy);
    inverse_ = pairs.vectors * pairs.values.cwiseInverse().asDiagonal() * pairs.vectors.transpose();
  }
  // Some ranks may have chosen other unknowns for the same rows.
  const int mine = madeFor_ == space() && madeOf_ == matrix()->locals() && vanishing == vanishing_;
  int all = 0;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  if (all == 1) return;
  madeFor_ = nullptr;
  if (vanishing.empty()) {
    other_->initialize(space());
    other_->compute(matrix());
  } else {
    std::vector<int> places;
    for (const GlobalId id : vanishing)
      if (const int place = space()->overlap()->getLocalElement(id); place >= 0) places.push_back(place);
    const auto held = space()->without(places);
    other_->initialize(held);
    other_->compute(Teuchos::rcp(new InterfaceOperator(held, matrix()->locals())));
  }
  madeFor_ = space();
  madeOf_ = matrix()->locals();
  vanishing_ = std::move(vanishing);
}

void SpringPreconditioner::doApply(const MultiVector& r, MultiVector& z) const {
  other_->apply(r, z);
  if (motions_.is_null()) return;
  const auto motions = localView(static_cast<const MultiVector&>(*motions_));
  const Matrix mine = motions.transpose() * localView(r);
  Matrix all = mine;
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  localView(z) += motions * (inverse_ * all);
}

}  // namespace suture
