#include <cholmod.h>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/CholmodHandle.hpp>
#include <suture/algebra/SerialSection.hpp>
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/elimination/PivotCheck.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/algebra/elimination/Supervariables.hpp>
#include <suture/algebra/solvers/CholmodTriangle.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace suture {

namespace {

constexpr int kLeastForMetis = 300;  // unknowns; for fewer, METIS is slower
constexpr double kSpace = 2.5;       // least unknowns per node: in 2D, where nodes have two, AMD has hardly more fill and is faster

constexpr int columnsAtOnce = 32;  // right-hand sides that share one pass over L

// CHOLMOD's view of the lower triangle of an Eigen matrix, without a copy; CHOLMOD does not write to it.
cholmod_sparse viewOf(const Eigen::SparseMatrix<double>& matrix) {
  cholmod_sparse view{};
  view.nrow = matrix.rows();
  view.ncol = matrix.cols();
  view.nzmax = matrix.nonZeros();
  view.p = const_cast<int*>(matrix.outerIndexPtr());
  view.i = const_cast<int*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

}  // namespace

struct CholmodFactor::Data : CholmodHandle {
  void order(const Eigen::SparseMatrix<double>& matrix, CholmodOptions::Ordering ordering);
  void factorise(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options);
  void judgePivots(const Vector& diagonal, PivotCheck& check);
  void solve(int upTo, LocalView rhs) const;

  std::vector<int> permutation;  // column of L -> dof
  CholmodTriangle triangle;
  Vector shift;
  Statistics statistics;
};

CholmodOptions::Ordering CholmodOptions::orderingNamed(const std::string& name) {
  return name == "METIS" ? Ordering::Metis : name == "AMD" ? Ordering::Amd : Ordering::Automatic;
}

void CholmodFactor::Data::order(const Eigen::SparseMatrix<double>& matrix, CholmodOptions::Ordering ordering) {
  const int n = statistics.size, leading = n - statistics.trailing;
  permutation.resize(n);
  std::iota(permutation.begin(), permutation.end(), 0);
  statistics.ordering = "AMD";
  if (leading == 0) return;
  // All three give a postordered elimination tree of the leading block, which remains postordered when the trailing dofs are appended. The
  // analysis of the whole matrix therefore needs no postordering, which would move the trailing dofs.
  if (ordering == CholmodOptions::Ordering::ConstrainedAmd) {
    statistics.ordering = "CAMD";
    cholmod_sparse whole = viewOf(matrix);
    std::vector<int> sets(n, 0);
    std::fill(sets.begin() + leading, sets.end(), 1);
    cholmod_camd(&whole, nullptr, 0, sets.data(), permutation.data(), common.get());
    check("ordering with CAMD");
    std::iota(permutation.begin() + leading, permutation.end(), leading);
    return;
  }
  // The unknowns of a node have the same pattern: in 3D the graph of nodes has a ninth of the entries.
  const Supervariables groups(matrix, leading);
  const Eigen::SparseMatrix<double> graph = groups.graph(matrix);
  cholmod_sparse view = viewOf(graph);
  std::vector<int> order(groups.count());
  const bool isLarge = leading >= kLeastForMetis && leading >= kSpace * groups.count();
  if (ordering == CholmodOptions::Ordering::Metis || (ordering == CholmodOptions::Ordering::Automatic && isLarge)) {
    statistics.ordering = "METIS";
    cholmod_metis(&view, nullptr, 0, 1, order.data(), common.get());
    check("ordering with METIS");
  } else {
    cholmod_amd(&view, nullptr, 0, order.data(), common.get());
    check("ordering with AMD");
  }
  groups.expand(order, permutation.data());
}

void CholmodFactor::Data::factorise(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options) {
  const int n = statistics.size, leading = n - statistics.trailing;
  const SerialSection alone;
  order(matrix, options.ordering);

  // Permuted here, because CHOLMOD would transpose a matrix that it has to permute twice: for the analysis and for the factor.
  Eigen::SparseMatrix<double> permuted = permutedLower(matrix, permutation);
  Vector diagonal = permuted.diagonal();
  if (shift.size() > 0) {
    diagonal.tail(statistics.trailing) += shift;
    for (int j = leading; j < n; ++j) permuted.coeffRef(j, j) = diagonal(j);
  }
  common->nmethods = 1;
  common->method[0].ordering = CHOLMOD_NATURAL;
  common->postorder = 0;
  common->final_ll = 1;
  common->supernodal = options.form == CholmodOptions::Form::Automatic    ? CHOLMOD_AUTO
                       : options.form == CholmodOptions::Form::Simplicial ? CHOLMOD_SIMPLICIAL
                                                                          : CHOLMOD_SUPERNODAL;
  cholmod_sparse view = viewOf(permuted);
  factor = cholmod_analyze(&view, common.get());
  check("symbolic analysis");
  statistics.flops = common->fl;
  statistics.factorEntries = common->lnz;
  cholmod_factorize(&view, factor, common.get());
  check("factorisation");
  PivotCheck pivots(n, statistics.trailing);
  if (factor->minor < factor->n) pivots.notPositive(permutation[factor->minor], static_cast<int>(factor->minor));
  triangle = CholmodTriangle(*factor);
  statistics.supernodal = triangle.isSupernodal();
  statistics.bytes = triangle.bytes();
  judgePivots(diagonal, pivots);
}

void CholmodFactor::Data::judgePivots(const Vector& diagonal, PivotCheck& check) {
  for (int j = 0; j < statistics.size; ++j) {
    const double l = triangle.pivot(j);
    check.see(permutation[j], l * l, diagonal[j]);
  }
  statistics.smallestPivot = check.smallest();
  statistics.smallestPivotDof = check.unknown();
  check.judge();
}

void CholmodFactor::Data::solve(int upTo, LocalView rhs) const {
  if (rhs.rows() != upTo)
    throw InternalError("CholmodFactor: right-hand side of " + std::to_string(rhs.rows()) + " rows for " + std::to_string(upTo) + " dofs");
  if (upTo == 0) return;
  thread_local std::vector<double> kept;
  WorkSpace space(upTo, std::min<Eigen::Index>(rhs.cols(), columnsAtOnce), kept);
  Eigen::Map<Matrix>& work = space.values;
  for (Eigen::Index first = 0; first < rhs.cols(); first += columnsAtOnce) {
    const Eigen::Index count = std::min<Eigen::Index>(columnsAtOnce, rhs.cols() - first);
    auto x = work.leftCols(count);
    for (Eigen::Index c = 0; c < count; ++c)
      for (int j = 0; j < upTo; ++j) x(j, c) = rhs(permutation[j], first + c);
    triangle.solve(x);
    for (Eigen::Index c = 0; c < count; ++c)
      for (int j = 0; j < upTo; ++j) rhs(permutation[j], first + c) = x(j, c);
  }
}

CholmodFactor::CholmodFactor(const Eigen::SparseMatrix<double>& matrix, const CholmodOptions& options) : data_(std::make_unique<Data>()) {
  const int n = static_cast<int>(matrix.rows());
  if (matrix.rows() != matrix.cols()) throw InternalError("CholmodFactor: the matrix is not square");
  if (options.trailing < 0 || options.trailing > n) throw InternalError("CholmodFactor: more trailing dofs than dofs");
  if (options.shift.size() != 0 && options.shift.size() != options.trailing)
    throw InternalError("CholmodFactor: expected one shift per trailing dof");
  data_->statistics.size = n;
  data_->statistics.trailing = options.trailing;
  data_->shift = options.shift;
  if (n == 0) return;
  if (matrix.isCompressed()) {
    data_->factorise(matrix, options);
  } else {
    Eigen::SparseMatrix<double> compressed = matrix;
    compressed.makeCompressed();
    data_->factorise(compressed, options);
  }
}

CholmodFactor::~CholmodFactor() = default;
CholmodFactor::CholmodFactor(CholmodFactor&&) noexcept = default;
CholmodFactor& CholmodFactor::operator=(CholmodFactor&&) noexcept = default;

int CholmodFactor::size() const { return data_->statistics.size; }
int CholmodFactor::trailing() const { return data_->statistics.trailing; }
const CholmodFactor::Statistics& CholmodFactor::statistics() const { return data_->statistics; }

void CholmodFactor::solve(LocalView rhs) const { data_->solve(size(), rhs); }
void CholmodFactor::solveLeading(LocalView rhs) const { data_->solve(size() - trailing(), rhs); }

Matrix CholmodFactor::trailingSchur() const {
  if (trailing() == 0) return Matrix();
  Matrix schur = data_->triangle.trailingProduct(trailing());
  if (data_->shift.size() > 0) schur.diagonal() -= data_->shift;
  return schur;
}

std::unique_ptr<SingleFactor> CholmodFactor::inSinglePrecision() const {
  return trailing() > 0 ? nullptr : data_->triangle.inSinglePrecision(data_->permutation);
}

Vector CholmodFactor::trailingDiagonal(const Eigen::SparseMatrix<double>& matrix, int trailing) { return matrix.diagonal().tail(trailing); }

}  // namespace suture
