#pragma once
#include <suture/base/Types.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

// Types common to reading and writing HDF5, without HDF5's own header. Internal to this package.

namespace suture::hdf5 {

using Id = std::int64_t;  // hid_t

/// Suppresses HDF5's error printing while errors are handled here; restores the embedding program's setting afterwards.
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

/// The innermost entry of HDF5's error stack, which gives the cause; the outer ones only name the functions that failed.
std::string complaint();

/// Thrown on one rank by a failing HDF5 call; the public functions convert it to the error that the user sees.
struct Failed {
  std::string reason;
};

template <typename Result>
Result checked(Result result) {
  if (result < 0) throw Failed{complaint()};
  return result;
}

/// An HDF5 object, closed by the destructor.
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

/// HDF5's type of T: double, int, GlobalId, unsigned char.
template <typename T>
Id memoryType();

/// Checksum of values that begin at position `first` of a dataset. The sums of parts add up to the sum of the whole, for any distribution
/// over ranks; integers of any width give the same sum.
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
