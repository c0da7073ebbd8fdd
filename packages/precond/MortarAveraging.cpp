#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Gather.hpp>
#include <suture/precond/MortarAveraging.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>
#include <unordered_map>

namespace suture {

namespace {

using Crs = Tpetra::CrsMatrix<>;

// Layers of neighbours in a patch. The truncated part decays from layer to layer by a factor that depends on the stiffness jumps: with
// jumps of 1e3, four layers keep the condition number within 5 % of that with the whole matrix.
constexpr int kFewLayers = 1, kManyLayers = 4;
// A layer around a patch of a surface has several times the nodes of the patch. A patch larger than the first limit does not grow, and no
// patch grows beyond the second.
constexpr std::size_t kLargeInSpace = 60, kLargestInSpace = 240;
constexpr double kJump = 10.0;
// In 3D, up to kFew unknowns are eliminated at once instead, for kAtOnce rows at a time; entries smaller than kSmall times the largest of
// their row are dropped.
constexpr std::size_t kFew = 6000, kAtOnce = 64;
constexpr double kSmall = 1e-4;

/// Diagonal of the stiffness, summed within the bodies, for each unknown of the overlap.
Vector stiffnessOf(const InterfaceSpace& broken, const LocalProblems& locals) {
  Matrix sum = Matrix::Zero(broken.overlapSize(), 1);
  for (int i = 0; i < broken.locals(); ++i)
    if (locals[i]) broken.coupling(i).addTransposed(locals[i]->stiffnessDiagonal(), sum);
  broken.sumDensities(sum);
  return sum.col(0);
}

/// A matrix row: local row number; global ids of the columns.
struct MatrixRow {
  int place;
  std::vector<GlobalId> columns;
  std::vector<double> values;
};

/// A matrix with the given rows. Collective.
Teuchos::RCP<Crs> matrixOf(const MapPtr& map, const std::vector<MatrixRow>& rows) {
  std::vector<std::size_t> counts(map->getNodeNumElements(), 0);
  for (const MatrixRow& row : rows) counts[std::size_t(row.place)] = row.columns.size();
  const auto made = Teuchos::rcp(new Crs(map, Teuchos::ArrayView<const std::size_t>(counts.data(), counts.size())));
  for (const MatrixRow& row : rows)
    made->insertGlobalValues(map->getGlobalElement(row.place), static_cast<int>(row.values.size()), row.values.data(), row.columns.data());
  made->fillComplete(map, map);
  return made;
}

using ByRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// Owned rows of Delta_m + M^T Delta_s M: the owner of an unknown has all rows of M that name it. \param m  rows x places of the overlap
std::vector<MatrixRow> normalRows(const InterfaceSpace& broken, const ByRows& m, const Vector& weights, const Vector& stiffness) {
  const ByRows weighted = weights.asDiagonal() * m, turned = m.transpose(), product = turned * weighted;
  std::vector<MatrixRow> rows;
  for (int place = 0; place < product.rows(); ++place) {
    if (broken.ownedRow(place) < 0 || product.outerIndexPtr()[place + 1] == product.outerIndexPtr()[place]) continue;
    rows.push_back({broken.ownedRow(place), {}, {}});
    rows.back().columns.reserve(std::size_t(product.outerIndexPtr()[place + 1] - product.outerIndexPtr()[place]));
    rows.back().values.reserve(rows.back().columns.capacity());
    for (ByRows::InnerIterator entry(product, place); entry; ++entry) {
      rows.back().columns.push_back(broken.id(static_cast<int>(entry.col())));
      rows.back().values.push_back(entry.value() + (entry.col() == place ? stiffness(place) : 0.0));
    }
  }
  return rows;
}

/// Copies of rows, possibly of other ranks; columns have local numbers, the rows' own unknowns first.
struct Rows {
  std::vector<GlobalId> ids;  // global id of each column
  std::unordered_map<GlobalId, int> numberOf;
  std::vector<int> start{0}, column;
  std::vector<double> value;

  int number(GlobalId id) {
    const auto [known, isNew] = numberOf.emplace(id, static_cast<int>(ids.size()));
    if (isNew) ids.push_back(id);
    return known->second;
  }
};

/// Collective. \param wanted  ascending
Rows rowsOf(const Crs& matrix, const std::vector<GlobalId>& wanted, const CommPtr& comm) {
  const MapPtr here = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                           Teuchos::ArrayView<const GlobalId>(wanted.data(), wanted.size()), 0, comm));
  const Import import(matrix.getRowMap(), here);
  const auto copy =
      Tpetra::importAndFillCompleteCrsMatrix<Crs>(Teuchos::rcpFromRef(matrix), import, matrix.getDomainMap(), matrix.getRangeMap());
  Rows rows;
  for (const GlobalId id : wanted) rows.number(id);
  rows.column.reserve(copy->getNodeNumEntries());
  rows.value.reserve(copy->getNodeNumEntries());
  for (std::size_t r = 0; r < wanted.size(); ++r) {
    Crs::local_inds_host_view_type columns;
    Crs::values_host_view_type values;
    copy->getLocalRowView(static_cast<int>(r), columns, values);
    for (std::size_t k = 0; k < columns.extent(0); ++k) {
      rows.column.push_back(rows.number(copy->getColMap()->getGlobalElement(columns(k))));
      rows.value.push_back(values(k));
    }
    rows.start.push_back(static_cast<int>(rows.column.size()));
  }
  return rows;
}

/// The unknowns of a patch and all columns of their rows, ascending.
std::vector<GlobalId> grown(const std::vector<GlobalId>& patch, const Rows& rows) {
  std::vector<char> isIn(rows.ids.size(), 0);
  std::vector<GlobalId> all;
  const auto add = [&](int number) {
    if (!isIn[number]) all.push_back(rows.ids[number]);
    isIn[number] = 1;
  };
  for (const GlobalId id : patch) {
    const int row = rows.numberOf.at(id);
    add(row);
    for (int k = rows.start[row]; k < rows.start[row + 1]; ++k) add(rows.column[k]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The submatrix of a patch. \param placeOf  work space, -1 for every column on entry and exit
Matrix patchOf(const std::vector<GlobalId>& patch, const Rows& rows, std::vector<int>& placeOf) {
  const auto n = static_cast<int>(patch.size());
  Matrix matrix = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) placeOf[rows.numberOf.at(patch[i])] = i;
  for (int i = 0; i < n; ++i) {
    const int row = rows.numberOf.at(patch[i]);
    for (int k = rows.start[row]; k < rows.start[row + 1]; ++k)
      if (const int j = placeOf[rows.column[k]]; j >= 0) matrix(i, j) = rows.value[k];
  }
  for (const GlobalId id : patch) placeOf[rows.numberOf.at(id)] = -1;
  return matrix;
}

/// A small symmetric matrix, complete on each rank: ascending unknowns and the lower triangle.
struct Whole {
  std::vector<GlobalId> ids;
  SparseMatrix lower;

  int number(GlobalId id) const { return static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); }
};

/// The rows of all ranks, each once; empty if there are too many unknowns to eliminate at once. Collective.
Whole wholeOf(const std::vector<MatrixRow>& rows, const Map& map, const Comm& comm) {
  Whole whole;
  std::vector<GlobalId> mine;
  for (const MatrixRow& row : rows) mine.push_back(map.getGlobalElement(row.place));
  whole.ids = joinEverywhere(comm, mine);
  if (whole.ids.size() > kFew) return {};
  std::sort(whole.ids.begin(), whole.ids.end());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t k = 0; k < rows[r].columns.size(); ++k)
      if (rows[r].columns[k] <= mine[r]) entries.emplace_back(whole.number(mine[r]), whole.number(rows[r].columns[k]), rows[r].values[k]);
  entries = joinEverywhere(comm, entries);
  const auto n = static_cast<Eigen::Index>(whole.ids.size());
  whole.lower = SparseMatrix(n, n);
  whole.lower.setFromTriplets(entries.begin(), entries.end());
  return whole;
}

}  // namespace

MortarAveraging::MortarAveraging(const InterfaceSpace& space, const InterfaceSpace& broken, const LocalProblems& locals) {
  const Vector stiffness = stiffnessOf(broken, locals);
  std::vector<const InterfaceRelation*> mine;   // rows whose expressed unknown this rank owns
  std::vector<Eigen::Triplet<double>> entries;  // entries of M
  std::vector<double> weights;                  // Delta_s
  double least = 1e300, most = 0.0;
  for (const InterfaceRelation& relation : space.relations()) {
    if (!space.isBroken(relation)) continue;
    const double own = stiffness(relation.unknown);
    if (broken.ownedRow(relation.unknown) >= 0) mine.push_back(&relation);
    for (std::size_t k = 0; k < relation.others.size(); ++k) {
      const double ratio = stiffness(relation.others[k]) / std::max(own, 1e-300);
      least = std::min(least, ratio), most = std::max(most, ratio);
      entries.emplace_back(static_cast<int>(weights.size()), relation.others[k], relation.coefficients[k]);
    }
    weights.push_back(own);
  }
  ByRows m(static_cast<int>(weights.size()), broken.overlapSize());
  m.setFromTriplets(entries.begin(), entries.end());
  const double mineJump = std::max(most, 1.0 / std::max(least, 1e-300));
  double jump = 0.0;
  Teuchos::reduceAll(*broken.comm(), Teuchos::REDUCE_MAX, mineJump, Teuchos::outArg(jump));
  const int layers = jump > kJump ? kManyLayers : kFewLayers;
  const std::size_t unbounded = std::numeric_limits<std::size_t>::max(), large = space.dimension() == 3 ? kLargeInSpace : unbounded,
                    largest = space.dimension() == 3 ? kLargestInSpace : unbounded;

  std::vector<MatrixRow> jumps;
  for (const InterfaceRelation* relation : mine) {
    expressed_.push_back(broken.ownedRow(relation->unknown));
    MatrixRow row{expressed_.back(), {broken.id(relation->unknown)}, {1.0}};
    for (std::size_t k = 0; k < relation->others.size(); ++k) {
      row.columns.push_back(broken.id(relation->others[k]));
      row.values.push_back(-relation->coefficients[k]);
    }
    jumps.push_back(std::move(row));
  }
  jump_ = matrixOf(broken.map(), jumps);
  const std::vector<MatrixRow> normalOfMine = normalRows(broken, m, Eigen::Map<const Vector>(weights.data(), m.rows()), stiffness);
  std::vector<MatrixRow> parts;
  // Rows of a surface name many nodes: their patches would be nearly the whole matrix.
  if (const Whole whole = space.dimension() == 3 ? wholeOf(normalOfMine, *broken.map(), *broken.comm()) : Whole(); !whole.ids.empty()) {
    const std::vector<GlobalId>& few = whole.ids;
    collectively(*broken.comm(), "sharing the jumps of a mortar", [&] {
      const CholmodFactor factor(whole.lower);
      for (std::size_t first = 0; first < mine.size(); first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, mine.size() - first);
        Matrix part = Matrix::Zero(static_cast<int>(few.size()), static_cast<int>(count));
        for (std::size_t r = 0; r < count; ++r)
          for (std::size_t k = 0; k < mine[first + r]->others.size(); ++k)
            part(whole.number(broken.id(mine[first + r]->others[k])), static_cast<int>(r)) =
                mine[first + r]->coefficients[k] * stiffness(mine[first + r]->unknown);
        factor.solve(part);
        for (std::size_t r = 0; r < count; ++r) {
          MatrixRow row{expressed_[first + r], {}, {}};
          const auto column = part.col(static_cast<int>(r));
          const double least = kSmall * column.cwiseAbs().maxCoeff();
          row.columns.reserve(std::size_t((column.array().abs() > least).count()));
          row.values.reserve(row.columns.capacity());
          for (int i = 0; i < column.size(); ++i)
            if (std::abs(column(i)) > least) {
              row.columns.push_back(few[i]);
              row.values.push_back(column(i));
            }
          parts.push_back(std::move(row));
        }
      }
    });
    parts_ = matrixOf(broken.map(), parts);
    return;
  }

  const Teuchos::RCP<const Crs> normal = matrixOf(broken.map(), normalOfMine);
  // Each layer adds the neighbours of the patch.
  std::vector<std::vector<GlobalId>> patches(mine.size());
  for (std::size_t r = 0; r < mine.size(); ++r) {
    for (const int place : mine[r]->others) patches[r].push_back(broken.id(place));
    std::sort(patches[r].begin(), patches[r].end());
  }
  Rows rows;
  for (int layer = 0; layer <= layers; ++layer) {
    std::vector<GlobalId> wanted;
    for (const auto& patch : patches) wanted.insert(wanted.end(), patch.begin(), patch.end());
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    rows = rowsOf(*normal, wanted, broken.comm());
    if (layer == layers) break;
    for (auto& patch : patches) {
      if (patch.size() > large) continue;
      std::vector<GlobalId> more = grown(patch, rows);
      if (more.size() <= largest) patch = std::move(more);
    }
  }
  collectively(*broken.comm(), "sharing the jumps of a mortar", [&] {
    std::vector<int> placeOf(rows.ids.size(), -1);
    for (std::size_t r = 0; r < mine.size(); ++r) {
      const std::vector<GlobalId>& ids = patches[r];
      const auto n = static_cast<int>(ids.size());
      const auto at = [&](GlobalId id) { return static_cast<int>(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin()); };
      Matrix part = Matrix::Zero(n, 1);
      for (std::size_t k = 0; k < mine[r]->others.size(); ++k)
        part(at(broken.id(mine[r]->others[k])), 0) = mine[r]->coefficients[k] * stiffness(mine[r]->unknown);
      const Matrix solved = solvePositive(patchOf(ids, rows, placeOf), part);
      parts.push_back({expressed_[r], ids, {solved.data(), solved.data() + n}});
    }
  });
  parts_ = matrixOf(broken.map(), parts);
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
