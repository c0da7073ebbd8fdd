#include "Hdf5Object.hpp"

#include <hdf5.h>

#include <algorithm>
#include <type_traits>

namespace suture::hdf5 {

static_assert(std::is_same_v<hid_t, Id> && std::is_same_v<herr_t, int>);

Quiet::Quiet() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Quiet::~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

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

template <>
Id memoryType<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
Id memoryType<int>() {
  return H5T_NATIVE_INT;
}
template <>
Id memoryType<GlobalId>() {
  return H5T_NATIVE_LLONG;
}
template <>
Id memoryType<unsigned char>() {
  return H5T_NATIVE_UCHAR;
}

std::vector<std::string> prefixes(const std::string& path) {
  std::vector<std::string> all;
  for (std::size_t slash = path.find('/', 1); slash != std::string::npos; slash = path.find('/', slash + 1))
    all.push_back(path.substr(0, slash));
  if (path.size() > 1) all.push_back(path);
  return all;
}

bool isThere(Id file, const std::string& path) {
  for (const std::string& prefix : prefixes(path)) {
    H5L_info_t link;
    if (H5Lexists(file, prefix.c_str(), H5P_DEFAULT) <= 0 || H5Lget_info(file, prefix.c_str(), &link, H5P_DEFAULT) < 0 ||
        link.type == H5L_TYPE_EXTERNAL || H5Oexists_by_name(file, prefix.c_str(), H5P_DEFAULT) <= 0)
      return false;  // links into other files are not followed
  }
  return true;
}

std::vector<std::string> membersOf(Id file, const std::string& path) {
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

}  // namespace suture::hdf5
