#include "Hdf5File.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <suture/base/Collective.hpp>
#include "Hdf5Impl.hpp"

namespace suture {

using namespace hdf5;

void Hdf5File::Impl::mustBeOpen(bool forWriting) const {
  const bool open = file >= 0 || (!isRoot() && (!forWriting || descriptor >= 0));
  if (!open || writing != forWriting) throw InternalError(path + ": the file is not open for " + (forWriting ? "writing" : "reading"));
}

void Hdf5File::Impl::closeQuietly() noexcept {
  if (descriptor >= 0) ::close(std::exchange(descriptor, -1));
  if (file < 0) return;
  const Quiet quiet;
  // H5Fclose flushes the data: a file that is discarded anyway is truncated first to release its disk space.
  if (writing) static_cast<void>(::truncate(temporary().c_str(), 0) == 0);
  H5Fclose(file);
  file = -1;
  if (writing) std::remove(temporary().c_str());
}

Hdf5File::Hdf5File(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const Comm& comm, const std::string& path) {
  auto impl = std::make_unique<Impl>(comm);
  impl->path = path;
  impl->writing = true;
  collectivelyOnRoot(comm, "creating " + path, [&] {
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
      throw EnvironmentError(path + ": cannot be written: it is a folder");
    const int made = ::open(impl->temporary().c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
    if (made < 0) throw EnvironmentError(path + ": cannot be written: " + std::strerror(errno));
    ::close(made);
    const Quiet quiet;
    impl->file = H5Fcreate(impl->temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (impl->file < 0) throw EnvironmentError(path + ": cannot be written: " + complaint());
  });
  collectively(comm, "creating " + path, [&] {
    impl->descriptor = ::open(impl->temporary().c_str(), O_WRONLY | O_CLOEXEC);
    if (impl->descriptor < 0)
      throw EnvironmentError(path + ": cannot be written by rank " + std::to_string(comm.getRank()) + ": " + std::strerror(errno));
  });
  return Hdf5File(std::move(impl));
}

Hdf5File Hdf5File::open(const Comm& comm, const std::string& path) {
  auto impl = std::make_unique<Impl>(comm);
  impl->path = path;
  collectivelyOnRoot(comm, "opening " + path, [&] {
    const Quiet quiet;
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) throw InputError(path, "is a folder; expected an HDF5 file");
    if (::access(path.c_str(), R_OK) != 0) throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
    if (std::error_code ignored; !std::filesystem::is_regular_file(path, ignored))
      throw InputError(path, "is not a regular file; expected an HDF5 file");
    if (H5Fis_hdf5(path.c_str()) <= 0) throw InputError(path, "is not an HDF5 file");
    impl->file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (impl->file < 0) throw InputError(path, "is damaged or truncated: " + complaint());
  });
  return Hdf5File(std::move(impl));
}

void Hdf5File::close() {
  Impl& my = *impl_;
  if (!my.writing) {
    my.closeQuietly();
    return;
  }
  if (my.descriptor < 0) return;
  collectively(*my.comm, "writing " + my.path, [&] {
    if (my.owed > 0) throw InternalError(my.path + ": " + std::to_string(my.owed) + " announced rows are missing");
  });
  my.keepChecksums();
  collectively(*my.comm, "writing " + my.path, [&] {
    if (::close(std::exchange(my.descriptor, -1)) != 0) throw my.cannotWrite("/", std::strerror(errno));
  });
  my.writeOnRoot("/", [&] {
    my.reserve(my.keptBytes);
    for (const auto& action : my.kept) action(my.file);
    my.kept.clear();
    checked(H5Fflush(my.file, H5F_SCOPE_GLOBAL));
    hsize_t size = 0;
    checked(H5Fget_filesize(my.file, &size));
    checked(H5Fclose(std::exchange(my.file, -1)));
    // HDF5 does not know of the space reserved beyond its end of file.
    if (::truncate(my.temporary().c_str(), static_cast<off_t>(size)) != 0 || std::rename(my.temporary().c_str(), my.path.c_str()) != 0) {
      const std::string reason = std::strerror(errno);
      std::remove(my.temporary().c_str());
      throw Failed{reason};
    }
  });
}

void Hdf5File::withoutExitHandler() { H5dont_atexit(); }

std::string Hdf5File::libraryVersion() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace suture
