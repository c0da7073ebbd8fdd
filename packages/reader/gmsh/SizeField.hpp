#pragma once
#include <suture/base/Types.hpp>

#include <string>
#include <vector>

namespace suture {

/// Element sizes for a new mesh of a geometry: linear on the simplices of an earlier mesh of it. [length]
struct SizeField {
  int dimension = 2;
  std::vector<double> points;  ///< x, y, z of each vertex
  std::vector<double> sizes;   ///< size at each vertex
  std::vector<int> simplices;  ///< dimension + 1 vertices each

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.dimension), each(self.points), each(self.sizes), each(self.simplices);
  }
};

/// A size field in a temporary file, by which it gets to suture_mesher; removed by the destructor. Local.
class SizeFieldFile {
 public:
  /// \throws EnvironmentError  the file cannot be written
  explicit SizeFieldFile(const SizeField& field);
  ~SizeFieldFile();
  SizeFieldFile(const SizeFieldFile&) = delete;
  SizeFieldFile& operator=(const SizeFieldFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace suture
