#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// R_i of one local problem, a boolean matrix: each row of its trace is one of the interface unknowns that this rank sees. Unknowns
/// expressed by others (closed pairs) are relations of the InterfaceSpace. Local.
class Coupling {
 public:
  Coupling() = default;
  /// Row k is the interface unknown columns[k].
  explicit Coupling(std::vector<int> columns) : columns_(std::move(columns)) {}

  int rows() const { return static_cast<int>(columns_.size()); }
  const std::vector<int>& columns() const { return columns_; }

  /// trace <- R overlap.
  void restrictTo(ConstLocalView overlap, LocalView trace) const;
  /// overlap += R^T flux.
  void addTransposed(ConstLocalView flux, LocalView overlap) const;

 private:
  std::vector<int> columns_;
};

}  // namespace suture
