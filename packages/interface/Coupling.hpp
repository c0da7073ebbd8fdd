#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// R_i of one local problem: its trace = R_i U + shift, from the interface unknowns this rank sees. A sparse row map, boolean by default
/// (each boundary unknown is one interface unknown); rows with several entries or other coefficients, and a shift, express identified
/// pairs, mortar rows, rigid obstacles and gaps. Local.
class Coupling {
 public:
  Coupling() = default;
  /// Boolean: row k is the interface unknown columns[k].
  explicit Coupling(std::vector<int> columns);
  /// General rows in compressed form, and the shift of each (empty: none).
  Coupling(std::vector<int> offsets, std::vector<int> columns, std::vector<double> coefficients, Vector shift = {});

  int rows() const { return boolean() ? static_cast<int>(columns_.size()) : static_cast<int>(offsets_.size()) - 1; }
  bool boolean() const { return offsets_.empty(); }
  const std::vector<int>& columns() const { return columns_; }
  const Vector& shift() const { return shift_; }

  /// trace <- R overlap (without the shift).
  void restrictTo(ConstLocalView overlap, LocalView trace) const;
  /// overlap += R^T flux.
  void addTransposed(ConstLocalView flux, LocalView overlap) const;

 private:
  std::vector<int> offsets_, columns_;
  std::vector<double> coefficients_;
  Vector shift_;
};

}  // namespace suture
