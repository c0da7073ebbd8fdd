#pragma once
#include <map>
#include <string>
#include <vector>

namespace suture {

/// Names that DefineConstant gives in a .geo file and in the files that it includes by a literal name: those that a scene may override.
/// Comments are skipped. Sorted. Local; an included file that cannot be read adds nothing.
std::vector<std::string> geoConstants(const std::string& path);

/// File that Gmsh opens instead of a .geo file: the file itself, or a temporary one around it that gives the constants first (a
/// DefineConstant does not touch defined constants; Gmsh's own -setnumber would outlive this file) and ends with a newline (without
/// one Gmsh 4.8 drops the last statements). The temporary file is removed with the object. Local.
class GeoWrapper {
 public:
  /// \throws InputError        if the file has no newline at its end, and includes others relative to its folder, so that a copy elsewhere
  ///                           would not find them
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
