#pragma once
#include <suture/algebra/dense/AlignedVector.hpp>
#include <suture/base/Types.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace suture {

/// A matrix that a function needs until it returns, undefined at first. A single column lies in memory that the function's thread keeps for
/// its next call: inner loops allocate nothing, and an object serves several threads. Several columns are given back.
class WorkSpace {
 public:
  /// \param kept  thread_local, of one function only: functions that it calls may use work space of their own
  WorkSpace(Eigen::Index rows, Eigen::Index columns, std::vector<double>& kept) : values(room(rows, columns, kept), rows, columns) {}

 private:
  double* room(Eigen::Index rows, Eigen::Index columns, std::vector<double>& kept) {
    const std::size_t size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    if (columns > 1) {
      own_.reset(new double[size]);
      return own_.get();
    }
    if (kept.size() < size) kept.resize(size);
    return kept.data();
  }

  std::unique_ptr<double[]> own_;  // before `values`, which lie in it or in `kept`

 public:
  Eigen::Map<Matrix> values;
};

/// Room for so many numbers, undefined at first, until this thread's next call: for kernels, which call nothing that may take it from them.
/// One for all objects, so that it stays in the cache.
template <typename T>
T* kernelSpace(std::size_t size) {
  thread_local AlignedVector<T> work;
  if (work.size() < size) work.resize(size);
  return work.data();
}

}  // namespace suture
