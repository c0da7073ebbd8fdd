#include "Hdf5File.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "Collective.hpp"
#include "Hdf5Impl.hpp"
#include "MpiHandle.hpp"

namespace suture {

using namespace hdf5;

void Hdf5File::Impl::mustBeOpen(bool forWriting) const {
  const bool open = forWriting ? file >= 0 : (file >= 0 || !isRoot());
  if (!open || writing != forWriting) throw InternalError(path + ": the file is not open for " + (forWriting ? "writing" : "reading"));
}

void Hdf5File::Impl::closeQuietly() noexcept {
  if (file < 0) return;
  const Quiet quiet;
  if (writing) {
    // HDF5 writes what it knows of the file when it closes it. On a full disk that fails, ranks wait for each other and the program
    // crashes at its end: what is thrown away anyway gives the room back first.
    if (isRoot()) static_cast<void>(::truncate(temporary().c_str(), 0) == 0);
    comm->barrier();
  }
  H5Fclose(file);
  file = -1;
  if (writing && isRoot()) std::remove(temporary().c_str());
}

Hdf5File::Hdf5File(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Hdf5File::Hdf5File(Hdf5File&&) noexcept = default;
Hdf5File& Hdf5File::operator=(Hdf5File&&) noexcept = default;
Hdf5File::~Hdf5File() = default;

Hdf5File Hdf5File::create(const Comm& comm, const std::string& path) {
  auto impl = std::make_unique<Impl>(comm);
  impl->path = path;
  impl->writing = true;
  // Whether the place can be written to is found out by one rank and in plain words; MPI-IO's are not meant for users.
  collectivelyOnRoot(comm, "creating " + path, [&] {
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
      throw EnvironmentError(path + ": cannot be written: it is a folder");
    const int descriptor = ::open(impl->temporary().c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
    if (descriptor < 0) throw EnvironmentError(path + ": cannot be written: " + std::strerror(errno));
    ::close(descriptor);
  });
  std::string reason;
  {
    const Quiet quiet;
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (impl->comm->getSize() > 1) H5Pset_fapl_mpio(access, mpiComm(*impl->comm), MPI_INFO_NULL);
    // Rows go to the file at once: what HDF5 would keep of small pieces it could fail to write later, where nobody hears of it, and a
    // dataset that cannot be closed crashes the program at its end.
    H5Pset_sieve_buf_size(access, 0);
    impl->file = H5Fcreate(impl->temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    if (impl->file < 0) reason = complaint();
    H5Pclose(access);
  }
  collectively(comm, "creating " + path, [&] {
    if (impl->file < 0) throw EnvironmentError(path + ": cannot be written: " + reason);
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
    if (H5Fis_hdf5(path.c_str()) <= 0) throw InputError(path, "is not an HDF5 file");
    impl->file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (impl->file < 0) throw InputError(path, "is damaged or cut off: " + complaint());
  });
  return Hdf5File(std::move(impl));
}

void Hdf5File::close() {
  Impl& my = *impl_;
  if (!my.writing) {
    my.closeQuietly();
    return;
  }
  if (my.file < 0) return;
  collectively(*my.comm, "writing " + my.path, [&] {
    if (my.owed > 0) throw InternalError(my.path + ": " + std::to_string(my.owed) + " rows were promised and not given");
  });
  bool closed = false;
  my.writeTogether("/", [&] {
    closed = H5Fclose(std::exchange(my.file, -1)) >= 0;
    if (!closed) throw Failed{complaint()};
  });
  collectivelyOnRoot(*my.comm, "writing " + my.path, [&] {
    const Quiet quiet;
    try {
      {
        const Handle file(H5Fopen(my.temporary().c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
        for (const auto& action : my.kept) action(file);
        checked(H5Fflush(file, H5F_SCOPE_GLOBAL));
      }
      my.kept.clear();
      if (std::rename(my.temporary().c_str(), my.path.c_str()) != 0) throw Failed{std::strerror(errno)};
    } catch (const Failed& failed) {
      std::remove(my.temporary().c_str());
      throw EnvironmentError(my.path + ": cannot be written: " + failed.reason);
    }
  });
}

std::string Hdf5File::libraryVersion() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace suture
