#include <suture/base/Errors.hpp>
#include <suture/interface/Coupling.hpp>

namespace suture {

Coupling::Coupling(std::vector<int> columns) : columns_(std::move(columns)) {}

Coupling::Coupling(std::vector<int> offsets, std::vector<int> columns, std::vector<double> coefficients, Vector shift)
    : offsets_(std::move(offsets)), columns_(std::move(columns)), coefficients_(std::move(coefficients)), shift_(std::move(shift)) {
  if (offsets_.empty() || offsets_.back() != static_cast<int>(columns_.size()) || columns_.size() != coefficients_.size() ||
      (shift_.size() != 0 && shift_.size() != rows()))
    throw InternalError("a coupling was given rows that do not fit together");
}

void Coupling::restrictTo(ConstLocalView overlap, LocalView trace) const {
  if (boolean()) {
    for (Eigen::Index c = 0; c < overlap.cols(); ++c) {
      const double* from = overlap.col(c).data();
      double* to = trace.col(c).data();
      for (std::size_t i = 0; i < columns_.size(); ++i) to[i] = from[columns_[i]];
    }
    return;
  }
  trace.setZero();
  for (int i = 0; i < rows(); ++i)
    for (int k = offsets_[i]; k < offsets_[i + 1]; ++k) trace.row(i) += coefficients_[k] * overlap.row(columns_[k]);
}

void Coupling::addTransposed(ConstLocalView flux, LocalView overlap) const {
  if (boolean()) {
    for (Eigen::Index c = 0; c < overlap.cols(); ++c) {
      const double* from = flux.col(c).data();
      double* to = overlap.col(c).data();
      for (std::size_t i = 0; i < columns_.size(); ++i) to[columns_[i]] += from[i];
    }
    return;
  }
  for (int i = 0; i < rows(); ++i)
    for (int k = offsets_[i]; k < offsets_[i + 1]; ++k) overlap.row(columns_[k]) += coefficients_[k] * flux.row(i);
}

}  // namespace suture
