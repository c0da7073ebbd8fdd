#pragma once
#include <string>
#include <utility>
#include <vector>

namespace suture {

namespace hdf5 {
struct RawFile;
}

/// This rank's rows of a dataset being written, given piece by piece: the rows are never in memory as a whole. Made by Hdf5Writer::rows();
/// must be destroyed before the file is closed. T: double, int, GlobalId, unsigned char.
template <typename T>
class Hdf5Rows {
 public:
  Hdf5Rows(Hdf5Rows&&) noexcept = default;

  /// Local. \throws EnvironmentError  if writing fails; on this rank only: call it within collectively()
  void append(const std::vector<T>& values);

 private:
  friend class Hdf5Writer;
  Hdf5Rows(hdf5::RawFile& file, std::string at, int width, unsigned long long begin, unsigned long long end, unsigned long long offset)
      : file_(&file), at_(std::move(at)), width_(width), next_(begin), end_(end), offset_(offset) {}

  hdf5::RawFile* file_;
  std::string at_;  // path of the dataset
  unsigned long long width_;
  unsigned long long next_, end_;  // rows of this rank that are missing
  unsigned long long offset_;      // offset of the dataset in the file, in bytes
};

}  // namespace suture
