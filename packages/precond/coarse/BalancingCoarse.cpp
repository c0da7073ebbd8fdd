#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/coarse/BalancingCoarse.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

using Crs = Tpetra::CrsMatrix<>;
using GO = Map::global_ordinal_type;

/// Calls take(place, coefficient) for each interface unknown of a coupling row, with relations resolved.
template <typename Take>
void eachUnknown(const InterfaceSpace& space, int place, const Take& take) {
  if (const InterfaceRelation* by = space.relation(place)) {
    for (std::size_t k = 0; k < by->others.size(); ++k) take(by->others[k], by->coefficients[k]);
  } else {
    take(place, 1.0);
  }
}

}  // namespace

BalancingCoarse::BalancingCoarse(const InterfaceOperator& matrix, const std::vector<Matrix>& columns, std::unique_ptr<LocalSolver> solver,
                                 int copies)
    : space_(matrix.space()), columns_(columns) {
  int mine = 0, upToMine = 0;
  for (const Matrix& own : columns) mine += static_cast<int>(own.cols());
  Teuchos::scan(*space_->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(upToMine));
  Teuchos::reduceAll(*space_->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(size_));
  int first = upToMine - mine;
  for (const Matrix& own : columns) {
    firstColumn_.push_back(first);
    first += static_cast<int>(own.cols());
  }
  exchange(columns);
  assemble(matrix, std::move(solver), copies);
}

/// Gives every local problem the columns of its neighbours: a sparse matrix whose rows are interface unknowns is exported from overlapping
/// to owned rows and imported back.
void BalancingCoarse::exchange(const std::vector<Matrix>& columns) {
  const MapPtr& overlap = space_->overlap();
  const MapPtr coarse =
      Teuchos::rcp(new Map(static_cast<Tpetra::global_size_t>(std::max(size_, 1)), 0, space_->comm(), Tpetra::LocallyReplicated));
  const auto placesOf = [&](std::size_t i) -> const std::vector<int>& { return space_->coupling(static_cast<int>(i)).columns(); };
  std::vector<std::size_t> counts(space_->overlapSize(), 0);
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const int place : placesOf(i)) eachUnknown(*space_, place, [&](int own, double) { counts[own] += columns[i].cols(); });
  const auto mine = Teuchos::rcp(new Crs(overlap, Teuchos::ArrayView<const std::size_t>(counts.data(), counts.size())));
  std::vector<GO> ids;
  std::vector<double> values;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].cols() == 0) continue;
    ids.resize(columns[i].cols());
    for (std::size_t c = 0; c < ids.size(); ++c) ids[c] = firstColumn_[i] + static_cast<GO>(c);
    values.resize(ids.size());
    for (std::size_t row = 0; row < placesOf(i).size(); ++row)
      eachUnknown(*space_, placesOf(i)[row], [&](int own, double coefficient) {
        for (std::size_t c = 0; c < ids.size(); ++c) values[c] = coefficient * columns[i](static_cast<int>(row), static_cast<int>(c));
        mine->insertGlobalValues(space_->id(own), static_cast<int>(ids.size()), values.data(), ids.data());
      });
  }
  mine->fillComplete(coarse, space_->map());
  const Tpetra::Export<> toOwned(overlap, space_->map());
  const Tpetra::Import<> toOverlap(space_->map(), overlap);
  const auto owned = Tpetra::exportAndFillCompleteCrsMatrix<Crs>(mine, toOwned, coarse, space_->map());
  const auto all = Tpetra::importAndFillCompleteCrsMatrix<Crs>(owned, toOverlap, coarse, space_->map());

  const auto columnMap = all->getColMap();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto eachEntry = [&](auto&& take) {
      for (std::size_t row = 0; row < placesOf(i).size(); ++row)
        eachUnknown(*space_, placesOf(i)[row], [&](int own, double coefficient) {
          Crs::local_inds_host_view_type local;
          Crs::values_host_view_type value;
          all->getLocalRowView(own, local, value);
          for (std::size_t k = 0; k < local.extent(0); ++k)
            take(static_cast<int>(row), static_cast<int>(columnMap->getGlobalElement(local(k))), coefficient * value(k));
        });
    };
    std::map<int, int> place;  // coarse number -> column of V
    eachEntry([&](int, int id, double) { place.emplace(id, 0); });
    int count = 0;
    seenIds_.emplace_back();
    for (auto& [id, at] : place) {
      at = count++;
      seenIds_.back().push_back(id);
    }
    seen_.emplace_back(Matrix::Zero(static_cast<int>(placesOf(i).size()), count));
    eachEntry([&](int row, int id, double value) { seen_.back()(row, place.at(id)) += value; });
  }
}

void BalancingCoarse::assemble(const InterfaceOperator& matrix, std::unique_ptr<LocalSolver> solver, int copies) {
  std::vector<CoarseElement> elements;
  for (int i = 0; i < space_->locals(); ++i) {
    if (!matrix.locals()[i]) {
      seen_[i].resize(seen_[i].rows(), 0);
      seenIds_[i].clear();
    }
    images_.emplace_back(Matrix::Zero(seen_[i].rows(), seen_[i].cols()));
    if (seen_[i].cols() == 0) continue;
    matrix.locals()[i]->applySchur(seen_[i], images_[i]);
    const Matrix block = seen_[i].transpose() * images_[i];
    elements.push_back({space_->localId(i), seenIds_[i], 0.5 * (block + block.transpose())});
  }
  seen_.clear();
  Eigen::Index parts = 0;
  for (const Matrix& images : images_) parts = std::max(parts, images.cols());
  trace_.resize(space_->mostRows(), 1);
  part_.resize(parts);
  system_ = std::make_unique<DirectCoarse>(space_->comm(), size_, std::move(elements), std::move(solver), copies, true);
  for (auto& ids : seenIds_) ids = placesAmong(system_->names(), ids);
  firstColumn_ = placesAmong(system_->names(), firstColumn_);
  coefficients_ = static_cast<int>(system_->names().size());
}

const Vector& BalancingCoarse::fromResidual(const Matrix& overlap) const {
  mine_.setZero(coefficients_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].cols() == 0) continue;
    auto trace = trace_.topRows(columns_[i].rows());
    space_->coupling(static_cast<int>(i)).restrictTo(overlap, trace);
    mine_.segment(firstColumn_[i], columns_[i].cols()).noalias() += columns_[i].transpose() * trace.col(0);
  }
  return system_->solve(mine_);
}

const Vector& BalancingCoarse::fromTrace(const Matrix& overlap) const {
  mine_.setZero(coefficients_);
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (images_[i].cols() == 0) continue;
    auto trace = trace_.topRows(images_[i].rows());
    space_->coupling(static_cast<int>(i)).restrictTo(overlap, trace);
    auto product = part_.head(images_[i].cols());
    product.noalias() = images_[i].transpose() * trace.col(0);
    for (std::size_t c = 0; c < seenIds_[i].size(); ++c) mine_(seenIds_[i][c]) += product(static_cast<int>(c));
  }
  return system_->solve(mine_);
}

void BalancingCoarse::addColumns(const Vector& y, Matrix& overlap) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].cols() == 0) continue;
    auto trace = trace_.topRows(columns_[i].rows());
    trace.col(0).noalias() = columns_[i] * y.segment(firstColumn_[i], columns_[i].cols());
    space_->coupling(static_cast<int>(i)).addTransposed(trace, overlap);
  }
}

void BalancingCoarse::addImages(const Vector& y, Matrix& overlap) const {
  for (std::size_t i = 0; i < images_.size(); ++i) {
    auto part = part_.head(images_[i].cols());
    for (std::size_t c = 0; c < seenIds_[i].size(); ++c) part(static_cast<int>(c)) = y(seenIds_[i][c]);
    auto trace = trace_.topRows(images_[i].rows());
    trace.col(0).noalias() = images_[i] * part;
    space_->coupling(static_cast<int>(i)).addTransposed(trace, overlap);
  }
}

}  // namespace suture
