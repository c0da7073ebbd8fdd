#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Errors.hpp>
#include <suture/interface/Directory.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <Teuchos_Comm.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {

InterfaceSpace::InterfaceSpace(CommPtr comm, const InterfaceLayout& layout)
    : comm_(std::move(comm)), localIds_(layout.locals), dimension_(agreedDimension(*comm_, layout.dimension)) {
  if (dimension_ == 0) throw InternalError("no rank knows the dimension of the interface");
  std::vector<GlobalId> touched;
  for (const auto& boundary : layout.boundaries) touched.insert(touched.end(), boundary.begin(), boundary.end());
  // The owner of an unknown must have a local problem with it, not only use it as a partner.
  map_ = Tpetra::createOneToOne(mapOf(comm_, touched));
  touched.insert(touched.end(), layout.partners.begin(), layout.partners.end());
  overlap_ = mapOf(comm_, std::move(touched));
  import_ = Teuchos::rcp(new Import(map_, overlap_));
  ownedRows_.own().resize(overlap_->getNodeNumElements());
  for (int place = 0; place < overlapSize(); ++place) ownedRows_.own()[place] = map_->getLocalElement(overlap_->getGlobalElement(place));

  couplings_.own().reserve(layout.boundaries.size());
  for (const auto& boundary : layout.boundaries) {
    std::vector<int> columns(boundary.size());
    for (std::size_t i = 0; i < boundary.size(); ++i) columns[i] = overlap_->getLocalElement(boundary[i]);
    couplings_.own().emplace_back(std::move(columns));
  }
  relationOf_.assign(ownedRows_->size(), -1);
  unknowns_ = joinUnknowns(overlap_, map_, layout.unknowns);
  exchangeSharers(layout);
  addEntities(layout);
}

void InterfaceSpace::exchangeSharers(const InterfaceLayout& layout) {
  std::vector<std::vector<int>> mine(ownedRows_->size());
  for (std::size_t i = 0; i < couplings_->size(); ++i)
    for (const int place : coupling(static_cast<int>(i)).columns()) mine[place].push_back(layout.locals[i]);
  sharers_ = joinNumbers(overlap_, map_, mine);
}

GlobalId InterfaceSpace::size() const { return static_cast<GlobalId>(map_->getGlobalNumElements()); }

MultiVectorPtr InterfaceSpace::vector(int columns) const { return Teuchos::rcp(new MultiVector(map_, static_cast<std::size_t>(columns))); }

int InterfaceSpace::mostRows() const {
  int most = 0;
  for (const Coupling& coupling : *couplings_) most = std::max(most, coupling.rows());
  return most;
}

void InterfaceSpace::unfold(LocalView overlap) const {
  for (const InterfaceRelation& relation : relations_) {
    overlap.row(relation.unknown).setZero();
    for (std::size_t k = 0; k < relation.others.size(); ++k)
      overlap.row(relation.unknown) += relation.coefficients[k] * overlap.row(relation.others[k]);
  }
}

void InterfaceSpace::fold(LocalView overlap, const std::vector<InterfaceRelation>* test) const {
  for (const InterfaceRelation& relation : test ? *test : relations_) {
    for (std::size_t k = 0; k < relation.others.size(); ++k)
      overlap.row(relation.others[k]) += relation.coefficients[k] * overlap.row(relation.unknown);
    overlap.row(relation.unknown).setZero();
  }
}

MultiVector& InterfaceSpace::overlapping(std::size_t columns) const {
  if (work_.is_null() || work_->getNumVectors() != columns) work_ = Teuchos::rcp(new MultiVector(overlap_, columns));
  return *work_;
}

void InterfaceSpace::gather(const MultiVector& owned, Matrix& overlap) const {
  MultiVector& target = overlapping(owned.getNumVectors());
  target.doImport(owned, *import_, Tpetra::INSERT);
  overlap = localView(static_cast<const MultiVector&>(target));
  unfold(overlap);
}

void InterfaceSpace::scatterAdd(const Matrix& overlap, MultiVector& owned, const std::vector<InterfaceRelation>* test) const {
  MultiVector& source = overlapping(static_cast<std::size_t>(overlap.cols()));
  auto values = localView(source);
  values = overlap;
  fold(values, test);
  owned.putScalar(0.0);
  owned.doExport(source, *import_, Tpetra::ADD);
}

void InterfaceSpace::sum(Matrix& overlap) const {
  const auto columns = static_cast<std::size_t>(overlap.cols());
  if (sum_.is_null() || sum_->getNumVectors() != columns) sum_ = vector(static_cast<int>(columns));
  scatterAdd(overlap, *sum_);
  gather(*sum_, overlap);
}

void InterfaceSpace::sumDensities(Matrix& overlap) const {
  for (const InterfaceRelation& relation : relations_) {
    if (relation.others.size() == 1)
      overlap.row(relation.others[0]) += relation.coefficients[0] * relation.coefficients[0] * overlap.row(relation.unknown);
    overlap.row(relation.unknown).setZero();
  }
  MultiVector source(overlap_, static_cast<std::size_t>(overlap.cols())), owned(map_, static_cast<std::size_t>(overlap.cols()));
  localView(source) = overlap;
  owned.doExport(source, *import_, Tpetra::ADD);
  source.doImport(owned, *import_, Tpetra::INSERT);
  overlap = localView(static_cast<const MultiVector&>(source));
  for (const InterfaceRelation& relation : relations_)
    if (relation.others.size() == 1) overlap.row(relation.unknown) = overlap.row(relation.others[0]);
}

Eigen::Map<Matrix, 0, Eigen::OuterStride<>> localView(MultiVector& x) {
  const auto view = x.getLocalViewHost(Tpetra::Access::ReadWrite);
  const auto stride = static_cast<Eigen::Index>(x.getStride());
  return {view.data(), static_cast<Eigen::Index>(x.getLocalLength()), static_cast<Eigen::Index>(x.getNumVectors()),
          Eigen::OuterStride<>(stride)};
}

Eigen::Map<const Matrix, 0, Eigen::OuterStride<>> localView(const MultiVector& x) {
  const auto view = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto stride = static_cast<Eigen::Index>(x.getStride());
  return {view.data(), static_cast<Eigen::Index>(x.getLocalLength()), static_cast<Eigen::Index>(x.getNumVectors()),
          Eigen::OuterStride<>(stride)};
}

double dot(const MultiVector& a, const MultiVector& b) {
  Teuchos::Array<double> result(1);
  a.dot(b, result());
  return result[0];
}

}  // namespace suture
