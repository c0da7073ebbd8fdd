#include "Hdf5Writer.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>
#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>

#include <suture/base/Collective.hpp>
#include <suture/base/MpiHandle.hpp>
#include "Hdf5Object.hpp"
#include "Hdf5RawFile.hpp"

namespace suture {

using namespace hdf5;

namespace {

Id createGroupsOnTheWay() {
  const Id list = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

// Stores no creation time: two equal runs write equal files.
Id datasetWithoutTime() {
  const Id list = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(list, false);
  return list;
}

Id variableText() {
  const Id type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

// HDF5 converts texts in a buffer that it fills with zeros; its default size is a megabyte, which for some texts takes longer than all
// fields of a small scene.
Id transferOfTexts() {
  const Id list = H5Pcreate(H5P_DATASET_XFER);
  H5Pset_buffer(list, 1024, nullptr, nullptr);
  return list;
}

// Bytes in addition to the numbers, per object and per file: reserved, so that HDF5 does not meet a full disk when it closes the file.
constexpr std::size_t kObjectBytes = 1024, kHeadBytes = 16384;

/// Writes an attribute of integers to an object.
std::function<void(Id)> integersAttribute(const std::string& name, const std::vector<GlobalId>& values) {
  return [name, values](Id object) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_LLONG, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (size > 0) checked(H5Awrite(attribute, H5T_NATIVE_LLONG, values.data()));
  };
}

/// A file descriptor, closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }

 private:
  int number_;
};

}  // namespace

// Rank 0 makes the datasets, every rank writes its numbers to their places in the file. Texts and attributes are kept until close() writes
// them.
struct Hdf5Writer::Impl {
  explicit Impl(const Comm& comm, const std::string& path) : comm(comm.duplicate()) { raw.path = path; }
  ~Impl() { discard(); }

  bool isRoot() const { return comm->getRank() == 0; }
  std::string temporary() const { return raw.path + ".part"; }
  void mustBeOpen() const;
  /// Removes a file that was not closed. On every rank; local.
  void discard() noexcept;

  /// Checks that a new object can be created at `at`, the same on all ranks, and records it.
  void claim(const std::string& at, bool isDataset);
  /// Keeps an action for rank 0, run after the others have closed the file.
  void keep(std::function<void(Id)> action, std::size_t bytes);
  void addAttribute(const std::string& at, const std::string& name, std::size_t bytes, std::function<void(Id)> write);
  /// Runs `work` on rank 0; a failing HDF5 call is the same EnvironmentError on all ranks.
  void writeOnRoot(const std::string& at, const std::function<void()>& work) const;
  /// Makes sure that the disk holds the file as HDF5 has laid it out, and `more` bytes. On rank 0. \throws hdf5::Failed
  void reserve(unsigned long long more) const;
  /// Adds the attributes that hold the checksums. Collective.
  void keepChecksums();
  /// First row of this rank, and total number of rows. Collective.
  std::pair<unsigned long long, unsigned long long> placeOf(unsigned long long mine) const;

  CommPtr comm;  ///< a duplicate: keeps HDF5's messages apart from the caller's
  RawFile raw;
  Id file = -1;                      ///< on rank 0 only
  std::set<std::string> known{"/"};  ///< groups and datasets made, the same on all ranks
  std::set<std::string> datasets;    ///< the datasets among `known`
  std::set<std::pair<std::string, std::string>> attributes;
  std::vector<std::function<void(Id)>> kept;  ///< on rank 0
  std::size_t keptBytes = 0;                  ///< their approximate size in the file
};

void Hdf5Writer::Impl::discard() noexcept {
  if (raw.descriptor >= 0) ::close(raw.descriptor);
  if (file < 0) return;
  const Quiet quiet;
  // H5Fclose flushes the data: a file that is discarded anyway is truncated first to release its disk space.
  static_cast<void>(::truncate(temporary().c_str(), 0) == 0);
  H5Fclose(file);
  std::remove(temporary().c_str());
}

void Hdf5Writer::Impl::mustBeOpen() const {
  if (raw.descriptor < 0) throw InternalError(raw.path + ": the file is closed");
}

void Hdf5Writer::Impl::claim(const std::string& at, bool isDataset) {
  mustBeOpen();
  if (at.empty() || at[0] != '/' || (at.size() > 1 && at.back() == '/'))
    throw InternalError(raw.path + ": '" + at + "' is not an absolute path");
  if (isDataset && known.count(at)) throw InternalError(raw.path + ": '" + at + "' is written twice");
  for (const std::string& prefix : prefixes(at)) {
    if (datasets.count(prefix)) throw InternalError(raw.path + ": '" + prefix + "' is a dataset and cannot hold '" + at + "'");
    known.insert(prefix);
  }
  if (isDataset) datasets.insert(at);
}

void Hdf5Writer::Impl::keep(std::function<void(Id)> action, std::size_t bytes) {
  if (!isRoot()) return;
  kept.push_back(std::move(action));
  keptBytes += bytes + kObjectBytes;
}

void Hdf5Writer::Impl::addAttribute(const std::string& at, const std::string& name, std::size_t bytes, std::function<void(Id)> write) {
  mustBeOpen();
  if (!known.count(at)) throw InternalError(raw.path + ": attribute '" + name + "' of '" + at + "', which does not exist");
  if (!attributes.emplace(at, name).second) throw InternalError(raw.path + ": attribute '" + name + "' of '" + at + "' is written twice");
  keep(
      [at, write](Id on) {
        const Handle object(H5Oopen(on, at.c_str(), H5P_DEFAULT), H5Oclose);
        write(object);
      },
      bytes);
}

void Hdf5Writer::Impl::writeOnRoot(const std::string& at, const std::function<void()>& work) const {
  collectivelyOnRoot(*comm, "writing " + raw.path, [&] {
    const Quiet quiet;
    try {
      work();
    } catch (const Failed& failed) {
      throw raw.cannotWrite(at, failed.reason);
    }
  });
}

void Hdf5Writer::Impl::reserve(unsigned long long more) const {
  hsize_t size = 0;
  checked(H5Fget_filesize(file, &size));
  const Descriptor all(::open(temporary().c_str(), O_WRONLY | O_CLOEXEC));
  const int failed = all < 0 ? errno : posix_fallocate(all, 0, static_cast<off_t>(size + more + kHeadBytes));
  if (failed != 0) throw Failed{std::strerror(failed)};
}

void Hdf5Writer::Impl::keepChecksums() {
  if (!raw.checksums) return;
  std::vector<unsigned long long> all;  // the datasets of numbers are the same on all ranks, in the same order
  for (const auto& [at, sum] : raw.sums) all.push_back(sum);
  if (comm->getSize() > 1)
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  std::size_t next = 0;
  for (const auto& [at, sum] : raw.sums)
    addAttribute(at, checksumName, sizeof(GlobalId), integersAttribute(checksumName, {static_cast<GlobalId>(all[next++])}));
}

std::pair<unsigned long long, unsigned long long> Hdf5Writer::Impl::placeOf(unsigned long long mine) const {
  if (comm->getSize() == 1) return {0, mine};
  unsigned long long before = 0, total = 0;
  MPI_Exscan(&mine, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  MPI_Allreduce(&mine, &total, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  return {isRoot() ? 0 : before, total};  // MPI_Exscan leaves `before` undefined on rank 0
}

Hdf5Writer::Hdf5Writer(const Comm& comm, const std::string& path) : impl_(std::make_unique<Impl>(comm, path)) {
  Impl& my = *impl_;
  collectivelyOnRoot(comm, "creating " + path, [&] {
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
      throw EnvironmentError(path + ": cannot be written: it is a folder");
    const int made = ::open(my.temporary().c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
    if (made < 0) throw EnvironmentError(path + ": cannot be written: " + std::strerror(errno));
    ::close(made);
    const Quiet quiet;
    my.file = H5Fcreate(my.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (my.file < 0) throw EnvironmentError(path + ": cannot be written: " + complaint());
  });
  collectively(comm, "creating " + path, [&] {
    my.raw.descriptor = ::open(my.temporary().c_str(), O_WRONLY | O_CLOEXEC);
    if (my.raw.descriptor < 0)
      throw EnvironmentError(path + ": cannot be written by rank " + std::to_string(comm.getRank()) + ": " + std::strerror(errno));
  });
}

Hdf5Writer::Hdf5Writer(Hdf5Writer&&) noexcept = default;
Hdf5Writer& Hdf5Writer::operator=(Hdf5Writer&&) noexcept = default;
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::addChecksums() { impl_->raw.checksums = true; }

void Hdf5Writer::group(const std::string& path) {
  Impl& my = *impl_;
  my.claim(path, false);
  my.keep(
      [path](hid_t file) {
        if (isThere(file, path)) return;
        const Handle links(createGroupsOnTheWay(), H5Pclose);
        const Handle made(H5Gcreate2(file, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
      },
      path.size());
}

template <typename T>
Hdf5Rows<T> Hdf5Writer::rows(const std::string& path, GlobalId mine, int components) {
  Impl& my = *impl_;
  my.claim(path, true);
  collectively(*my.comm, "writing " + my.raw.path, [&] {
    if (mine < 0 || components < 1)
      throw InternalError(my.raw.path + ": '" + path + "' of " + std::to_string(mine) + " rows of " + std::to_string(components));
  });
  const auto place = my.placeOf(mine);
  unsigned long long offset = 0;
  my.writeOnRoot(path, [&] {
    const hsize_t all[2] = {place.second, static_cast<hsize_t>(components)};
    const Handle space(H5Screate_simple(components == 1 ? 1 : 2, all, nullptr), H5Sclose), links(createGroupsOnTheWay(), H5Pclose);
    const Handle layout(datasetWithoutTime(), H5Pclose);
    // Contiguous, allocated early and not filled by HDF5: ranks write there themselves.
    checked(H5Pset_alloc_time(layout, H5D_ALLOC_TIME_EARLY));
    checked(H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER));
    const Handle set(H5Dcreate2(my.file, path.c_str(), memoryType<T>(), space, links, layout, H5P_DEFAULT), H5Dclose);
    if (place.second == 0) return;
    my.reserve(0);
    const haddr_t begin = H5Dget_offset(set);
    if (begin == HADDR_UNDEF) throw Failed{complaint()};
    offset = begin;
  });
  broadcastBytes(*my.comm, &offset, sizeof offset);
  if (my.raw.checksums) my.raw.sums[path] += 0;
  my.raw.owed += mine;
  return Hdf5Rows<T>(my.raw, path, components, place.first, place.first + static_cast<unsigned long long>(mine), offset);
}

template <typename T>
void Hdf5Writer::writeAll(const std::string& path, const std::vector<T>& values, int components) {
  Hdf5Rows<T> all = rows<T>(path, static_cast<GlobalId>(values.size()) / std::max(components, 1), components);
  collectively(*impl_->comm, "writing " + impl_->raw.path, [&] { all.append(values); });
}

template Hdf5Rows<double> Hdf5Writer::rows(const std::string&, GlobalId, int);
template Hdf5Rows<int> Hdf5Writer::rows(const std::string&, GlobalId, int);
template Hdf5Rows<GlobalId> Hdf5Writer::rows(const std::string&, GlobalId, int);
template Hdf5Rows<unsigned char> Hdf5Writer::rows(const std::string&, GlobalId, int);

void Hdf5Writer::write(const std::string& path, const std::vector<double>& values, int components) { writeAll(path, values, components); }
void Hdf5Writer::write(const std::string& path, const std::vector<int>& values, int components) { writeAll(path, values, components); }
void Hdf5Writer::write(const std::string& path, const std::vector<GlobalId>& values, int components) { writeAll(path, values, components); }
void Hdf5Writer::write(const std::string& path, const std::vector<unsigned char>& values, int components) {
  writeAll(path, values, components);
}

void Hdf5Writer::write(const std::string& path, const std::string& text) {
  impl_->claim(path, true);
  impl_->keep(
      [path, text](hid_t file) {
        const Handle links(createGroupsOnTheWay(), H5Pclose), space(H5Screate(H5S_SCALAR), H5Sclose);
        const Handle type(variableText(), H5Tclose), layout(datasetWithoutTime(), H5Pclose);
        const Handle set(H5Dcreate2(file, path.c_str(), type, space, links, layout, H5P_DEFAULT), H5Dclose);
        const Handle transfer(transferOfTexts(), H5Pclose);
        const char* data = text.c_str();
        checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, transfer, &data));
      },
      text.size());
}

void Hdf5Writer::write(const std::string& path, const std::vector<std::string>& texts) {
  impl_->claim(path, true);
  std::size_t bytes = 0;
  for (const std::string& text : texts) bytes += text.size();
  impl_->keep(
      [path, texts](hid_t file) {
        std::vector<const char*> data;
        for (const std::string& text : texts) data.push_back(text.c_str());
        const hsize_t count = data.size();
        const Handle links(createGroupsOnTheWay(), H5Pclose), space(H5Screate_simple(1, &count, nullptr), H5Sclose);
        const Handle type(H5Tcopy(H5T_C_S1), H5Tclose), layout(datasetWithoutTime(), H5Pclose);
        checked(H5Tset_size(type, H5T_VARIABLE));
        const Handle set(H5Dcreate2(file, path.c_str(), type, space, links, layout, H5P_DEFAULT), H5Dclose);
        const Handle transfer(transferOfTexts(), H5Pclose);
        if (count > 0) checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, transfer, data.data()));
      },
      bytes);
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, const std::string& text) {
  impl_->addAttribute(path, name, text.size(), [name, text](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type(variableText(), H5Tclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const char* data = text.c_str();
    checked(H5Awrite(attribute, type, &data));
  });
}

void Hdf5Writer::fixedAttribute(const std::string& path, const std::string& name, const std::string& text) {
  impl_->addAttribute(path, name, text.size(), [name, text](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
    checked(H5Tset_size(type, std::max<std::size_t>(1, text.size())));
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    checked(H5Awrite(attribute, type, text.c_str()));
  });
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, const std::vector<GlobalId>& values) {
  impl_->addAttribute(path, name, values.size() * sizeof(GlobalId), integersAttribute(name, values));
}

void Hdf5Writer::attribute(const std::string& path, const std::string& name, double value) {
  impl_->addAttribute(path, name, sizeof value, [name, value](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
  });
}

void Hdf5Writer::close() {
  Impl& my = *impl_;
  if (my.raw.descriptor < 0) return;
  collectively(*my.comm, "writing " + my.raw.path, [&] {
    if (my.raw.owed > 0) throw InternalError(my.raw.path + ": " + std::to_string(my.raw.owed) + " announced rows are missing");
  });
  my.keepChecksums();
  collectively(*my.comm, "writing " + my.raw.path, [&] {
    if (::close(std::exchange(my.raw.descriptor, -1)) != 0) throw my.raw.cannotWrite("/", std::strerror(errno));
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
    if (::truncate(my.temporary().c_str(), static_cast<off_t>(size)) != 0 ||
        std::rename(my.temporary().c_str(), my.raw.path.c_str()) != 0) {
      const std::string reason = std::strerror(errno);
      std::remove(my.temporary().c_str());
      throw Failed{reason};
    }
  });
}

}  // namespace suture
