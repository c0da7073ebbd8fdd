#include <suture/interface/Coupling.hpp>

namespace suture {

void Coupling::restrictTo(ConstLocalView overlap, LocalView trace) const {
  for (Eigen::Index c = 0; c < overlap.cols(); ++c) {
    const double* from = overlap.col(c).data();
    double* to = trace.col(c).data();
    for (std::size_t i = 0; i < columns_.size(); ++i) to[i] = from[columns_[i]];
  }
}

void Coupling::addTransposed(ConstLocalView flux, LocalView overlap) const {
  for (Eigen::Index c = 0; c < overlap.cols(); ++c) {
    const double* from = flux.col(c).data();
    double* to = overlap.col(c).data();
    for (std::size_t i = 0; i < columns_.size(); ++i) to[columns_[i]] += from[i];
  }
}

}  // namespace suture
