#pragma once
#include <support/TemporaryFolder.hpp>
#include <suture/base/Errors.hpp>

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

// Entry points of libFuzzer; the tests call them from ReplayMain.cpp.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// Runs `work`, which may refuse its input: an InputError. Any other exception is a finding, as is a crash. True if nothing was refused.
template <typename Work>
bool accepts(const Work& work) {
  try {
    work();
    return true;
  } catch (const suture::InputError&) {
    return false;
  }
}

/// Ends the process if a broken promise raises no exception.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// A folder of this process, in memory if possible, removed at the end.
class Folder {
 public:
  Folder() {
    const std::filesystem::path memory = "/dev/shm";
    path_ = suture::blocks::makeTemporaryFolder(std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path(),
                                                "suture_fuzz_");
    if (path_.empty()) std::abort();
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file there; returns its path.
  std::string file(const std::string& name, const std::uint8_t* data, std::size_t size) const {
    const std::string path = path_ + "/" + name;
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Takes small numbers from the input, zeros when it is used up: for inputs that are valid files with wrong content.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  int byte() { return at_ < size_ ? data_[at_++] : 0; }
  int number() { return byte() - 8; }
  std::vector<int> numbers() {
    std::vector<int> all(static_cast<std::size_t>(byte()));
    for (int& one : all) one = number();
    return all;
  }
  /// Mostly quarters, sometimes any double.
  double real() {
    static const double odd[] = {1e308, -1e308, 5e-324, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                 -0.0,  1e-12,  1e20};
    const int b = byte();
    return b >= 248 ? odd[b - 248] : (b - 124) / 4.0;
  }
  std::string name() { return std::string(1, static_cast<char>('a' + byte() % 4)); }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

}  // namespace fuzz
