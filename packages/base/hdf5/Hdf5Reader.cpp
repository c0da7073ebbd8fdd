#include "Hdf5Reader.hpp"

#include <hdf5.h>
#include <unistd.h>
#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <type_traits>
#include <utility>

#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Memory.hpp>
#include "Hdf5Heaps.hpp"
#include "Hdf5Object.hpp"

namespace suture {

using namespace hdf5;

namespace {

constexpr std::size_t longestText = std::size_t(1) << 30;

/// One text from a dataset or an attribute, of fixed or variable length; `read` reads into memory of a type, `check` is called before a
/// text of variable length is read.
std::string textOf(hid_t fileType, hid_t space, const std::function<void()>& check, const std::function<herr_t(hid_t, void*)>& read) {
  if (H5Tget_class(fileType) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) throw Failed{"it is not a single text"};
  if (H5Tis_variable_str(fileType) > 0) {
    check();
    const Handle type(H5Tcopy(fileType), H5Tclose);
    char* text = nullptr;
    checked(read(type, &text));
    const std::string copy = text ? text : "";
    H5free_memory(text);
    return copy;
  }
  if (H5Tget_size(fileType) > longestText) throw Failed{"it is a text of " + std::to_string(H5Tget_size(fileType)) + " bytes"};
  std::string text(H5Tget_size(fileType), '\0');
  const Handle type(H5Tcopy(fileType), H5Tclose);
  checked(read(type, text.data()));
  return text.substr(0, text.find('\0'));
}

/// Refuses a dataset whose header claims more data than the file can hold, before memory is allocated. \throws Failed
void mustBeStored(Id set, unsigned long long count, std::size_t size, unsigned long long fileSize) {
  const Handle list(H5Dget_create_plist(set), H5Pclose);
  if (H5Pget_layout(list) == H5D_VIRTUAL || H5Pget_external_count(list) > 0) throw Failed{"its values are in another file"};
  const unsigned long long stored = H5Dget_storage_size(set);
  constexpr unsigned long long most = 1100;  // maximum compression ratio of HDF5's filters
  const unsigned long long limit = std::min(stored, fileSize) * (H5Pget_nfilters(list) > 0 ? most : 1);
  if (count > 0 && count > limit / size)
    throw Failed{"it claims to be larger than the file: " + std::to_string(count) + " values of " + std::to_string(size) + " bytes"};
}

/// Compares with the checksum stored with the dataset, if there is one. \throws Failed
void mustHaveItsChecksum(Id set, std::uint64_t found) {
  if (H5Aexists(set, checksumName) <= 0) return;
  const Handle attribute(H5Aopen(set, checksumName, H5P_DEFAULT), H5Aclose), space(H5Aget_space(attribute), H5Sclose);
  GlobalId expected = 0;
  const bool one = H5Sget_simple_extent_npoints(space) == 1;
  if (one) checked(H5Aread(attribute, H5T_NATIVE_LLONG, &expected));
  if (!one || static_cast<std::uint64_t>(expected) != found)
    throw Failed{"it is damaged: its values do not have the checksum stored with them"};
}

}  // namespace

struct Hdf5Reader::Impl {
  Impl(const Comm& comm, const std::string& path) : comm(comm.duplicate()), path(path) {}
  ~Impl() { closeQuietly(); }

  /// Closes the file. On every rank; local.
  void closeQuietly() noexcept;
  /// Runs `work` on rank 0; a failing HDF5 call is the same InputError on all ranks.
  void readOnRoot(const std::string& at, const std::function<void()>& work) const;
  /// Message for a missing object, with the nearest name. On rank 0.
  std::string missing(const std::string& at) const;
  template <typename T>
  std::vector<T> readNumbers(const std::string& at, bool wholeOnly) const;
  /// Checks, once, what HDF5 does not check before it reads a text of variable length. On rank 0. \throws hdf5::Failed
  void checkTexts() const;
  /// True if every value of the file's type fits an int.
  bool fitsInt(const std::string& at) const;
  unsigned long long fileSize() const;  ///< bytes; the largest number if unknown

  CommPtr comm;      ///< a duplicate: keeps HDF5's messages apart from the caller's
  std::string path;  ///< as given by the user
  Id file = -1;      ///< on rank 0 only
  mutable bool textsChecked = false;
};

void Hdf5Reader::Impl::closeQuietly() noexcept {
  if (file < 0) return;
  const Quiet quiet;
  H5Fclose(file);
}

void Hdf5Reader::Impl::readOnRoot(const std::string& at, const std::function<void()>& work) const {
  collectivelyOnRoot(*comm, "reading " + path, [&] {
    const Quiet quiet;
    if (!isThere(file, at)) throw InputError(path, missing(at));
    try {
      work();
    } catch (const Failed& failed) {
      throw InputError(path, "cannot read '" + at + "': " + failed.reason);
    }
  });
}

std::string Hdf5Reader::Impl::missing(const std::string& at) const {
  const std::size_t slash = at.rfind('/');
  const std::string parent = slash == 0 || slash == std::string::npos ? "/" : at.substr(0, slash);
  std::vector<std::string> there;
  try {
    if (isThere(file, parent)) there = membersOf(file, parent);
  } catch (const Failed&) {  // not a group: no members
  }
  return "has no '" + at + "'." + suggestion(at.substr(slash + 1), there);
}

template <typename T>
std::vector<T> Hdf5Reader::Impl::readNumbers(const std::string& at, bool wholeOnly) const {
  std::vector<T> values;
  readOnRoot(at, [&] {
    const Handle set(H5Dopen2(file, at.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && (wholeOnly || kind != H5T_FLOAT))
      throw Failed{wholeOnly ? "it does not hold integers" : "it does not hold numbers"};
    const Handle space(H5Dget_space(set), H5Sclose);
    const hssize_t count = checked(H5Sget_simple_extent_npoints(space));
    mustBeStored(set, static_cast<unsigned long long>(count), H5Tget_size(type), fileSize());
    mustFit(static_cast<double>(count) * sizeof(T) / (1 << 20), path + ": '" + at + "'");
    values.resize(count);
    if (count > 0) checked(H5Dread(set, memoryType<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    if ((kind == H5T_INTEGER) == std::is_integral_v<T>) mustHaveItsChecksum(set, checksum(values.data(), values.size(), 0));
  });
  broadcast(*comm, values);
  return values;
}

bool Hdf5Reader::Impl::fitsInt(const std::string& at) const {
  int fits = 0;
  readOnRoot(at, [&] {
    const Handle set(H5Dopen2(file, at.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    if (H5Tget_class(type) != H5T_INTEGER) return;  // reported when the dataset is read
    const std::size_t size = H5Tget_size(type);
    fits = size < sizeof(int) || (size == sizeof(int) && H5Tget_sign(type) == H5T_SGN_2);
  });
  broadcastBytes(*comm, &fits, sizeof(fits));
  return fits != 0;
}

void Hdf5Reader::Impl::checkTexts() const {
  if (textsChecked) return;
  const Handle made(H5Fget_create_plist(file), H5Pclose);
  std::size_t addressBytes = 0, lengthBytes = 0;
  checked(H5Pget_sizes(made, &addressBytes, &lengthBytes));
  checkHeaps(path, lengthBytes);
  textsChecked = true;
}

unsigned long long Hdf5Reader::Impl::fileSize() const {
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  return failed ? std::numeric_limits<unsigned long long>::max() : size;
}

Hdf5Reader::Hdf5Reader(const Comm& comm, const std::string& path) : impl_(std::make_unique<Impl>(comm, path)) {
  Impl& my = *impl_;
  collectivelyOnRoot(comm, "opening " + path, [&] {
    const Quiet quiet;
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) throw InputError(path, "is a folder; expected an HDF5 file");
    if (::access(path.c_str(), R_OK) != 0) throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
    if (std::error_code ignored; !std::filesystem::is_regular_file(path, ignored))
      throw InputError(path, "is not a regular file; expected an HDF5 file");
    if (H5Fis_hdf5(path.c_str()) <= 0) throw InputError(path, "is not an HDF5 file");
    my.file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (my.file < 0) throw InputError(path, "is damaged or truncated: " + complaint());
  });
}

Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;
Hdf5Reader& Hdf5Reader::operator=(Hdf5Reader&&) noexcept = default;
Hdf5Reader::~Hdf5Reader() = default;

std::vector<double> Hdf5Reader::readReals(const std::string& path) const { return impl_->readNumbers<double>(path, false); }

std::vector<GlobalId> Hdf5Reader::readGlobalIds(const std::string& path) const { return impl_->readNumbers<GlobalId>(path, true); }

std::vector<int> Hdf5Reader::readInts(const std::string& path) const {
  if (impl_->fitsInt(path)) return impl_->readNumbers<int>(path, true);
  // HDF5 would silently clip numbers that do not fit.
  const std::vector<GlobalId> wide = readGlobalIds(path);
  std::vector<int> values(wide.begin(), wide.end());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    if (values[i] != wide[i]) throw InputError(impl_->path, "'" + path + "' holds " + std::to_string(wide[i]) + ", too large for an int");
  }
  return values;
}

std::string Hdf5Reader::readBytes(const std::string& path, GlobalId begin, GlobalId count) const {
  std::string bytes;
  impl_->readOnRoot(path, [&] {
    const Handle set(H5Dopen2(impl_->file, path.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    if (H5Tget_class(type) != H5T_INTEGER || H5Tget_size(type) != 1) throw Failed{"it does not hold bytes"};
    const Handle space(H5Dget_space(set), H5Sclose);
    const auto total = static_cast<GlobalId>(checked(H5Sget_simple_extent_npoints(space)));
    if (count < 0) count = total - begin;
    if (begin < 0 || count < 0 || begin + count > total || static_cast<unsigned long long>(total) > impl_->fileSize())
      throw Failed{"it holds " + std::to_string(total) + " bytes, expected " + std::to_string(begin + std::max<GlobalId>(count, 0))};
    bytes.resize(count);
    if (count == 0) return;
    const hsize_t from = begin, size = count;
    const Handle memory(H5Screate_simple(1, &size, nullptr), H5Sclose);
    checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, &from, nullptr, &size, nullptr));
    checked(H5Dread(set, H5T_NATIVE_UCHAR, memory, space, H5P_DEFAULT, bytes.data()));
  });
  return broadcast(*impl_->comm, bytes);
}

std::string Hdf5Reader::readText(const std::string& path) const {
  std::string text;
  impl_->readOnRoot(path, [&] {
    const Handle set(H5Dopen2(impl_->file, path.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    text = textOf(
        type, space, [&] { impl_->checkTexts(); },
        [&](hid_t memory, void* data) { return H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data); });
  });
  return broadcast(*impl_->comm, text);
}

std::string Hdf5Reader::readTextAttribute(const std::string& path, const std::string& name) const {
  std::string text;
  impl_->readOnRoot(path, [&] {
    const Handle object(H5Oopen(impl_->file, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (H5Aexists(object, name.c_str()) <= 0) throw InputError(impl_->path, "'" + path + "' has no attribute '" + name + "'");
    const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    text = textOf(
        type, space, [&] { impl_->checkTexts(); }, [&](hid_t memory, void* data) { return H5Aread(attribute, memory, data); });
  });
  return broadcast(*impl_->comm, text);
}

bool Hdf5Reader::has(const std::string& path) const {
  int there = 0;
  collectivelyOnRoot(*impl_->comm, "reading " + impl_->path, [&] {
    const Quiet quiet;
    there = isThere(impl_->file, path);
  });
  broadcastBytes(*impl_->comm, &there, sizeof(there));
  return there != 0;
}

std::vector<std::string> Hdf5Reader::members(const std::string& path) const {
  Packer packer;
  impl_->readOnRoot(path, [&] {
    const std::vector<std::string> names = membersOf(impl_->file, path);
    packer.put(names);
  });
  return Unpacker(broadcast(*impl_->comm, packer.bytes())).get<std::vector<std::string>>();
}

}  // namespace suture
