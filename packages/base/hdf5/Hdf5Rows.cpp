#include "Hdf5Rows.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <suture/base/Types.hpp>
#include "Hdf5Object.hpp"
#include "Hdf5RawFile.hpp"

namespace suture {

namespace {
// Rows are written in pieces of this size. Linux caches a large write in large pages, whose first touch is slow on virtual machines that
// return free memory to their host: 190 MB take 0.05 s in pieces of 1 MiB, 0.7 s in pieces of 16.
constexpr std::size_t kPieceBytes = 1 << 20;
}  // namespace

template <typename T>
void Hdf5Rows<T>::append(const std::vector<T>& values) {
  const unsigned long long given = values.size() / width_;
  if (given * width_ != values.size() || given > end_ - next_)
    throw InternalError(file_->path + ": '" + at_ + "' is given " + std::to_string(values.size()) + " values in rows of " +
                        std::to_string(width_) + ", of which " + std::to_string(end_ - next_) + " are missing");
  const char* from = reinterpret_cast<const char*>(values.data());
  auto place = static_cast<off_t>(offset_ + next_ * width_ * sizeof(T));
  for (std::size_t left = values.size() * sizeof(T); left > 0;) {
    const ssize_t written = ::pwrite(file_->descriptor, from, std::min(left, kPieceBytes), place);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw file_->cannotWrite(at_, std::strerror(written < 0 ? errno : ENOSPC));
    from += written;
    place += written;
    left -= static_cast<std::size_t>(written);
  }
  if (file_->checksums) file_->sums[at_] += hdf5::checksum(values.data(), values.size(), next_ * width_);
  next_ += given;
  file_->owed -= given;
}

template class Hdf5Rows<double>;
template class Hdf5Rows<int>;
template class Hdf5Rows<GlobalId>;
template class Hdf5Rows<unsigned char>;

}  // namespace suture
