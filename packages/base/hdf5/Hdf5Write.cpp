#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <suture/base/Collective.hpp>
#include <suture/base/MpiHandle.hpp>
#include "Hdf5Impl.hpp"

namespace suture {

using namespace hdf5;

namespace {
// Ranks write their rows in pieces as soon as these are complete. Linux caches a large write in large pages, whose first touch is slow on
// virtual machines that return free memory to their host: 190 MB take 0.05 s in pieces of 1 MiB, 0.7 s in pieces of 16.
constexpr std::size_t kPieceBytes = 1 << 20;

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

void Hdf5File::Impl::claim(const std::string& at, bool isDataset) {
  mustBeOpen(true);
  if (at.empty() || at[0] != '/' || (at.size() > 1 && at.back() == '/'))
    throw InternalError(path + ": '" + at + "' is not an absolute path");
  if (isDataset && known.count(at)) throw InternalError(path + ": '" + at + "' is written twice");
  for (const std::string& prefix : prefixes(at)) {
    if (datasets.count(prefix)) throw InternalError(path + ": '" + prefix + "' is a dataset and cannot hold '" + at + "'");
    known.insert(prefix);
  }
  if (isDataset) datasets.insert(at);
}

void Hdf5File::Impl::keep(std::function<void(Id)> action, std::size_t bytes) {
  if (!isRoot()) return;
  kept.push_back(std::move(action));
  keptBytes += bytes + kObjectBytes;
}

void Hdf5File::Impl::addAttribute(const std::string& at, const std::string& name, std::size_t bytes, std::function<void(Id)> write) {
  mustBeOpen(true);
  if (!known.count(at)) throw InternalError(path + ": attribute '" + name + "' of '" + at + "', which does not exist");
  if (!attributes.emplace(at, name).second) throw InternalError(path + ": attribute '" + name + "' of '" + at + "' is written twice");
  keep(
      [at, write](Id on) {
        const Handle object(H5Oopen(on, at.c_str(), H5P_DEFAULT), H5Oclose);
        write(object);
      },
      bytes);
}

EnvironmentError Hdf5File::Impl::cannotWrite(const std::string& at, const std::string& reason) const {
  return EnvironmentError(path + ": cannot write '" + at + "': " + reason);
}

void Hdf5File::Impl::writeOnRoot(const std::string& at, const std::function<void()>& work) const {
  collectivelyOnRoot(*comm, "writing " + path, [&] {
    const Quiet quiet;
    try {
      work();
    } catch (const Failed& failed) {
      throw cannotWrite(at, failed.reason);
    }
  });
}

void Hdf5File::Impl::reserve(unsigned long long more) const {
  hsize_t size = 0;
  checked(H5Fget_filesize(file, &size));
  const Descriptor all(::open(temporary().c_str(), O_WRONLY | O_CLOEXEC));
  const int failed = all < 0 ? errno : posix_fallocate(all, 0, static_cast<off_t>(size + more + kHeadBytes));
  if (failed != 0) throw Failed{std::strerror(failed)};
}

void Hdf5File::Impl::keepChecksums() {
  if (!checksums) return;
  std::vector<unsigned long long> all;  // the datasets of numbers are the same on all ranks, in the same order
  for (const auto& [at, sum] : sums) all.push_back(sum);
  if (comm->getSize() > 1)
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  std::size_t next = 0;
  for (const auto& [at, sum] : sums)
    addAttribute(at, checksumName, sizeof(GlobalId), integersAttribute(checksumName, {static_cast<GlobalId>(all[next++])}));
}

std::pair<unsigned long long, unsigned long long> Hdf5File::Impl::placeOf(unsigned long long mine) const {
  if (comm->getSize() == 1) return {0, mine};
  unsigned long long before = 0, total = 0;
  MPI_Exscan(&mine, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  MPI_Allreduce(&mine, &total, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  return {isRoot() ? 0 : before, total};  // MPI_Exscan leaves `before` undefined on rank 0
}

template <typename T>
struct Hdf5Rows<T>::Impl {
  void append(const std::vector<T>& values) {
    const unsigned long long given = values.size() / width;
    if (given * width != values.size() || given > end - next)
      throw InternalError(file.path + ": '" + at + "' is given " + std::to_string(values.size()) + " values in rows of " +
                          std::to_string(width) + ", of which " + std::to_string(end - next) + " are missing");
    const char* from = reinterpret_cast<const char*>(values.data());
    auto place = static_cast<off_t>(offset + next * width * sizeof(T));
    for (std::size_t left = values.size() * sizeof(T); left > 0;) {
      const ssize_t written = ::pwrite(file.descriptor, from, std::min(left, kPieceBytes), place);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) throw file.cannotWrite(at, std::strerror(written < 0 ? errno : ENOSPC));
      from += written;
      place += written;
      left -= static_cast<std::size_t>(written);
    }
    if (file.checksums) file.sums[at] += checksum(values.data(), values.size(), next * width);
    next += given;
    file.owed -= given;
  }

  Hdf5File::Impl& file;
  const std::string at;
  const unsigned long long width;
  unsigned long long next, end;  ///< rows of this rank
  unsigned long long offset;     ///< offset of the dataset in the file, in bytes
};

template <typename T>
Hdf5Rows<T>::Hdf5Rows(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
template <typename T>
Hdf5Rows<T>::Hdf5Rows(Hdf5Rows&&) noexcept = default;
template <typename T>
Hdf5Rows<T>::~Hdf5Rows() = default;

template <typename T>
void Hdf5Rows<T>::append(const std::vector<T>& values) {
  impl_->append(values);
}

void Hdf5File::addChecksums() { impl_->checksums = true; }

void Hdf5File::group(const std::string& path) {
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
Hdf5Rows<T> Hdf5File::rows(const std::string& path, GlobalId mine, int components) {
  Impl& my = *impl_;
  my.claim(path, true);
  collectively(*my.comm, "writing " + my.path, [&] {
    if (mine < 0 || components < 1)
      throw InternalError(my.path + ": '" + path + "' of " + std::to_string(mine) + " rows of " + std::to_string(components));
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
  if (my.checksums) my.sums[path] += 0;
  std::unique_ptr<typename Hdf5Rows<T>::Impl> made(new typename Hdf5Rows<T>::Impl{
      my, path, static_cast<unsigned long long>(components), place.first, place.first + static_cast<unsigned long long>(mine), offset});
  my.owed += mine;
  return Hdf5Rows<T>(std::move(made));
}

template <typename T>
void Hdf5File::writeAll(const std::string& path, const std::vector<T>& values, int components) {
  Hdf5Rows<T> all = rows<T>(path, static_cast<GlobalId>(values.size()) / std::max(components, 1), components);
  collectively(*impl_->comm, "writing " + impl_->path, [&] { all.append(values); });
}

template class Hdf5Rows<double>;
template class Hdf5Rows<int>;
template class Hdf5Rows<GlobalId>;
template class Hdf5Rows<unsigned char>;
template Hdf5Rows<double> Hdf5File::rows(const std::string&, GlobalId, int);
template Hdf5Rows<int> Hdf5File::rows(const std::string&, GlobalId, int);
template Hdf5Rows<GlobalId> Hdf5File::rows(const std::string&, GlobalId, int);
template Hdf5Rows<unsigned char> Hdf5File::rows(const std::string&, GlobalId, int);

void Hdf5File::write(const std::string& path, const std::vector<double>& values, int components) { writeAll(path, values, components); }
void Hdf5File::write(const std::string& path, const std::vector<int>& values, int components) { writeAll(path, values, components); }
void Hdf5File::write(const std::string& path, const std::vector<GlobalId>& values, int components) { writeAll(path, values, components); }
void Hdf5File::write(const std::string& path, const std::vector<unsigned char>& values, int components) {
  writeAll(path, values, components);
}

void Hdf5File::write(const std::string& path, const std::string& text) {
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

void Hdf5File::write(const std::string& path, const std::vector<std::string>& texts) {
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

void Hdf5File::attribute(const std::string& path, const std::string& name, const std::string& text) {
  impl_->addAttribute(path, name, text.size(), [name, text](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type(variableText(), H5Tclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const char* data = text.c_str();
    checked(H5Awrite(attribute, type, &data));
  });
}

void Hdf5File::fixedAttribute(const std::string& path, const std::string& name, const std::string& text) {
  impl_->addAttribute(path, name, text.size(), [name, text](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type(H5Tcopy(H5T_C_S1), H5Tclose);
    checked(H5Tset_size(type, std::max<std::size_t>(1, text.size())));
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    checked(H5Awrite(attribute, type, text.c_str()));
  });
}

void Hdf5File::attribute(const std::string& path, const std::string& name, const std::vector<GlobalId>& values) {
  impl_->addAttribute(path, name, values.size() * sizeof(GlobalId), integersAttribute(name, values));
}

void Hdf5File::attribute(const std::string& path, const std::string& name, double value) {
  impl_->addAttribute(path, name, sizeof value, [name, value](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
  });
}

}  // namespace suture
