#include <suture/base/Errors.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {

namespace {
using GO = Map::global_ordinal_type;

std::vector<GO> sorted(std::vector<GO> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

MapPtr mapOf(const std::vector<GO>& ids, const CommPtr& comm) {
  return Teuchos::rcp(
      new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), Teuchos::ArrayView<const GO>(ids.data(), ids.size()), 0, comm));
}
}  // namespace

InterfaceSpace::InterfaceSpace(CommPtr comm, const InterfaceLayout& layout)
    : comm_(std::move(comm)), localIds_(layout.locals), dimension_(layout.dimension) {
  std::vector<GO> touched;
  for (const auto& boundary : layout.boundaries) touched.insert(touched.end(), boundary.begin(), boundary.end());
  // Owners are found among those whose local problems hold the unknown, not among its partners.
  map_ = Tpetra::createOneToOne(mapOf(sorted(touched), comm_));
  touched.insert(touched.end(), layout.partners.begin(), layout.partners.end());
  touched = sorted(std::move(touched));
  overlap_ = mapOf(touched, comm_);
  import_ = Teuchos::rcp(new Import(map_, overlap_));
  ids_.assign(touched.begin(), touched.end());
  for (const GO id : touched) ownedRows_.push_back(map_->getLocalElement(id));

  for (const auto& boundary : layout.boundaries) {
    std::vector<int> columns;
    for (const GlobalId id : boundary) columns.push_back(overlap_->getLocalElement(id));
    couplings_.emplace_back(std::move(columns));
  }
  relationOf_.assign(ids_.size(), -1);
  importPoints(layout);
  exchangeSharers(layout);
  addEntities(layout);
}

/// Owners learn points and directions from whoever knows them, and tell all who see the unknown.
void InterfaceSpace::importPoints(const InterfaceLayout& layout) {
  std::vector<GO> known;
  for (const InterfaceLayout::Unknown& unknown : layout.unknowns) known.push_back(unknown.id);
  const MapPtr knownMap = mapOf(sorted(known), comm_);
  MultiVector source(knownMap, 10), owned(map_, 10), target(overlap_, 10);
  auto values = localView(source);
  for (const InterfaceLayout::Unknown& unknown : layout.unknowns) {
    const int row = knownMap->getLocalElement(unknown.id);
    for (int k = 0; k < 3; ++k) {
      values(row, k) = unknown.point[k];
      values(row, 3 + k) = unknown.direction[k];
      values(row, 6 + k) = unknown.moment[k];
    }
    values(row, 9) = unknown.flux;
  }
  owned.doExport(source, Tpetra::Export<>(knownMap, map_), Tpetra::INSERT);
  target.doImport(owned, *import_, Tpetra::INSERT);
  const auto all = localView(static_cast<const MultiVector&>(target));
  points_.resize(ids_.size());
  directions_.resize(ids_.size());
  moments_.resize(ids_.size());
  fluxes_.resize(ids_.size());
  for (std::size_t row = 0; row < ids_.size(); ++row) {
    for (int k = 0; k < 3; ++k) {
      points_[row][k] = all(static_cast<int>(row), k);
      directions_[row][k] = all(static_cast<int>(row), 3 + k);
      moments_[row][k] = all(static_cast<int>(row), 6 + k);
    }
    fluxes_[row] = all(static_cast<int>(row), 9);
  }
}

/// A sparse matrix with a row an unknown and a column a local problem goes from overlapping rows to owned ones and back.
void InterfaceSpace::exchangeSharers(const InterfaceLayout& layout) {
  using Crs = Tpetra::CrsMatrix<>;
  int last = -1, most = -1;
  for (const int id : localIds_) last = std::max(last, id);
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, last, Teuchos::outArg(most));
  const MapPtr problems = Teuchos::rcp(new Map(static_cast<Tpetra::global_size_t>(most + 1), 0, comm_, Tpetra::LocallyReplicated));
  std::vector<std::vector<GO>> mine(ids_.size());
  for (std::size_t i = 0; i < couplings_.size(); ++i)
    for (const int place : couplings_[i].columns()) mine[place].push_back(layout.locals[i]);
  std::vector<std::size_t> counts(ids_.size());
  for (std::size_t k = 0; k < mine.size(); ++k) counts[k] = mine[k].size();
  const auto spread = Teuchos::rcp(new Crs(overlap_, Teuchos::ArrayView<const std::size_t>(counts.data(), counts.size())));
  std::vector<double> ones;
  for (std::size_t k = 0; k < mine.size(); ++k) {
    ones.assign(mine[k].size(), 1.0);
    if (!mine[k].empty()) spread->insertGlobalValues(ids_[k], static_cast<int>(ones.size()), ones.data(), mine[k].data());
  }
  spread->fillComplete(problems, map_);
  const auto owned = Tpetra::exportAndFillCompleteCrsMatrix<Crs>(spread, Tpetra::Export<>(overlap_, map_), problems, map_);
  const auto all = Tpetra::importAndFillCompleteCrsMatrix<Crs>(owned, *import_, problems, map_);
  sharers_.resize(ids_.size());
  for (std::size_t k = 0; k < ids_.size(); ++k) {
    Crs::local_inds_host_view_type columns;
    Crs::values_host_view_type values;
    all->getLocalRowView(static_cast<int>(k), columns, values);
    for (std::size_t c = 0; c < columns.extent(0); ++c)
      sharers_[k].push_back(static_cast<int>(all->getColMap()->getGlobalElement(columns(c))));
    std::sort(sharers_[k].begin(), sharers_[k].end());
  }
}

GlobalId InterfaceSpace::size() const { return static_cast<GlobalId>(map_->getGlobalNumElements()); }

MultiVectorPtr InterfaceSpace::vector(int columns) const { return Teuchos::rcp(new MultiVector(map_, static_cast<std::size_t>(columns))); }

int InterfaceSpace::mostRows() const {
  int most = 0;
  for (const Coupling& coupling : couplings_) most = std::max(most, coupling.rows());
  return most;
}

void InterfaceSpace::unfold(LocalView overlap) const {
  for (const InterfaceRelation& relation : relations_) {
    overlap.row(relation.unknown).setZero();
    for (std::size_t k = 0; k < relation.others.size(); ++k)
      overlap.row(relation.unknown) += relation.coefficients[k] * overlap.row(relation.others[k]);
  }
}

void InterfaceSpace::fold(LocalView overlap) const {
  for (const InterfaceRelation& relation : relations_) {
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

void InterfaceSpace::scatterAdd(const Matrix& overlap, MultiVector& owned) const {
  MultiVector& source = overlapping(static_cast<std::size_t>(overlap.cols()));
  auto values = localView(source);
  values = overlap;
  fold(values);
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
