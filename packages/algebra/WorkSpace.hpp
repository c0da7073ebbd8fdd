#pragma once
#include <suture/algebra/dense/AlignedVector.hpp>
#include <suture/base/Types.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace suture {

/// A temporary matrix of a function, uninitialised. A single column uses memory that the function's thread keeps for its next call: inner
/// loops allocate nothing, and an object serves several threads. Memory for several columns is freed.
class WorkSpace {
 public:
  /// \param kept  thread_local and used by one function only: functions that it calls may use their own work space
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

  std::unique_ptr<double[]> own_;  // declared before `values`, which refer to it or to `kept`

 public:
  Eigen::Map<Matrix> values;
};

/// Uninitialised memory for `size` numbers, valid until this thread's next call: for kernels that call no other user of it. Shared by all
/// objects so that it stays in the cache.
template <typename T>
T* kernelSpace(std::size_t size) {
  thread_local AlignedVector<T> work;
  if (work.size() < size) work.resize(size);
  return work.data();
}

}  // namespace suture
