#pragma once
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace suture {

/// Allocates memory that starts at a cache line, uninitialised. Large blocks lie next to each other in huge pages if the system provides
/// them (Linux: madvise): dense matrices are read sequentially, which pages of 4 kB slow down. Two processes on an EPYC, 130 matrices of
/// 0.4 to 1.2 MB, GB/s of each, medians (smallest-largest) of eight: reading 17.0 (12.8-17.5), in huge pages 23.2 (12.6-26.2);
/// PackedSymmetric's products 14.2 (10.9-16.7) and 20.7 (14.4-22.7). Local, thread-safe. \throws std::bad_alloc
void* allocateLines(std::size_t bytes);
void freeLines(void* at, std::size_t bytes) noexcept;

/// Allocator for containers that uses allocateLines().
template <typename T>
struct LineAllocator {
  using value_type = T;

  LineAllocator() = default;
  template <typename U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(allocateLines(count * sizeof(T))); }
  void deallocate(T* at, std::size_t count) noexcept { freeLines(at, count * sizeof(T)); }
  template <typename U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <typename U, typename... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
  friend bool operator!=(const LineAllocator&, const LineAllocator&) { return false; }
};

/// Vector for kernels. resize() leaves new elements uninitialised.
template <typename T>
using AlignedVector = std::vector<T, LineAllocator<T>>;

}  // namespace suture
