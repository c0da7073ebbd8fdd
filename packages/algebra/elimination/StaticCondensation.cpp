#include <cblas.h>
#include <suture/algebra/elimination/FrontTree.hpp>
#include <suture/algebra/elimination/PartialCholesky.hpp>
#include <suture/algebra/elimination/PivotCheck.hpp>
#include <suture/algebra/elimination/StaticCondensation.hpp>

#include <algorithm>
#include <memory>
#include <numeric>

namespace suture {

namespace {

/// Consecutive rows both in one front and in the next: one loop of additions.
struct Run {
  int from, to, length;
};

/// Work space that grows without preserving or clearing its content.
class Block {
 public:
  double* reserve(std::size_t size) {
    if (size > size_) values_.reset(new double[size]);
    size_ = std::max(size, size_);
    return values_.get();
  }
  const double* data() const { return values_.get(); }

 private:
  std::unique_ptr<double[]> values_;
  std::size_t size_ = 0;
};

/// Contribution of an elimination to its parent: the lower triangle, stored by columns of full length.
struct Update {
  Block block;
  int size = 0;
};

/// Target of updates: the lower triangle of a block whose first row and column have the number `origin` in the front.
struct Target {
  double* values;
  int stride, origin;

  double* at(int row, int column) const { return values + static_cast<std::ptrdiff_t>(column - origin) * stride + (row - origin); }
};

/// The lower triangle of a permuted matrix: entries by the position of their column, in any order.
struct Moved {
  std::vector<int> start, rows;  // rows: positions
  std::vector<double> values;

  Moved(const SymmetricMatrix& matrix, const std::vector<int>& place) : start(place.size() + 1, 0) {
    const auto forEach = [&](const auto& take) {
      for (int j = 0; j < matrix.cols(); ++j)
        for (SparseMatrix::InnerIterator it(matrix.lower(), j); it; ++it) {
          const int a = place[it.row()], b = place[j];
          take(std::min(a, b), std::max(a, b), it.value());
        }
    };
    forEach([&](int column, int, double) { ++start[column + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    rows.resize(start.back());
    values.resize(start.back());
    std::vector<int> next(start.begin(), start.end() - 1);
    forEach([&](int column, int row, double value) {
      rows[next[column]] = row;
      values[next[column]++] = value;
    });
  }
};

/// Processes the fronts, children before parents: a front's contribution is kept for its parent, or added to S.
class Elimination {
 public:
  Elimination(const SymmetricMatrix& matrix, const std::vector<int>& boundary, const std::vector<Point>& places)
      : tree_(matrix, boundary, places),
        check_(matrix.rows(), static_cast<int>(boundary.size())),
        groupOf_(matrix.rows()),
        at_(tree_.groups()),
        diagonal_(matrix.diagonal()),
        children_(tree_.fronts.size()),
        updates_(tree_.fronts.size()) {
    std::vector<int> place(matrix.rows());  // position of each unknown
    for (int g = 0; g < tree_.groups(); ++g)
      for (int p = tree_.start[g]; p < tree_.start[g + 1]; ++p) {
        place[tree_.unknownAt[p]] = p;
        groupOf_[p] = g;
      }
    matrix_ = std::make_unique<Moved>(matrix, place);
    for (std::size_t f = 0; f < tree_.fronts.size(); ++f)
      if (tree_.fronts[f].parent >= 0) children_[tree_.fronts[f].parent].push_back(static_cast<int>(f));
  }

  const FrontTree& tree() const { return tree_; }
  const PivotCheck& check() const { return check_; }

  /// Eliminates the interior. `load`, by positions, becomes L^-1 f_I and the condensed load of the boundary.
  SingleFactor run(Vector& load, Matrix& schur) {
    const int interior = tree_.interior(), size = static_cast<int>(groupOf_.size()) - interior;
    schur.setZero(size, size);
    for (int b = 0; b < size; ++b)
      for (int k = matrix_->start[interior + b]; k < matrix_->start[interior + b + 1]; ++k)
        schur(matrix_->rows[k] - interior, b) = matrix_->values[k];
    const bool loaded = !load.head(interior).isZero(0.0);
    SingleFactor factor(std::vector<int>(tree_.unknownAt.begin(), tree_.unknownAt.begin() + interior));
    reserve(factor);
    for (std::size_t f = 0; f < tree_.fronts.size(); ++f) eliminate(static_cast<int>(f), load, loaded, schur, factor);
    return factor;
  }

 private:
  int groupSize(int g) const { return tree_.start[g + 1] - tree_.start[g]; }

  /// True if the front's contribution can be added to S directly, row by row.
  bool isWholeBoundary(const FrontTree::Front& front) const {
    return front.parent < 0 && front.endRow - front.firstRow == tree_.groups() - tree_.interiorGroups;
  }

  void reserve(SingleFactor& factor) const {
    std::size_t rows = 0, entries = 0;
    for (const FrontTree::Front& front : tree_.fronts) {
      int below = 0;
      for (int r = front.firstRow; r < front.endRow && tree_.rows[r] < tree_.interiorGroups; ++r) below += groupSize(tree_.rows[r]);
      rows += below;
      entries += SingleFactor::entries(tree_.start[front.endGroup] - tree_.start[front.firstGroup], below);
    }
    factor.reserve(tree_.fronts.size(), rows, entries);
  }

  void eliminate(int f, Vector& load, bool loaded, Matrix& schur, SingleFactor& factor) {
    const FrontTree::Front& front = tree_.fronts[f];
    const int first = tree_.start[front.firstGroup], columns = tree_.start[front.endGroup] - first;
    int size = 0;
    for (int g = front.firstGroup; g < front.endGroup; ++g) {
      at_[g] = size;
      size += groupSize(g);
    }
    for (int r = front.firstRow; r < front.endRow; ++r) {
      at_[tree_.rows[r]] = size;
      size += groupSize(tree_.rows[r]);
    }
    const int below = size - columns;

    // Pivot columns: entries of the matrix and the children's contributions.
    panel_.assign(static_cast<std::size_t>(size) * columns, 0.0);
    for (int j = 0; j < columns; ++j) {
      double* column = panel_.data() + static_cast<std::size_t>(j) * size;
      for (int k = matrix_->start[first + j]; k < matrix_->start[first + j + 1]; ++k) {
        const int row = matrix_->rows[k];
        column[at_[groupOf_[row]] + row - tree_.start[groupOf_[row]]] += matrix_->values[k];
      }
    }
    for (const int child : children_[f]) add(child, 0, columns, {panel_.data(), size, 0});

    const int failed = partialCholesky(columns, size, panel_.data(), size);
    if (failed > 0) check_.notPositive(tree_.unknownAt[first + failed - 1], first + failed - 1);
    for (int j = 0; j < columns; ++j) {
      const double pivot = panel_[static_cast<std::size_t>(j) * size + j];
      check_.see(tree_.unknownAt[first + j], pivot * pivot, diagonal_[tree_.unknownAt[first + j]]);
    }
    const double* rest = panel_.data() + columns;
    if (loaded) {
      double* own = load.data() + first;
      cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, columns, panel_.data(), size, own, 1);
      if (below > 0) {
        moved_.resize(below);
        cblas_dgemv(CblasColMajor, CblasNoTrans, below, columns, 1.0, rest, size, own, 1, 0.0, moved_.data(), 1);
        for (int r = front.firstRow; r < front.endRow; ++r)
          for (int k = 0; k < groupSize(tree_.rows[r]); ++k)
            load(tree_.start[tree_.rows[r]] + k) -= moved_(at_[tree_.rows[r]] - columns + k);
      }
    }

    if (below > 0 && isWholeBoundary(front)) {
      double* values = schur.data();
      symmetricRankUpdate(below, columns, rest, size, 1.0, values, below);
      for (const int child : children_[f]) add(child, columns, size, {values, below, columns});
    } else if (below > 0) {
      Update& update = updates_[f];
      if (!spare_.empty()) {
        update.block = std::move(spare_.back());
        spare_.pop_back();
      }
      update.size = below;
      double* values = update.block.reserve(static_cast<std::size_t>(below) * below);
      symmetricRankUpdate(below, columns, rest, size, 0.0, values, below);
      for (const int child : children_[f]) add(child, columns, size, {values, below, columns});
      if (front.parent < 0) {
        for (int r = front.firstRow; r < front.endRow; ++r) at_[tree_.rows[r]] = tree_.start[tree_.rows[r]] - tree_.interior();
        add(f, 0, static_cast<int>(schur.rows()), {schur.data(), static_cast<int>(schur.rows()), 0});
        release(f);
      }
    }
    for (const int child : children_[f]) release(child);

    below_.clear();
    for (int r = front.firstRow; r < front.endRow && tree_.rows[r] < tree_.interiorGroups; ++r)
      for (int k = 0; k < groupSize(tree_.rows[r]); ++k) below_.push_back(tree_.start[tree_.rows[r]] + k);
    factor.append(first, columns, below_, panel_.data(), size);
  }

  /// Adds the columns of a child's update within [begin, end) of its parent, in which its rows have positions at_.
  void add(int child, int begin, int end, Target target) {
    const FrontTree::Front& front = tree_.fronts[child];
    const Update& update = updates_[child];
    runs_.clear();
    int from = 0;
    for (int r = front.firstRow; r < front.endRow; ++r) {
      const int g = tree_.rows[r], length = groupSize(g);
      if (!runs_.empty() && runs_.back().to + runs_.back().length == at_[g])
        runs_.back().length += length;
      else
        runs_.push_back({from, at_[g], length});
      from += length;
    }
    for (std::size_t c = 0; c < runs_.size(); ++c)
      for (int k = 0; k < runs_[c].length; ++k) {
        const int to = runs_[c].to + k, j = runs_[c].from + k;
        if (to < begin) continue;
        if (to >= end) return;
        const double* source = update.block.data() + static_cast<std::size_t>(j) * update.size;
        double* piece = target.at(to, to);
        for (int i = 0; i < runs_[c].length - k; ++i) piece[i] += source[j + i];
        for (std::size_t r = c + 1; r < runs_.size(); ++r) {
          piece = target.at(runs_[r].to, to);
          for (int i = 0; i < runs_[r].length; ++i) piece[i] += source[runs_[r].from + i];
        }
      }
  }

  void release(int f) {
    updates_[f].size = 0;
    spare_.push_back(std::move(updates_[f].block));
  }

  FrontTree tree_;
  PivotCheck check_;
  std::unique_ptr<const Moved> matrix_;
  std::vector<int> groupOf_;  // group of each position
  std::vector<int> at_;       // group -> row of the current front
  std::vector<int> below_;
  Vector diagonal_, moved_;
  std::vector<std::vector<int>> children_;
  std::vector<Update> updates_;
  std::vector<Block> spare_;
  std::vector<double> panel_;
  std::vector<Run> runs_;
};

}  // namespace

StaticCondensation::StaticCondensation(const SymmetricMatrix& matrix, const Vector& load, const std::vector<int>& boundary,
                                       const std::vector<Point>& places) {
  Elimination elimination(matrix, boundary, places);
  const FrontTree& tree = elimination.tree();
  const int n = matrix.rows(), interior = tree.interior(), size = n - interior;
  Vector inOrder(n);
  for (int p = 0; p < n; ++p) inOrder(p) = load(tree.unknownAt[p]);
  Matrix ascending;
  factor_ = elimination.run(inOrder, ascending);
  elimination.check().judge();
  smallestPivot_ = elimination.check().smallest();

  interiorEnergy_ = -0.5 * inOrder.head(interior).squaredNorm();
  if (std::is_sorted(boundary.begin(), boundary.end())) {  // the order of the tree
    condensedLoad_ = inOrder.tail(size);
    schur_ = std::move(ascending);
    return;
  }
  std::vector<int> traceOf(n, -1);
  for (int b = 0; b < size; ++b) traceOf[boundary[b]] = b;
  condensedLoad_.resize(size);
  schur_.resize(size, size);
  for (int j = 0; j < size; ++j) {
    const int column = traceOf[tree.unknownAt[interior + j]];
    condensedLoad_(column) = inOrder(interior + j);
    for (int i = j; i < size; ++i) {
      const int row = traceOf[tree.unknownAt[interior + i]];
      schur_(std::max(row, column), std::min(row, column)) = ascending(i, j);
    }
  }
}

}  // namespace suture
