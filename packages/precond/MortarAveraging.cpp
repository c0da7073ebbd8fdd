#include <suture/base/Collective.hpp>
#include <suture/base/Dense.hpp>
#include <suture/precond/MortarAveraging.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace suture {

namespace {

using Crs = Tpetra::CrsMatrix<>;

// Layers of neighbours in a patch. What is left out decays by a factor from layer to layer that depends on how much the stiffness jumps:
// with jumps of 1e3 four layers keep the condition within 5 % of that with the whole matrix.
constexpr int kFewLayers = 1, kManyLayers = 4;
constexpr double kJump = 10.0;

/// Diagonals of the stiffness matrices, summed within the bodies, of each unknown of the overlap.
Vector stiffnessOf(const InterfaceSpace& torn, const LocalProblems& locals) {
  Matrix sum = Matrix::Zero(torn.overlapSize(), 1);
  for (int i = 0; i < torn.locals(); ++i)
    if (locals[i]) torn.coupling(i).addTransposed(locals[i]->stiffnessDiagonal(), sum);
  torn.sumDensities(sum);
  return sum.col(0);
}

/// Rows of a matrix that belong to other ranks, by the number of the unknown.
using SparseRow = std::map<GlobalId, double>;

std::map<GlobalId, SparseRow> rowsOf(const Crs& matrix, const std::set<GlobalId>& wanted, const CommPtr& comm) {
  const std::vector<GlobalId> ids(wanted.begin(), wanted.end());
  const MapPtr here = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                           Teuchos::ArrayView<const GlobalId>(ids.data(), ids.size()), 0, comm));
  const Import import(matrix.getRowMap(), here);
  const auto copy =
      Tpetra::importAndFillCompleteCrsMatrix<Crs>(Teuchos::rcpFromRef(matrix), import, matrix.getDomainMap(), matrix.getRangeMap());
  std::map<GlobalId, SparseRow> rows;
  for (std::size_t r = 0; r < ids.size(); ++r) {
    Crs::local_inds_host_view_type columns;
    Crs::values_host_view_type values;
    copy->getLocalRowView(static_cast<int>(r), columns, values);
    for (std::size_t k = 0; k < columns.extent(0); ++k) rows[ids[r]][copy->getColMap()->getGlobalElement(columns(k))] = values(k);
  }
  return rows;
}

}  // namespace

MortarAveraging::MortarAveraging(const InterfaceSpace& space, const LocalProblems& locals) {
  const InterfaceSpace& torn = *space.torn();
  const Vector stiffness = stiffnessOf(torn, locals);
  std::vector<const InterfaceRelation*> mine;  // rows whose expressed unknown is owned here
  std::set<int> masters;                       // places
  double least = 1e300, most = 0.0;
  for (const InterfaceRelation& relation : space.relations()) {
    if (relation.others.size() < 2) continue;
    if (torn.ownedRow(relation.unknown) >= 0) {
      mine.push_back(&relation);
      expressed_.push_back(torn.ownedRow(relation.unknown));
    }
    masters.insert(relation.others.begin(), relation.others.end());
    for (const int place : relation.others) {
      const double ratio = stiffness(place) / std::max(stiffness(relation.unknown), 1e-300);
      least = std::min(least, ratio), most = std::max(most, ratio);
    }
  }
  const double mineJump = std::max(most, 1.0 / std::max(least, 1e-300));
  double jump = 0.0;
  Teuchos::reduceAll(*torn.comm(), Teuchos::REDUCE_MAX, mineJump, Teuchos::outArg(jump));
  const int layers = jump > kJump ? kManyLayers : kFewLayers;

  constexpr std::size_t kExpected = 8;  // entries of a row
  jump_ = Teuchos::rcp(new Crs(torn.map(), kExpected));
  Crs normal(torn.map(), 2 * kExpected);  // Delta_m + M^T Delta_s M
  for (const InterfaceRelation* relation : mine) {
    std::vector<GlobalId> ids;
    std::vector<double> values;
    for (std::size_t k = 0; k < relation->others.size(); ++k) {
      ids.push_back(torn.id(relation->others[k]));
      values.push_back(-relation->coefficients[k]);
    }
    const auto count = static_cast<int>(ids.size());
    for (int k = 0; k < count; ++k) {
      std::vector<double> product(values);
      for (double& value : product) value *= stiffness(relation->unknown) * values[k];
      normal.insertGlobalValues(ids[k], count, product.data(), ids.data());
    }
    const double one = 1.0;
    const GlobalId own = torn.id(relation->unknown);
    jump_->insertGlobalValues(own, 1, &one, &own);
    jump_->insertGlobalValues(own, count, values.data(), ids.data());
  }
  for (const int place : masters)
    if (torn.ownedRow(place) >= 0) {
      const GlobalId id = torn.id(place);
      normal.insertGlobalValues(id, 1, &stiffness(place), &id);
    }
  jump_->fillComplete(torn.map(), torn.map());
  normal.fillComplete(torn.map(), torn.map());

  // The patch of each row grows by the neighbours of what it has.
  std::vector<std::set<GlobalId>> patches(mine.size());
  for (std::size_t r = 0; r < mine.size(); ++r)
    for (const int place : mine[r]->others) patches[r].insert(torn.id(place));
  std::map<GlobalId, SparseRow> rows;
  for (int layer = 0; layer <= layers; ++layer) {
    std::set<GlobalId> wanted;
    for (const auto& patch : patches) wanted.insert(patch.begin(), patch.end());
    rows = rowsOf(normal, wanted, torn.comm());
    if (layer == layers) break;
    for (auto& patch : patches) {
      std::set<GlobalId> grown = patch;
      for (const GlobalId id : patch)
        for (const auto& [column, value] : rows.at(id)) grown.insert(column);
      patch = std::move(grown);
    }
  }
  parts_ = Teuchos::rcp(new Crs(torn.map(), 2 * kExpected));
  collectively(*torn.comm(), "sharing the jumps of a mortar", [&] {
    for (std::size_t r = 0; r < mine.size(); ++r) {
      const std::vector<GlobalId> ids(patches[r].begin(), patches[r].end());
      const auto n = static_cast<int>(ids.size());
      const auto at = [&](GlobalId id) { return static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); };
      Matrix patch = Matrix::Zero(n, n), part = Matrix::Zero(n, 1);
      for (int i = 0; i < n; ++i)
        for (const auto& [column, value] : rows.at(ids[i]))
          if (patches[r].count(column)) patch(i, at(column)) = value;
      for (std::size_t k = 0; k < mine[r]->others.size(); ++k)
        part(at(torn.id(mine[r]->others[k])), 0) = mine[r]->coefficients[k] * stiffness(mine[r]->unknown);
      const Matrix solved = solvePositive(patch, part);
      const GlobalId own = torn.id(mine[r]->unknown);
      for (int i = 0; i < n; ++i) parts_->insertGlobalValues(ids[i], 1, &solved(i, 0), &own);
    }
  });
  parts_->fillComplete(torn.map(), torn.map());
}

void MortarAveraging::apply(MultiVector& values) const {
  if (work_.is_null() || work_->getNumVectors() != values.getNumVectors())
    work_ = Teuchos::rcp(new MultiVector(values.getMap(), values.getNumVectors()));
  jump_->apply(values, *work_);
  parts_->apply(*work_, values, Teuchos::NO_TRANS, 1.0, 1.0);
  auto view = localView(values);
  for (const int row : expressed_) view.row(row).setZero();
}

void MortarAveraging::applyTranspose(MultiVector& values) const {
  if (work_.is_null() || work_->getNumVectors() != values.getNumVectors())
    work_ = Teuchos::rcp(new MultiVector(values.getMap(), values.getNumVectors()));
  parts_->apply(values, *work_, Teuchos::TRANS);
  auto view = localView(values);
  for (const int row : expressed_) view.row(row).setZero();
  jump_->apply(*work_, values, Teuchos::TRANS, 1.0, 1.0);
}

}  // namespace suture
