#pragma once

// SIMD vectors for the dense kernels: packed matrices, supernodes, fronts. For sources only.

// Compiles a function once per processor generation, selected when the program is loaded: baseline x86-64 has vectors of two doubles; "fma"
// has vectors of four and fused multiply-add.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SUTURE_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define SUTURE_FOR_EACH_PROCESSOR
#endif

#ifdef __clang__
#pragma clang diagnostic ignored "-Wpsabi"  // all of it is inlined: no such vector is passed in a call
#endif

namespace suture {

constexpr int kWidth = 4;  ///< columns of a panel of a packed matrix, processed in one pass over x and y

/// `Bytes` bytes of numbers that are added and multiplied together (a vector extension of GCC and Clang), at any address.
template <typename Real, int Bytes>
struct Lanes {
  static constexpr int count = Bytes / static_cast<int>(sizeof(Real));

#ifdef __clang__
  // Clang assumes that a vector behind a reference is aligned to its size, even if its type has less; a packed structure may be unaligned.
  typedef Real Type __attribute__((vector_size(Bytes), may_alias));
  struct __attribute__((packed, may_alias)) Place {
    Type value;
    __attribute__((always_inline)) operator Type() const { return value; }
    __attribute__((always_inline)) void operator=(Type x) { value = x; }
    __attribute__((always_inline)) void operator+=(Type x) { value = value + x; }
    __attribute__((always_inline)) void operator-=(Type x) { value = value - x; }
    __attribute__((always_inline)) void operator*=(Real x) { value = value * x; }
    __attribute__((always_inline)) friend Type operator*(const Place& a, Real b) { return a.value * b; }
    __attribute__((always_inline)) friend Type operator*(Real a, const Place& b) { return a * b.value; }
  };
  __attribute__((always_inline)) static Type at(const Real* from) { return reinterpret_cast<const Place*>(from)->value; }
  __attribute__((always_inline)) static Place& at(Real* from) { return *reinterpret_cast<Place*>(from); }
#else
  typedef Real Type __attribute__((vector_size(Bytes), aligned(alignof(Real)), may_alias));
  __attribute__((always_inline)) static const Type& at(const Real* from) { return *reinterpret_cast<const Type*>(from); }
  __attribute__((always_inline)) static Type& at(Real* from) { return *reinterpret_cast<Type*>(from); }
#endif
};

/// A cache line, and four numbers.
template <typename Real>
using Line = Lanes<Real, 64>;
template <typename Real>
using Four = Lanes<Real, 4 * sizeof(Real)>;

/// sum += the groups of four of a line.
template <typename Real>
__attribute__((always_inline)) inline void foldInto(const typename Line<Real>::Type& line, typename Four<Real>::Type& sum) {
  const Real* from = reinterpret_cast<const Real*>(&line);
  for (int k = 0; k < Line<Real>::count; k += 4) sum += Four<Real>::at(from + k);
}

/// Numbers that fit one register of processors without 64-byte vectors. GCC keeps the halves of longer vectors in memory: a scalar product
/// of 170 numbers then takes five times as long.
template <typename Real>
using Register = Lanes<Real, 32>;

/// y -= x a, vectors of n numbers that do not overlap.
template <typename Real>
__attribute__((always_inline)) inline void subtractMultiple(int n, Real x, const Real* a, Real* y) {
  constexpr int width = Register<Real>::count;
  int i = 0;
  for (; i + width <= n; i += width) Register<Real>::at(y + i) -= x * Register<Real>::at(a + i);
  for (; i < n; ++i) y[i] -= x * a[i];
}

/// y -= x[0] a + x[1] b + x[2] c + x[3] d: reads and writes y once instead of four times.
template <typename Real>
__attribute__((always_inline)) inline void subtractMultiples(int n, const Real* x, const Real* a, const Real* b, const Real* c,
                                                             const Real* d, Real* y) {
  using Many = Register<Real>;
  int i = 0;
  for (; i + Many::count <= n; i += Many::count)
    Many::at(y + i) -= (x[0] * Many::at(a + i) + x[1] * Many::at(b + i)) + (x[2] * Many::at(c + i) + x[3] * Many::at(d + i));
  for (; i < n; ++i) y[i] -= (x[0] * a[i] + x[1] * b[i]) + (x[2] * c[i] + x[3] * d[i]);
}

/// a . b for n numbers.
template <typename Real>
__attribute__((always_inline)) inline Real scalarProduct(int n, const Real* a, const Real* b) {
  constexpr int width = Register<Real>::count;
  typename Register<Real>::Type s0 = {}, s1 = {}, s2 = {}, s3 = {};
  int i = 0;
  for (; i + 4 * width <= n; i += 4 * width) {
    s0 += Register<Real>::at(a + i) * Register<Real>::at(b + i);
    s1 += Register<Real>::at(a + i + width) * Register<Real>::at(b + i + width);
    s2 += Register<Real>::at(a + i + 2 * width) * Register<Real>::at(b + i + 2 * width);
    s3 += Register<Real>::at(a + i + 3 * width) * Register<Real>::at(b + i + 3 * width);
  }
  for (; i + width <= n; i += width) s0 += Register<Real>::at(a + i) * Register<Real>::at(b + i);
  s0 = (s0 + s1) + (s2 + s3);
  Real sum = 0;
  for (int k = 0; k < width; ++k) sum += s0[k];
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// The next multiple of `width`.
inline int padded(int size, int width) { return (size + width - 1) / width * width; }

/// Largest magnitude of n numbers, by which they are divided before conversion to Real, since the range of single precision is narrow; 1
/// for double precision. NaNs are skipped and stay NaN.
template <typename Real>
__attribute__((always_inline)) inline double scaleOf(int n, const double* x) {
  if (sizeof(Real) == sizeof(double)) return 1.0;
  using Many = Line<double>;
  typename Many::Type most = {};
  int i = 0;
  for (; i + Many::count <= n; i += Many::count) {
    const typename Many::Type plus = Many::at(x + i), minus = -plus, size = plus > minus ? plus : minus;
    most = size > most ? size : most;
  }
  double largest = 0.0;
  for (int k = 0; k < Many::count; ++k) largest = most[k] > largest ? most[k] : largest;
  for (; i < n; ++i) {
    const double size = x[i] > 0.0 ? x[i] : -x[i];
    largest = size > largest ? size : largest;
  }
  return largest == 0.0 ? 1.0 : largest;
}

/// to <- x / scale
template <typename Real>
__attribute__((always_inline)) inline void divide(int n, const double* x, double scale, Real* to) {
  using Many = Line<double>;
  using Rounded = Lanes<Real, Many::count * sizeof(Real)>;
  int i = 0;
  for (; i + Many::count <= n; i += Many::count)
    Rounded::at(to + i) = __builtin_convertvector(Many::at(x + i) / scale, typename Rounded::Type);
  for (; i < n; ++i) to[i] = static_cast<Real>(x[i] / scale);
}

/// to <- share * to + scale * x; share is 0 (`to` is not read) or 1.
template <int share, typename Real>
__attribute__((always_inline)) inline void multiply(int n, double scale, const Real* x, double* to) {
  using Many = Line<double>;
  using Rounded = Lanes<Real, Many::count * sizeof(Real)>;
  int i = 0;
  for (; i + Many::count <= n; i += Many::count) {
    const typename Many::Type y = scale * __builtin_convertvector(Rounded::at(x + i), typename Many::Type);
    if (share == 0)
      Many::at(to + i) = y;
    else
      Many::at(to + i) += y;
  }
  for (; i < n; ++i) to[i] = (share == 0 ? 0.0 : to[i]) + scale * static_cast<double>(x[i]);
}

}  // namespace suture
