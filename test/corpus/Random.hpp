#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace suture::corpus {

/// Random numbers that are the same on every machine and with every library: SplitMix64 (Steele, Lea, Flood 2014) with its own
/// distributions, since those of the standard library differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ull + 0x632BE59BD9B4E019ull) { bits(); }

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  /// In [low, high).
  double real(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  /// In [low, high].
  int integer(int low, int high) { return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1)); }
  bool chance(double probability) { return real(0.0, 1.0) < probability; }
  /// 10^x, x in [low, high).
  double power(double low, double high) { return std::pow(10.0, real(low, high)); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

  std::vector<int> permutation(int count) {
    std::vector<int> all(count);
    for (int i = 0; i < count; ++i) all[i] = i;
    for (int i = count - 1; i > 0; --i) std::swap(all[i], all[integer(0, i)]);
    return all;
  }

 private:
  std::uint64_t state_;
};

}  // namespace suture::corpus
