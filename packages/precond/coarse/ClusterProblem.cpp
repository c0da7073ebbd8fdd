#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>
#include <suture/precond/coarse/ClusterProblem.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

/// Relative eigenvalue of null vectors: round-off of the largest entries of S; stiffness may jump by many orders between members.
constexpr double kNull = 1e-12;

class SpectralInverse : public LocalInverse {
 public:
  explicit SpectralInverse(const Matrix& schur) : pairs_(symmetricEigenpairs(schur)) {
    const double least = pairs_.values.size() > 0 ? kNull * pairs_.values.maxCoeff() : 0.0;
    for (int i = 0; i < pairs_.values.size(); ++i) pairs_.values(i) = pairs_.values(i) > least ? 1.0 / pairs_.values(i) : 0.0;
  }
  void apply(ConstLocalView flux, LocalView trace) const override {
    thread_local std::vector<double> kept;
    WorkSpace space(flux.rows(), flux.cols(), kept);
    LocalView parts = space.values;
    parts.noalias() = pairs_.vectors.transpose() * flux;
    parts.array().colwise() *= pairs_.values.array();
    trace.noalias() = pairs_.vectors * parts;
  }

 private:
  Eigenpairs pairs_;
};

}  // namespace

ClusterProblem::ClusterProblem(int id, std::vector<GlobalId> boundary, const std::vector<CoarseElement>& elements, const Matrix& motions)
    : LocalProblem(id, "cluster " + std::to_string(id), std::move(boundary)) {
  std::map<GlobalId, int> place;
  for (const CoarseElement& element : elements)
    for (const int unknown : element.unknowns) place[unknown] = -1;
  for (const GlobalId unknown : this->boundary()) place.at(unknown) = 0;
  for (auto& [unknown, at] : place)
    if (at < 0) {
      at = static_cast<int>(interior_.size());
      interior_.push_back(static_cast<int>(unknown));
    }
  const int inside = static_cast<int>(interior_.size()), all = inside + size();
  for (int k = 0; k < size(); ++k) place.at(this->boundary()[k]) = inside + k;

  std::vector<CoarseElement> placed = elements;
  for (CoarseElement& element : placed)
    for (int& unknown : element.unknowns) unknown = place.at(unknown);
  const SparseMatrix matrix = assembleCoarseElements(all, placed);
  diagonal_ = CholmodFactor::trailingDiagonal(matrix, size());
  std::vector<int> first(inside), last(size());
  for (int k = 0; k < inside; ++k) first[k] = k;
  for (int k = 0; k < size(); ++k) last[k] = inside + k;
  ib_ = block(matrix, first, last);

  CholmodOptions options;
  options.trailing = size();
  options.shift = diagonal_;  // a cluster may float
  try {
    factor_ = std::make_unique<CholmodFactor>(matrix, options);
  } catch (const NumericalError& error) {
    throw NumericalError("coarse problem, " + name() + ": " + error.what());
  }
  schur_ = factor_->trailingSchur();
  kernel_ = withoutEnergy(motions);
}

Matrix ClusterProblem::withoutEnergy(const Matrix& motions) const {
  constexpr double dependent = 1e-8;  // columns are of order one
  if (size() == 0) return Matrix(0, 0);
  const Matrix basis = orthonormalBasis(motions, dependent);
  Matrix flux(basis.rows(), basis.cols());
  applySchur(basis, flux);
  const Eigenpairs pairs = symmetricEigenpairs(basis.transpose() * flux);
  const double least = kNull * schur_.diagonal().maxCoeff();
  int nulls = 0;
  while (nulls < pairs.values.size() && pairs.values(nulls) <= least) ++nulls;
  return basis * pairs.vectors.leftCols(nulls);
}

// Column by column: Eigen allocates work space for a product of matrices.
void ClusterProblem::applySchur(ConstLocalView trace, LocalView flux) const {
  for (Eigen::Index c = 0; c < trace.cols(); ++c) flux.col(c).noalias() = schur_.selfadjointView<Eigen::Lower>() * trace.col(c);
}

std::unique_ptr<LocalInverse> ClusterProblem::inverse() const { return std::make_unique<SpectralInverse>(schur_); }

void ClusterProblem::condense(LocalView interior, LocalView flux) const {
  if (interior.rows() > 0) factor_->solveLeading(interior);
  flux.setZero();
  flux.noalias() -= ib_.transpose() * interior;
}

void ClusterProblem::recover(ConstLocalView trace, LocalView interior) const {
  if (interior.rows() == 0) return;
  interior.noalias() -= ib_ * trace;
  factor_->solveLeading(interior);
}

}  // namespace suture
