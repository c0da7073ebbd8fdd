#include <suture/base/Buffer.hpp>
#include <suture/base/Errors.hpp>
#include <suture/reader/gmsh/SizeField.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace suture {

namespace fs = std::filesystem;

SizeFieldFile::SizeFieldFile(const SizeField& field) {
  std::error_code failed;
  fs::path folder = fs::temp_directory_path(failed);
  if (failed) folder = "/tmp";
  path_ = (folder / ("suture-sizes-" + std::string(6, 'X'))).string();  // mkstemp replaces these six X
  const int file = mkstemp(path_.data());
  if (file < 0) throw EnvironmentError("cannot write a temporary file in " + folder.string() + " for Gmsh: " + std::strerror(errno));
  close(file);
  Packer packer;
  packer.put(field);
  std::ofstream out(path_, std::ios::binary);
  out << packer.bytes();
  out.close();
  if (out) return;
  fs::remove(path_, failed);
  throw EnvironmentError("cannot write " + path_ + " for Gmsh");
}

SizeFieldFile::~SizeFieldFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace suture
