#pragma once
#include <suture/base/Hdf5File.hpp>
#include <suture/base/Types.hpp>

#include <string>
#include <vector>

namespace suture {

/// A rank's part of an unstructured grid, in VTK's terms.
struct GridPart {
  std::vector<double> points;          ///< points x 3
  std::vector<GlobalId> connectivity;  ///< numbers of this part's own points
  std::vector<GlobalId> offsets{0};    ///< cells + 1
  std::vector<unsigned char> types;    ///< VTK's number of each cell's shape
};

/// What an array is: everything but its numbers.
struct FieldInfo {
  std::string name;
  int components = 1;
  std::string unit;     ///< "" for a pure number
  std::string meaning;  ///< components and their order, sign
};

/// A file of the format VTKHDF 1.0 with one unstructured grid, a partition a rank; VTK 9.1 and ParaView 5.11 read it. A rank without
/// points makes no partition. Points and cells of a field are in the order of the grid.
/// Source: "VTK File Formats", docs.vtk.org. All functions are collective; errors as in Hdf5File.
class VtkHdf {
 public:
  VtkHdf(const Comm& comm, const std::string& path, const GridPart& part);

  template <typename T>
  void pointData(const FieldInfo& info, const std::vector<T>& values) {
    add("/VTKHDF/PointData/", info, values);
  }
  template <typename T>
  void cellData(const FieldInfo& info, const std::vector<T>& values) {
    add("/VTKHDF/CellData/", info, values);
  }

  /// For what is beside the grid (/Record).
  Hdf5File& file() { return file_; }
  void close() { file_.close(); }

 private:
  template <typename T>
  void add(const std::string& group, const FieldInfo& info, const std::vector<T>& values) {
    const std::string path = group + info.name;
    file_.write(path, values, info.components);
    file_.attribute(path, "unit", info.unit.empty() ? "1" : info.unit);
    file_.attribute(path, "meaning", info.meaning);
  }

  Hdf5File file_;
};

}  // namespace suture
