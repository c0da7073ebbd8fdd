#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/CoarseProblem.hpp>

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
constexpr double kShift = 1e-11;
constexpr int kRefinements = 3;

struct Entry {
  int row, column;
  double value;
};

Vector sumOver(const Comm& comm, const Vector& mine) {
  Vector all(mine.size());
  if (mine.size() > 0) Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

}  // namespace

CoarseProblem::CoarseProblem(const InterfaceOperator& matrix, const std::vector<Matrix>& columns, std::unique_ptr<LocalSolver> solver)
    : space_(matrix.space()), columns_(columns), solver_(std::move(solver)) {
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
  assemble(matrix);
}

/// Every local problem learns the columns of its neighbours: a sparse matrix whose rows are interface unknowns goes from overlapping rows
/// to owned ones and back.
void CoarseProblem::exchange(const std::vector<Matrix>& columns) {
  const MapPtr& overlap = space_->overlap();
  const MapPtr coarse =
      Teuchos::rcp(new Map(static_cast<Tpetra::global_size_t>(std::max(size_, 1)), 0, space_->comm(), Tpetra::LocallyReplicated));
  const int rows = static_cast<int>(overlap->getNodeNumElements());
  std::vector<std::size_t> counts(rows, 0);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i].cols() > 0)
      for (int column : space_->coupling(static_cast<int>(i)).columns()) counts[column] += columns[i].cols();
  const auto mine = Teuchos::rcp(new Crs(overlap, Teuchos::ArrayView<const std::size_t>(counts.data(), counts.size())));
  std::vector<GO> ids;
  std::vector<double> values;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].cols() == 0) continue;
    Matrix spread = Matrix::Zero(rows, columns[i].cols());
    space_->coupling(static_cast<int>(i)).addTransposed(columns[i], spread);
    ids.resize(columns[i].cols());
    for (std::size_t c = 0; c < ids.size(); ++c) ids[c] = firstColumn_[i] + static_cast<GO>(c);
    values.resize(ids.size());
    std::vector<int> touched = space_->coupling(static_cast<int>(i)).columns();
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (int row : touched) {
      for (std::size_t c = 0; c < ids.size(); ++c) values[c] = spread(row, static_cast<int>(c));
      mine->insertGlobalValues(overlap->getGlobalElement(row), static_cast<int>(ids.size()), values.data(), ids.data());
    }
  }
  mine->fillComplete(coarse, space_->map());
  const Tpetra::Export<> toOwned(overlap, space_->map());
  const Tpetra::Import<> toOverlap(space_->map(), overlap);
  const auto owned = Tpetra::exportAndFillCompleteCrsMatrix<Crs>(mine, toOwned, coarse, space_->map());
  const auto all = Tpetra::importAndFillCompleteCrsMatrix<Crs>(owned, toOverlap, coarse, space_->map());

  const auto columnMap = all->getColMap();
  for (int i = 0; i < space_->locals(); ++i) {
    std::map<int, int> place;  // coarse number -> column of V
    const Coupling& coupling = space_->coupling(i);
    const auto eachEntry = [&](auto&& take) {
      std::vector<int> touched = coupling.columns();
      std::sort(touched.begin(), touched.end());
      touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
      for (int row : touched) {
        Crs::local_inds_host_view_type local;
        Crs::values_host_view_type value;
        all->getLocalRowView(row, local, value);
        for (std::size_t k = 0; k < local.extent(0); ++k) take(row, static_cast<int>(columnMap->getGlobalElement(local(k))), value(k));
      }
    };
    eachEntry([&](int, int id, double) { place.emplace(id, 0); });
    int count = 0;
    seenIds_.emplace_back();
    for (auto& [id, at] : place) {
      at = count++;
      seenIds_.back().push_back(id);
    }
    Matrix spread = Matrix::Zero(rows, count);
    eachEntry([&](int row, int id, double value) { spread(row, place.at(id)) = value; });
    seen_.emplace_back(coupling.rows(), count);
    coupling.restrictTo(spread, seen_.back());
  }
}

void CoarseProblem::assemble(const InterfaceOperator& matrix) {
  std::vector<Entry> entries;
  for (int i = 0; i < space_->locals(); ++i) {
    images_.emplace_back(Matrix::Zero(seen_[i].rows(), seen_[i].cols()));
    if (!matrix.locals()[i] || seen_[i].cols() == 0) continue;
    matrix.locals()[i]->applySchur(seen_[i], images_[i]);
    const Matrix block = seen_[i].transpose() * images_[i];
    for (int b = 0; b < block.cols(); ++b)
      for (int a = 0; a < block.rows(); ++a) entries.push_back({seenIds_[i][a], seenIds_[i][b], 0.5 * (block(a, b) + block(b, a))});
  }
  Packer packer;
  packer.put(entries);
  std::vector<Eigen::Triplet<double>> triplets;
  for (const std::string& bytes : allGather(*space_->comm(), packer.bytes()))
    for (const Entry& entry : Unpacker(bytes).get<std::vector<Entry>>()) triplets.emplace_back(entry.row, entry.column, entry.value);
  scaled_.resize(size_, size_);
  scaled_.setFromTriplets(triplets.begin(), triplets.end());
  scale_ = Vector::Ones(size_);
  for (int i = 0; i < size_; ++i) {
    const double diagonal = scaled_.coeff(i, i);
    if (diagonal > 0.0) scale_(i) = 1.0 / std::sqrt(diagonal);
  }
  scaled_ = (scale_.asDiagonal() * scaled_ * scale_.asDiagonal()).eval();
  SparseMatrix shifted = scaled_;
  for (int i = 0; i < size_; ++i) shifted.coeffRef(i, i) += kShift;
  solver_->factorise(shifted);
}

Vector CoarseProblem::solve(const Vector& mine) const {
  const Vector b = scale_.cwiseProduct(sumOver(*space_->comm(), mine));
  Vector x = Vector::Zero(size_);
  for (int k = 0; k <= kRefinements; ++k) {
    Matrix correction = b - scaled_ * x;
    solver_->solve(correction);
    x += correction.col(0);
  }
  return scale_.cwiseProduct(x);
}

Vector CoarseProblem::fromResidual(const Matrix& overlap) const {
  Vector mine = Vector::Zero(size_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].cols() == 0) continue;
    Matrix trace(columns_[i].rows(), 1);
    space_->coupling(static_cast<int>(i)).restrictTo(overlap, trace);
    mine.segment(firstColumn_[i], columns_[i].cols()) += columns_[i].transpose() * trace.col(0);
  }
  return solve(mine);
}

Vector CoarseProblem::fromTrace(const Matrix& overlap) const {
  Vector mine = Vector::Zero(size_);
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (images_[i].cols() == 0) continue;
    Matrix trace(images_[i].rows(), 1);
    space_->coupling(static_cast<int>(i)).restrictTo(overlap, trace);
    const Vector product = images_[i].transpose() * trace.col(0);
    for (std::size_t c = 0; c < seenIds_[i].size(); ++c) mine(seenIds_[i][c]) += product(static_cast<int>(c));
  }
  return solve(mine);
}

void CoarseProblem::addColumns(const Vector& y, Matrix& overlap) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].cols() > 0)
      space_->coupling(static_cast<int>(i)).addTransposed(columns_[i] * y.segment(firstColumn_[i], columns_[i].cols()), overlap);
}

void CoarseProblem::addImages(const Vector& y, Matrix& overlap) const {
  for (std::size_t i = 0; i < images_.size(); ++i) {
    Vector part(seenIds_[i].size());
    for (std::size_t c = 0; c < seenIds_[i].size(); ++c) part(static_cast<int>(c)) = y(seenIds_[i][c]);
    space_->coupling(static_cast<int>(i)).addTransposed(images_[i] * part, overlap);
  }
}

}  // namespace suture
