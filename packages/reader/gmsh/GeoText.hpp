#pragma once
#include <map>
#include <string>
#include <vector>

namespace suture {

/// Names in DefineConstant in a .geo file and in the files that it includes by a literal name: the constants that a scene may override.
/// Sorted. Local; an included file that cannot be read adds nothing. \throws InputError  like geoTokens()
std::vector<std::string> geoConstants(const std::string& path);

/// File that Gmsh opens for a .geo file: the file itself, or a temporary file that first sets the constants, then includes the .geo file (a
/// DefineConstant leaves defined constants unchanged; Gmsh's own -setnumber would outlive this file) and ends with a newline (without
/// one Gmsh 4.8 drops the last statements). The destructor removes the temporary file. Local.
class GeoWrapper {
 public:
  /// \throws InputError        if the file does not end with a newline and includes other files relative to its folder, which a temporary
  ///                           copy would not find; like geoTokens()
  /// \throws EnvironmentError  if no temporary file can be written
  GeoWrapper(const std::string& path, const std::map<std::string, double>& constants);
  ~GeoWrapper();
  GeoWrapper(const GeoWrapper&) = delete;
  GeoWrapper& operator=(const GeoWrapper&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool temporary_ = false;
};

}  // namespace suture
