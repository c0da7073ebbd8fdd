#pragma once
#include <suture/base/Types.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// An HDF5 file, opened for reading by all ranks of a communicator together: rank 0 reads and sends the content to the others. Paths are
/// absolute within the file ("/VTKHDF/Points"). All functions are collective over the communicator, and throw on every rank; nothing is
/// printed. Errors: InputError if the file cannot be read, is not HDF5, is truncated, or lacks the requested object (names file and path).
class Hdf5Reader {
 public:
  Hdf5Reader(const Comm& comm, const std::string& path);
  Hdf5Reader(Hdf5Reader&&) noexcept;
  Hdf5Reader& operator=(Hdf5Reader&&) noexcept;
  ~Hdf5Reader();

  /// The whole dataset on every rank.
  std::vector<double> readReals(const std::string& path) const;
  std::vector<int> readInts(const std::string& path) const;
  std::vector<GlobalId> readGlobalIds(const std::string& path) const;
  /// Bytes begin .. begin + count of a dataset of bytes; count < 0: all bytes from `begin` on.
  std::string readBytes(const std::string& path, GlobalId begin = 0, GlobalId count = -1) const;
  std::string readText(const std::string& path) const;
  std::string readTextAttribute(const std::string& path, const std::string& name) const;
  bool has(const std::string& path) const;
  /// Names of the members of a group, sorted.
  std::vector<std::string> members(const std::string& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
