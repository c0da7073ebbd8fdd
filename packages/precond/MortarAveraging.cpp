#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/MortarAveraging.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace suture {

namespace {

using Crs = Tpetra::CrsMatrix<>;

// Layers of neighbours in a patch. What is left out decays by a factor from layer to layer that depends on how much the stiffness jumps:
// with jumps of 1e3 four layers keep the condition within 5 % of that with the whole matrix.
constexpr int kFewLayers = 1, kManyLayers = 4;
// A layer around a patch of a surface has several times the nodes of the patch: beyond this size there are no more.
constexpr std::size_t kLargeInSpace = 60;
constexpr double kJump = 10.0;

/// Diagonals of the stiffness matrices, summed within the bodies, of each unknown of the overlap.
Vector stiffnessOf(const InterfaceSpace& torn, const LocalProblems& locals) {
  Matrix sum = Matrix::Zero(torn.overlapSize(), 1);
  for (int i = 0; i < torn.locals(); ++i)
    if (locals[i]) torn.coupling(i).addTransposed(locals[i]->stiffnessDiagonal(), sum);
  torn.sumDensities(sum);
  return sum.col(0);
}

using SparseRow = std::map<GlobalId, double>;  // by the number of the unknown

/// A matrix of some rows, by their places on this rank. Collective.
Teuchos::RCP<Crs> matrixOf(const MapPtr& map, const std::map<int, SparseRow>& rows) {
  std::vector<std::size_t> counts(map->getNodeNumElements(), 0);
  for (const auto& [place, row] : rows) counts[std::size_t(place)] = row.size();
  const auto made = Teuchos::rcp(new Crs(map, Teuchos::ArrayView<const std::size_t>(counts.data(), counts.size())));
  for (const auto& [place, row] : rows) {
    std::vector<GlobalId> columns;
    std::vector<double> values;
    for (const auto& [column, value] : row) {
      columns.push_back(column);
      values.push_back(value);
    }
    made->insertGlobalValues(map->getGlobalElement(place), static_cast<int>(values.size()), values.data(), columns.data());
  }
  made->fillComplete(map, map);
  return made;
}

/// Rows that may belong to other ranks. Collective.
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

MortarAveraging::MortarAveraging(const InterfaceSpace& space, const InterfaceSpace& torn, const LocalProblems& locals) {
  const Vector stiffness = stiffnessOf(torn, locals);
  std::vector<const InterfaceRelation*> mine;  // rows whose expressed unknown is owned here
  std::map<int, SparseRow> normals;            // owned rows of Delta_m + M^T Delta_s M: owners see all rows that name an unknown
  double least = 1e300, most = 0.0;
  for (const InterfaceRelation& relation : space.relations()) {
    if (!space.isTorn(relation)) continue;
    const double own = stiffness(relation.unknown);
    if (torn.ownedRow(relation.unknown) >= 0) mine.push_back(&relation);
    for (std::size_t k = 0; k < relation.others.size(); ++k) {
      const int place = relation.others[k];
      const double ratio = stiffness(place) / std::max(own, 1e-300);
      least = std::min(least, ratio), most = std::max(most, ratio);
      if (torn.ownedRow(place) < 0) continue;
      SparseRow& row = normals[torn.ownedRow(place)];
      row.emplace(torn.id(place), stiffness(place));
      for (std::size_t l = 0; l < relation.others.size(); ++l)
        row[torn.id(relation.others[l])] += own * relation.coefficients[k] * relation.coefficients[l];
    }
  }
  const double mineJump = std::max(most, 1.0 / std::max(least, 1e-300));
  double jump = 0.0;
  Teuchos::reduceAll(*torn.comm(), Teuchos::REDUCE_MAX, mineJump, Teuchos::outArg(jump));
  const int layers = jump > kJump ? kManyLayers : kFewLayers;
  const std::size_t large = space.dimension() == 3 ? kLargeInSpace : std::numeric_limits<std::size_t>::max();

  std::map<int, SparseRow> jumpRows;
  for (const InterfaceRelation* relation : mine) {
    expressed_.push_back(torn.ownedRow(relation->unknown));
    SparseRow& row = jumpRows[expressed_.back()];
    row[torn.id(relation->unknown)] = 1.0;
    for (std::size_t k = 0; k < relation->others.size(); ++k) row[torn.id(relation->others[k])] = -relation->coefficients[k];
  }
  jump_ = matrixOf(torn.map(), jumpRows);
  const Teuchos::RCP<const Crs> normal = matrixOf(torn.map(), normals);

  // The patch of each row grows by the neighbours of what it has.
  std::vector<std::set<GlobalId>> patches(mine.size());
  for (std::size_t r = 0; r < mine.size(); ++r)
    for (const int place : mine[r]->others) patches[r].insert(torn.id(place));
  std::map<GlobalId, SparseRow> rows;
  for (int layer = 0; layer <= layers; ++layer) {
    std::set<GlobalId> wanted;
    for (const auto& patch : patches) wanted.insert(patch.begin(), patch.end());
    rows = rowsOf(*normal, wanted, torn.comm());
    if (layer == layers) break;
    for (auto& patch : patches) {
      if (patch.size() > large) continue;
      std::set<GlobalId> grown = patch;
      for (const GlobalId id : patch)
        for (const auto& [column, value] : rows.at(id)) grown.insert(column);
      patch = std::move(grown);
    }
  }
  std::map<int, SparseRow> parts;
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
      for (int i = 0; i < n; ++i) parts[expressed_[r]][ids[i]] = solved(i, 0);
    }
  });
  parts_ = matrixOf(torn.map(), parts);
}

void MortarAveraging::makeWork(std::size_t columns) const {
  if (work_.is_null() || work_->getNumVectors() != columns) work_ = Teuchos::rcp(new MultiVector(jump_->getRowMap(), columns));
}

void MortarAveraging::apply(MultiVector& values) const {
  makeWork(values.getNumVectors());
  jump_->apply(values, *work_);
  parts_->apply(*work_, values, Teuchos::TRANS, 1.0, 1.0);
  auto view = localView(values);
  for (const int row : expressed_) view.row(row).setZero();
}

void MortarAveraging::applyTranspose(MultiVector& values) const {
  makeWork(values.getNumVectors());
  parts_->apply(values, *work_);
  auto view = localView(values);
  for (const int row : expressed_) view.row(row).setZero();
  jump_->apply(*work_, values, Teuchos::TRANS, 1.0, 1.0);
}

}  // namespace suture
