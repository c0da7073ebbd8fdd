#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "Collective.hpp"
#include "Hdf5Impl.hpp"
#include "MpiHandle.hpp"

namespace suture {

using namespace hdf5;

namespace {

// Ranks write their rows in pieces, each when it is ready. Linux caches a large write in large pages, whose first touch is slow on virtual
// machines that give free memory back to their host: 190 MB take 0.05 s in pieces of 1 MiB, 0.7 s in pieces of 16.
constexpr std::size_t kPieceBytes = 1 << 20;

Id createGroupsOnTheWay() {
  const Id list = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

Id variableText() {
  const Id type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

std::filesystem::path folderOf(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

void Hdf5File::Impl::claim(const std::string& at, bool isDataset) {
  mustBeOpen(true);
  if (at.empty() || at[0] != '/' || (at.size() > 1 && at.back() == '/')) throw InternalError(path + ": '" + at + "' is no absolute path");
  if (isDataset && known.count(at)) throw InternalError(path + ": '" + at + "' is written twice");
  for (const std::string& prefix : prefixes(at)) {
    if (datasets.count(prefix)) throw InternalError(path + ": '" + prefix + "' is a dataset and cannot hold '" + at + "'");
    known.insert(prefix);
  }
  if (isDataset) datasets.insert(at);
}

void Hdf5File::Impl::keep(std::function<void(Id)> action) {
  if (isRoot()) kept.push_back(std::move(action));
}

void Hdf5File::Impl::addAttribute(const std::string& at, const std::string& name, std::function<void(Id)> write) {
  mustBeOpen(true);
  if (!known.count(at)) throw InternalError(path + ": attribute '" + name + "' of '" + at + "', which does not exist");
  if (!attributes.emplace(at, name).second) throw InternalError(path + ": attribute '" + name + "' of '" + at + "' is written twice");
  keep([at, write](Id on) {
    const Handle object(H5Oopen(on, at.c_str(), H5P_DEFAULT), H5Oclose);
    write(object);
  });
}

EnvironmentError Hdf5File::Impl::cannotWrite(const std::string& at, std::string reason) const {
  const std::string mark = "error message = '";
  if (const std::size_t begin = reason.find(mark); begin != std::string::npos) {
    const std::size_t from = begin + mark.size();
    reason = reason.substr(from, reason.find('\'', from) - from);
  } else if (std::error_code failed; std::filesystem::space(folderOf(path), failed).available < kPieceBytes && !failed) {
    reason = std::strerror(ENOSPC);
  }
  return EnvironmentError(path + ": cannot write '" + at + "': " + reason);
}

void Hdf5File::Impl::writeTogether(const std::string& at, const std::function<void()>& work) const {
  collectively(*comm, "writing " + path, [&] {
    const Quiet quiet;
    try {
      work();
    } catch (const Failed& failed) {
      throw cannotWrite(at, failed.reason);
    }
  });
}

std::pair<unsigned long long, unsigned long long> Hdf5File::Impl::placeOf(unsigned long long mine) const {
  if (comm->getSize() == 1) return {0, mine};
  unsigned long long before = 0, total = 0;
  MPI_Exscan(&mine, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  MPI_Allreduce(&mine, &total, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, mpiComm(*comm));
  return {isRoot() ? 0 : before, total};  // MPI_Exscan leaves it undefined there
}

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

}  // namespace suture
