#pragma once
#include <suture/base/Types.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

// Types that reading and writing HDF5 have in common, without HDF5's own header. Inside this package only.

namespace suture::hdf5 {

using Id = std::int64_t;  // hid_t

/// Keeps HDF5 from printing its error stack while we look at it ourselves; the embedding program's setting comes back afterwards.
class Quiet {
 public:
  Quiet();
  ~Quiet();
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  int (*print_)(Id, void*) = nullptr;
  void* data_ = nullptr;
};

/// The innermost complaint on HDF5's error stack: the cause, where the outer ones only say which function failed.
std::string complaint();

/// Thrown on one rank by a failing HDF5 call; the public functions turn it into the error that the user sees.
struct Failed {
  std::string reason;
};

template <typename Result>
Result checked(Result result) {
  if (result < 0) throw Failed{complaint()};
  return result;
}

/// An HDF5 object that is closed when it goes.
class Handle {
 public:
  Handle(Id id, int (*close)(Id)) : id_(checked(id)), close_(close) {}
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator Id() const { return id_; }

 private:
  Id id_;
  int (*close_)(Id);
};

/// HDF5's type of the same numbers: double, int, GlobalId, unsigned char.
template <typename T>
Id memoryType();

/// Checksum of values that begin at the place `first` of a dataset. Sums of parts add up to that of the whole, on whatever ranks they are;
/// integers of any width have the same.
template <typename T>
std::uint64_t checksum(const T* values, std::size_t count, std::uint64_t first) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t word = 0;
    if constexpr (std::is_floating_point_v<T>)
      std::memcpy(&word, &values[i], sizeof(T));
    else
      word = static_cast<std::uint64_t>(static_cast<std::int64_t>(values[i]));
    word += 0x9E3779B97F4A7C15ull * (first + i + 1);  // splitmix64
    word = (word ^ (word >> 30)) * 0xBF58476D1CE4E5B9ull;
    word = (word ^ (word >> 27)) * 0x94D049BB133111EBull;
    sum += word ^ (word >> 31);
  }
  return sum;
}
constexpr const char* checksumName = "Checksum";  ///< attribute of a dataset

/// "/a/b/c" -> "/a", "/a/b", "/a/b/c".
std::vector<std::string> prefixes(const std::string& path);
bool isThere(Id file, const std::string& path);
/// Names of the members of a group, sorted. \throws Failed
std::vector<std::string> membersOf(Id file, const std::string& path);

}  // namespace suture::hdf5
