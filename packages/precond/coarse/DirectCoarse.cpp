#include <suture/base/Collective.hpp>
#include <suture/interface/InterfaceSpace.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

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
    : comm_(std::move(comm)), size_(size), dependent_(dependent), solver_(std::move(solver)) {
  const int ranks = comm_->getSize(), rank = comm_->getRank();
  copies_ = copies <= 0 ? ranks : std::min(copies, ranks);
  const int share = static_cast<int>(static_cast<long long>(rank) * copies_ / ranks);
  share_ = comm_->split(share, rank);
  const bool holder = share_->getRank() == 0;

  const std::vector<CoarseElement> all = gatherCoarseElements(*comm_, std::move(elements), copies_ > 1);
  collectively(*comm_, "factoring the coarse problem", [&] {
    if (!holder || size_ == 0) return;
    SparseMatrix matrix = assembleCoarseElements(size_, all);
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
  sum_.resize(size_);
  if (size_ == 0) return sum_;
  if (copies_ == 1)
    Teuchos::reduce<int, double>(mine.data(), sum_.data(), size_, Teuchos::REDUCE_SUM, 0, *comm_);
  else
    Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, size_, mine.data(), sum_.data());
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
  return sum_;
}

void addCoarseParameters(Schema& schema) {
  schema.choice("Coarse Solver", "CHOLMOD", Registry<LocalSolver>::instance().schemas(), "Sparse direct solver of the coarse problem.");
  schema.integer("Coarse Copies", 0, "Ranks that hold a factor of the coarse problem, each for its share of all ranks; 0: every rank.",
                 Range::atLeast(0));
}

std::vector<int> numberKeys(const CommPtr& comm, const std::vector<GlobalId>& keys, int& count) {
  using GO = Map::global_ordinal_type;
  std::vector<GO> sorted(keys.begin(), keys.end());
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  const MapPtr used = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                           Teuchos::ArrayView<const GO>(sorted.data(), sorted.size()), 0, comm));
  const MapPtr owned = Tpetra::createOneToOne(used);
  const int mine = static_cast<int>(owned->getNodeNumElements());
  int upToMine = 0;
  Teuchos::scan(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(upToMine));
  count = static_cast<int>(owned->getGlobalNumElements());
  MultiVector numbers(owned, 1), seen(used, 1);  // doubles hold them exactly
  auto values = localView(numbers);
  for (int i = 0; i < mine; ++i) values(i, 0) = upToMine - mine + i;
  seen.doImport(numbers, Import(owned, used), Tpetra::INSERT);
  const auto found = localView(static_cast<const MultiVector&>(seen));
  std::vector<int> result;
  for (const GlobalId key : keys) result.push_back(static_cast<int>(std::lround(found(used->getLocalElement(key), 0))));
  return result;
}

}  // namespace suture
