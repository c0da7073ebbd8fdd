#include "Hdf5File.hpp"

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
#include <limits>
#include <set>
#include <utility>

#include "Buffer.hpp"
#include "Collective.hpp"
#include "Errors.hpp"
#include "MpiHandle.hpp"

namespace suture {
namespace {

/// Keeps HDF5 from printing its error stack while we look at it ourselves; the embedding program's setting comes back afterwards.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// The innermost complaint on HDF5's error stack: the cause, where the outer ones only say which function failed.
std::string complaint() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
        auto& first = *static_cast<std::string*>(out);
        if (first.empty() && error->desc) first = error->desc;
        return 0;
      },
      &text);
  return text.empty() ? "HDF5 gives no reason" : "HDF5: " + text;
}

/// Thrown on one rank by a failing HDF5 call; the public functions turn it into the error that the user sees.
struct Failed {
  std::string reason;
};

template <typename Result>
Result checked(Result result) {
  if (result < 0) throw Failed{complaint()};
  return result;
}

/// An HDF5 object that is closed when it goes.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(checked(id)), close_(close) {}
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// Ranks write their rows in pieces, each when it is ready. Linux caches a large write in large pages, whose first touch is slow on virtual
// machines that give free memory back to their host: 190 MB take 0.05 s in pieces of 1 MiB, 0.7 s in pieces of 16.
constexpr std::size_t kPieceBytes = 1 << 20;

template <typename T>
hid_t memoryType() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, int>) return H5T_NATIVE_INT;
  if constexpr (std::is_same_v<T, GlobalId>) return H5T_NATIVE_LLONG;
  if constexpr (std::is_same_v<T, unsigned char>) return H5T_NATIVE_UCHAR;
}

hid_t createGroupsOnTheWay() {
  const hid_t list = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

hid_t variableText() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

/// "/a/b/c" -> "/a", "/a/b", "/a/b/c".
std::vector<std::string> prefixes(const std::string& path) {
  std::vector<std::string> all;
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    all.push_back(path.substr(0, slash));
  if (path.size() > 1) all.push_back(path);
  return all;
}

bool isThere(hid_t file, const std::string& path) {
  for (const std::string& prefix : prefixes(path)) {
    if (H5Lexists(file, prefix.c_str(), H5P_DEFAULT) <= 0 || H5Oexists_by_name(file, prefix.c_str(), H5P_DEFAULT) <= 0) return false;
  }
  return true;
}

std::vector<std::string> membersOf(hid_t file, const std::string& path) {
  const Handle group(H5Gopen2(file, path.c_str(), H5P_DEFAULT), H5Gclose);
  std::vector<std::string> names;
  checked(H5Literate(
      group, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->push_back(name);
        return 0;
      },
      &names));
  std::sort(names.begin(), names.end());
  return names;
}

/// One text from a dataset or an attribute, of fixed or of variable length; `read` reads into memory of a type.
std::string textOf(hid_t fileType, hid_t space, const std::function<herr_t(hid_t, void*)>& read) {
  if (H5Tget_class(fileType) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) throw Failed{"it is not a single text"};
  if (H5Tis_variable_str(fileType) > 0) {
    const Handle type(H5Tcopy(fileType), H5Tclose);
    char* text = nullptr;
    checked(read(type, &text));
    const std::string copy = text ? text : "";
    H5free_memory(text);
    return copy;
  }
  std::string text(H5Tget_size(fileType), '\0');
  const Handle type(H5Tcopy(fileType), H5Tclose);
  checked(read(type, text.data()));
  return text.substr(0, text.find('\0'));
}

}  // namespace

struct Hdf5File::Impl {
  explicit Impl(const Comm& comm) : comm(comm.duplicate()) {}

  CommPtr comm;      ///< a duplicate: HDF5's messages and the caller's never meet
  std::string path;  ///< as the user knows it
  hid_t file = -1;   ///< when reading: on rank 0 only
  bool writing = false;

  // A file being written: every rank writes numbers at once, through MPI-IO. Texts and attributes are kept, and rank 0 writes them when
  // the others have closed the file: HDF5 cannot write texts of variable length in parallel.
  std::set<std::string> known{"/"};  ///< groups and datasets made, the same on all ranks
  std::set<std::string> datasets;    ///< of these the datasets
  std::set<std::pair<std::string, std::string>> attributes;
  std::vector<std::function<void(hid_t)>> kept;  ///< on rank 0
  unsigned long long owed = 0;                   ///< rows of this rank that were promised and not yet given

  bool isRoot() const { return comm->getRank() == 0; }
  std::string temporary() const { return path + ".part"; }

  /// Checks that something new can be put at `at`, the same on all ranks, and remembers it.
  void claim(const std::string& at, bool isDataset) {
    mustBeOpen(true);
    if (at.empty() || at[0] != '/' || (at.size() > 1 && at.back() == '/')) throw InternalError(path + ": '" + at + "' is no absolute path");
    if (isDataset && known.count(at)) throw InternalError(path + ": '" + at + "' is written twice");
    for (const std::string& prefix : prefixes(at)) {
      if (datasets.count(prefix)) throw InternalError(path + ": '" + prefix + "' is a dataset and cannot hold '" + at + "'");
      known.insert(prefix);
    }
    if (isDataset) datasets.insert(at);
  }

  void mustBeOpen(bool forWriting) const {
    const bool open = forWriting ? file >= 0 : (file >= 0 || !isRoot());
    if (!open || writing != forWriting) throw InternalError(path + ": the file is not open for " + (forWriting ? "writing" : "reading"));
  }

  void keep(std::function<void(hid_t)> action) {
    if (isRoot()) kept.push_back(std::move(action));
  }

  /// In the system's words where HDF5 hands them on; MPI-IO does not, and the commonest cause can be seen.
  EnvironmentError cannotWrite(const std::string& at, std::string reason) const {
    const std::string mark = "error message = '";
    if (const std::size_t begin = reason.find(mark); begin != std::string::npos) {
      const std::size_t from = begin + mark.size();
      reason = reason.substr(from, reason.find('\'', from) - from);
    } else if (std::error_code failed; std::filesystem::space(folderOf(path), failed).available < kPieceBytes && !failed) {
      reason = std::strerror(ENOSPC);
    }
    return EnvironmentError(path + ": cannot write '" + at + "': " + reason);
  }

  static std::filesystem::path folderOf(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder;
  }

  /// Runs `work` on every rank; a failing HDF5 call on any of them is the same EnvironmentError on all.
  void writeTogether(const std::string& at, const std::function<void()>& work) const {
    collectively(*comm, "writing " + path, [&] {
      const Quiet quiet;
      try {
        work();
      } catch (const Failed& failed) {
        throw cannotWrite(at, failed.reason);
      }
    });
  }

  /// Runs `work` on rank 0; a failing HDF5 call is the same InputError on all ranks.
  void readOnRoot(const std::string& at, const std::function<void()>& work) const {
    mustBeOpen(false);
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

  std::string missing(const std::string& at) const {
    const std::size_t slash = at.rfind('/');
    const std::string parent = slash == 0 || slash == std::string::npos ? "/" : at.substr(0, slash);
    std::vector<std::string> there;
    try {
      if (isThere(file, parent)) there = membersOf(file, parent);
    } catch (const Failed&) {  // not a group: nothing is in it
    }
    return "has no '" + at + "'." + suggestion(at.substr(slash + 1), there);
  }

  /// Where the rows of this rank begin, and how many there are on all. Collective.
  std::pair<unsigned long long, unsigned long long> placeOf(unsigned long long mine) const {
    if (comm->getSize() == 1) return {0, mine};
    unsigned long long before = 0, total = 0;
    MPI_Exscan(&mine, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
    MPI_Allreduce(&mine, &total, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
    return {isRoot() ? 0 : before, total};  // MPI_Exscan leaves it undefined there
  }

  template <typename T>
  std::vector<T> readNumbers(const std::string& at, bool wholeOnly) const {
    std::vector<T> values;
    readOnRoot(at, [&] {
      const Handle set(H5Dopen2(file, at.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle type(H5Dget_type(set), H5Tclose);
      const H5T_class_t kind = H5Tget_class(type);
      if (kind != H5T_INTEGER && (wholeOnly || kind != H5T_FLOAT))
        throw Failed{wholeOnly ? "it does not hold integers" : "it does not hold numbers"};
      const Handle space(H5Dget_space(set), H5Sclose);
      // A damaged header may ask for any size: what the file does not hold is not there to be read.
      const hssize_t count = checked(H5Sget_simple_extent_npoints(space));
      if (static_cast<unsigned long long>(count) * H5Tget_size(type) > fileSize() && H5Dget_storage_size(set) > 0 && !isFiltered(set))
        throw Failed{"it claims to be larger than the file"};
      values.resize(count);
      if (count > 0) checked(H5Dread(set, memoryType<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    });
    broadcast(*comm, values);
    return values;
  }

  /// Whether every value that the file's type can hold is an int.
  bool fitsInt(const std::string& at) const {
    int fits = 0;
    readOnRoot(at, [&] {
      const Handle set(H5Dopen2(file, at.c_str(), H5P_DEFAULT), H5Dclose);
      const Handle type(H5Dget_type(set), H5Tclose);
      if (H5Tget_class(type) != H5T_INTEGER) return;  // is told by who reads it
      const std::size_t size = H5Tget_size(type);
      fits = size < sizeof(int) || (size == sizeof(int) && H5Tget_sign(type) == H5T_SGN_2);
    });
    broadcastBytes(*comm, &fits, sizeof(fits));
    return fits != 0;
  }

  unsigned long long fileSize() const {
    std::error_code failed;
    const auto size = std::filesystem::file_size(path, failed);
    return failed ? std::numeric_limits<unsigned long long>::max() : size;
  }

  static bool isFiltered(hid_t set) {
    const Handle list(H5Dget_create_plist(set), H5Pclose);
    return H5Pget_nfilters(list) > 0;
  }

  void addAttribute(const std::string& at, const std::string& name, std::function<void(hid_t)> write) {
    mustBeOpen(true);
    if (!known.count(at)) throw InternalError(path + ": attribute '" + name + "' of '" + at + "', which does not exist");
    if (!attributes.emplace(at, name).second) throw InternalError(path + ": attribute '" + name + "' of '" + at + "' is written twice");
    keep([at, write](hid_t on) {
      const Handle object(H5Oopen(on, at.c_str(), H5P_DEFAULT), H5Oclose);
      write(object);
    });
  }

  /// Collective for a file being written.
  void closeQuietly() noexcept {
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

  ~Impl() { closeQuietly(); }
};

template <typename T>
struct Hdf5Rows<T>::Impl {
  Impl(Hdf5File::Impl& file, const std::string& at, std::pair<unsigned long long, unsigned long long> place, unsigned long long mine,
       int components)
      : file(file),
        at(at),
        width(components),
        next(place.first),
        end(place.first + mine),
        space(spaceOf(place.second), H5Sclose),
        set(create(), H5Dclose) {}

  hid_t spaceOf(unsigned long long rows) const {
    const hsize_t all[2] = {rows, width};
    return H5Screate_simple(dimensions(), all, nullptr);
  }
  hid_t create() const {
    const Handle links(createGroupsOnTheWay(), H5Pclose);
    return H5Dcreate2(file.file, at.c_str(), memoryType<T>(), space, links, H5P_DEFAULT, H5P_DEFAULT);
  }
  int dimensions() const { return width == 1 ? 1 : 2; }

  void append(const std::vector<T>& values) {
    const hsize_t given = values.size() / width, most = std::max<hsize_t>(1, kPieceBytes / (width * sizeof(T)));
    if (given * width != values.size() || given > end - next)
      throw InternalError(file.path + ": '" + at + "' is given " + std::to_string(values.size()) + " values in rows of " +
                          std::to_string(width) + ", of which " + std::to_string(end - next) + " are missing");
    for (hsize_t done = 0; done < given; done += most) {
      const hsize_t start[2] = {next, 0}, count[2] = {std::min(most, given - done), width};
      const Handle rows(H5Screate_simple(dimensions(), count, nullptr), H5Sclose);
      checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr));
      checked(H5Dwrite(set, memoryType<T>(), rows, space, H5P_DEFAULT, values.data() + done * width));
      next += count[0];
      file.owed -= count[0];
    }
  }

  Hdf5File::Impl& file;
  const std::string at;
  const hsize_t width;
  hsize_t next, end;  ///< of this rank's rows
  const Handle space, set;
};

template <typename T>
Hdf5Rows<T>::Hdf5Rows(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
template <typename T>
Hdf5Rows<T>::Hdf5Rows(Hdf5Rows&&) noexcept = default;
template <typename T>
Hdf5Rows<T>::~Hdf5Rows() {
  const Quiet quiet;
  impl_.reset();
}

template <typename T>
void Hdf5Rows<T>::append(const std::vector<T>& values) {
  const Quiet quiet;
  try {
    impl_->append(values);
  } catch (const Failed& failed) {
    throw impl_->file.cannotWrite(impl_->at, failed.reason);
  }
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

void Hdf5File::group(const std::string& path) {
  Impl& my = *impl_;
  my.claim(path, false);
  my.keep([path](hid_t file) {
    if (isThere(file, path)) return;
    const Handle links(createGroupsOnTheWay(), H5Pclose);
    const Handle made(H5Gcreate2(file, path.c_str(), links, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  });
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
  std::unique_ptr<typename Hdf5Rows<T>::Impl> made;
  my.writeTogether(path, [&] { made = std::make_unique<typename Hdf5Rows<T>::Impl>(my, path, place, mine, components); });
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
  impl_->keep([path, text](hid_t file) {
    const Handle links(createGroupsOnTheWay(), H5Pclose);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle type(variableText(), H5Tclose);
    const Handle set(H5Dcreate2(file, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    const char* data = text.c_str();
    checked(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &data));
  });
}

void Hdf5File::attribute(const std::string& path, const std::string& name, const std::string& text) {
  impl_->addAttribute(path, name, [name, text](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle type(variableText(), H5Tclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const char* data = text.c_str();
    checked(H5Awrite(attribute, type, &data));
  });
}

void Hdf5File::fixedAttribute(const std::string& path, const std::string& name, const std::string& text) {
  impl_->addAttribute(path, name, [name, text](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    checked(H5Tset_size(type, std::max<std::size_t>(1, text.size())));
    checked(H5Tset_strpad(type, H5T_STR_NULLPAD));
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    checked(H5Awrite(attribute, type, text.c_str()));
  });
}

void Hdf5File::attribute(const std::string& path, const std::string& name, const std::vector<GlobalId>& values) {
  impl_->addAttribute(path, name, [name, values](hid_t object) {
    const hsize_t size = values.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_LLONG, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (size > 0) checked(H5Awrite(attribute, H5T_NATIVE_LLONG, values.data()));
  });
}

void Hdf5File::attribute(const std::string& path, const std::string& name, double value) {
  impl_->addAttribute(path, name, [name, value](hid_t object) {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(object, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    checked(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
  });
}

std::vector<double> Hdf5File::readReals(const std::string& path) const { return impl_->readNumbers<double>(path, false); }

std::vector<GlobalId> Hdf5File::readGlobalIds(const std::string& path) const { return impl_->readNumbers<GlobalId>(path, true); }

std::vector<int> Hdf5File::readInts(const std::string& path) const {
  if (impl_->fitsInt(path)) return impl_->readNumbers<int>(path, true);
  // HDF5 would cut numbers that do not fit to the nearest that do, silently.
  const std::vector<GlobalId> wide = readGlobalIds(path);
  std::vector<int> values(wide.begin(), wide.end());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    if (values[i] != wide[i]) throw InputError(impl_->path, "'" + path + "' holds " + std::to_string(wide[i]) + ", too large for an int");
  }
  return values;
}

std::string Hdf5File::readBytes(const std::string& path, GlobalId begin, GlobalId count) const {
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

std::string Hdf5File::readText(const std::string& path) const {
  std::string text;
  impl_->readOnRoot(path, [&] {
    const Handle set(H5Dopen2(impl_->file, path.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    text = textOf(type, space, [&](hid_t memory, void* data) { return H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data); });
  });
  return broadcast(*impl_->comm, text);
}

std::string Hdf5File::readTextAttribute(const std::string& path, const std::string& name) const {
  std::string text;
  impl_->readOnRoot(path, [&] {
    const Handle object(H5Oopen(impl_->file, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (H5Aexists(object, name.c_str()) <= 0) throw InputError(impl_->path, "'" + path + "' has no attribute '" + name + "'");
    const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    text = textOf(type, space, [&](hid_t memory, void* data) { return H5Aread(attribute, memory, data); });
  });
  return broadcast(*impl_->comm, text);
}

bool Hdf5File::has(const std::string& path) const {
  impl_->mustBeOpen(false);
  int there = 0;
  collectivelyOnRoot(*impl_->comm, "reading " + impl_->path, [&] {
    const Quiet quiet;
    there = isThere(impl_->file, path);
  });
  broadcastBytes(*impl_->comm, &there, sizeof(there));
  return there != 0;
}

std::vector<std::string> Hdf5File::members(const std::string& path) const {
  Packer packer;
  impl_->readOnRoot(path, [&] {
    const std::vector<std::string> names = membersOf(impl_->file, path);
    packer.put(names);
  });
  return Unpacker(broadcast(*impl_->comm, packer.bytes())).get<std::vector<std::string>>();
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
