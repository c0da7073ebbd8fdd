#pragma once
#include <Eigen/Core>

// What our own dense kernels are written with: packed matrices, supernodes, fronts. For sources only.

// One function for each generation of processors, chosen when the program is loaded: the baseline of x86-64 has vectors of two numbers.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SUTURE_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SUTURE_FOR_EACH_PROCESSOR
#endif

namespace suture {

constexpr int kSecondLevel = 2;  // where to prefetch: the second level of the cache

/// `Bytes` of numbers that are added and multiplied at once (a vector extension of GCC and Clang), anywhere in memory.
template <typename Real, int Bytes>
struct Lanes {
  typedef Real Type __attribute__((vector_size(Bytes), aligned(alignof(Real)), may_alias));
  static constexpr int count = Bytes / static_cast<int>(sizeof(Real));

  __attribute__((always_inline)) static const Type& at(const Real* from) { return *reinterpret_cast<const Type*>(from); }
  __attribute__((always_inline)) static Type& at(Real* from) { return *reinterpret_cast<Type*>(from); }
};

/// A line of the cache, and four numbers.
template <typename Real>
using Line = Lanes<Real, 64>;
template <typename Real>
using Four = Lanes<Real, 4 * sizeof(Real)>;

/// sum += the fours that a line is made of.
template <typename Real>
__attribute__((always_inline)) inline void foldInto(const typename Line<Real>::Type& line, typename Four<Real>::Type& sum) {
  const Real* from = reinterpret_cast<const Real*>(&line);
  for (int k = 0; k < Line<Real>::count; k += 4) sum += Four<Real>::at(from + k);
}

/// y -= x a, vectors of n numbers that do not overlap.
template <typename Real>
__attribute__((always_inline)) inline void subtractMultiple(int n, Real x, const Real* a, Real* y) {
  int i = 0;
  for (; i + Line<Real>::count <= n; i += Line<Real>::count) Line<Real>::at(y + i) -= x * Line<Real>::at(a + i);
  for (; i + 4 <= n; i += 4) Four<Real>::at(y + i) -= x * Four<Real>::at(a + i);
  for (; i < n; ++i) y[i] -= x * a[i];
}

/// The next multiple of `width`.
inline int padded(int size, int width) { return (size + width - 1) / width * width; }

/// By what a vector is divided before it is rounded to Real: the range of single precision is narrow, and vectors are brought to the size
/// of one. What is no number stays none.
template <typename Real, typename Values>
double scaleOf(const Values& x) {
  if (sizeof(Real) == sizeof(double) || x.size() == 0) return 1.0;
  const double largest = x.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
  return largest == 0.0 ? 1.0 : largest;
}

}  // namespace suture
