#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace suture {

/// Hash of numbers and texts, similar to FNV-1a (Fowler, Noll, Vo) with words of 64 bits instead of bytes. It detects any single change,
/// but is not cryptographic. Local.
class Hash {
 public:
  void number(std::int64_t value) { state_ = mixed(state_, wordOf(value)); }
  /// Hashes all values and their number.
  template <typename Number>
  void numbers(const std::vector<Number>& values) {
    words(values.size(), [&](std::size_t i) { return wordOf(values[i]); });
    number(std::int64_t(values.size()));
    for (const std::uint64_t state : ways_) state_ = mixed(state_, state);
  }
  /// Hashes a short text, letter by letter.
  void text(const std::string& text) {
    number(std::int64_t(text.size()));
    for (const char letter : text) number(std::int64_t(letter));
  }
  /// Hashes `count` bytes, eight at a time.
  void bytes(const char* from, std::size_t count) {
    words(count / 8, [&](std::size_t i) {
      std::uint64_t word = 0;
      std::memcpy(&word, from + 8 * i, 8);
      return word;
    });
    number(std::int64_t(count));
    for (const std::uint64_t state : ways_) state_ = mixed(state_, state);
    for (std::size_t i = count / 8 * 8; i < count; ++i) number(std::int64_t(from[i]));
  }
  std::uint64_t value() const { return state_; }
  std::string hexadecimal() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
    return text;
  }

 private:
  /// Four independent chains, since each step waits for the product of the one before in its chain.
  template <typename WordAt>
  void words(std::size_t count, WordAt wordAt) {
    constexpr std::size_t ways = 4;
    ways_ = {1, 2, 3, 4};
    const std::size_t whole = count / ways * ways;
    for (std::size_t i = 0; i < whole; i += ways)
      for (std::size_t k = 0; k < ways; ++k) ways_[k] = mixed(ways_[k], wordAt(i + k));
    for (std::size_t i = whole; i < count; ++i) ways_[i - whole] = mixed(ways_[i - whole], wordAt(i));
  }
  template <typename Number>
  static std::uint64_t wordOf(Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
      double number = value;
      if (number == 0) number = 0;  // -0.0 is the same coordinate as 0.0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      return bits;
    } else {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
    }
  }
  // A product carries upwards only: the shift brings high bits back down.
  static std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
    state = (state ^ word) * 1099511628211ull;
    return state ^ state >> 32;
  }

  std::uint64_t state_ = 14695981039346656037ull;
  std::array<std::uint64_t, 4> ways_{};
};

}  // namespace suture
