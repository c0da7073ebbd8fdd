#include <suture/base/Collective.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kShift = 1e-11;
constexpr int kRefinements = 3;

template <typename Take>
void forEachEntry(SparseMatrix& matrix, const Take& take) {
  for (int j = 0; j < matrix.cols(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) take(static_cast<int>(it.row()), j, it.valueRef());
}

}  // namespace

DirectCoarse::DirectCoarse(CommPtr comm, int size, std::vector<CoarseElement> elements, std::unique_ptr<LocalSolver> solver, int copies,
                           bool dependent)
    : comm_(std::move(comm)), size_(size), names_(namesIn(elements)), dependent_(dependent), solver_(std::move(solver)) {
  const int ranks = comm_->getSize(), rank = comm_->getRank();
  copies_ = copies <= 0 ? ranks : std::min(copies, ranks);
  const int share = static_cast<int>(static_cast<long long>(rank) * copies_ / ranks);
  share_ = comm_->split(share, rank);
  const bool holder = share_->getRank() == 0;

  std::vector<CoarseElement> all = gatherCoarseElements(*comm_, std::move(elements), copies_ > 1);
  collectively(*comm_, "factoring the coarse problem", [&] {
    if (!holder || size_ == 0) return;
    SparseMatrix matrix = assembleCoarseElements(size_, all);
    all = {};  // freed before the factorisation, the peak of memory use
    scale_ = Vector::Ones(size_);
    const Vector diagonal = matrix.diagonal();
    for (int i = 0; i < size_; ++i)
      if (diagonal(i) > 0.0) scale_(i) = 1.0 / std::sqrt(diagonal(i));
    forEachEntry(matrix, [&](int row, int column, double& value) { value *= scale_(row) * scale_(column); });
    if (dependent_) {
      scaled_ = matrix;
      for (int i = 0; i < size_; ++i) matrix.coeffRef(i, i) += kShift;
    }
    solver_->factorise(matrix);
  });
}

const Vector& DirectCoarse::solve(const Vector& mine) const {
  const int own = static_cast<int>(names_.size());
  answer_.resize(own);
  if (size_ == 0) return answer_;
  mine_.setZero(size_);
  for (int k = 0; k < own; ++k) mine_(names_[k]) = mine(k);
  sum_.resize(size_);
  if (copies_ == 1)
    Teuchos::reduce<int, double>(mine_.data(), sum_.data(), size_, Teuchos::REDUCE_SUM, 0, *comm_);
  else
    Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, size_, mine_.data(), sum_.data());
  if (share_->getRank() == 0) {
    load_ = scale_.cwiseProduct(sum_);
    solution_ = load_;
    solver_->solve(solution_);
    for (int k = 0; dependent_ && k < kRefinements; ++k) {
      correction_ = load_;
      correction_.noalias() -= scaled_ * solution_;
      solver_->solve(correction_);
      solution_ += correction_;
    }
    sum_ = scale_.cwiseProduct(solution_.col(0));
  }
  if (share_->getSize() > 1) Teuchos::broadcast(*share_, 0, size_, sum_.data());
  for (int k = 0; k < own; ++k) answer_(k) = sum_(names_[k]);
  return answer_;
}

void addCoarseParameters(Schema& schema) {
  schema.choice("Coarse Solver", "CHOLMOD", Registry<LocalSolver>::instance().schemas(), "Sparse direct solver of the coarse problem.");
  schema.integer("Coarse Copies", 0,
                 "Number of ranks that hold a factor of the coarse problem, each serving its share of the ranks; 0: every rank.",
                 Range::atLeast(0));
}

}  // namespace suture
