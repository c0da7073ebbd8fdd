#pragma once
#include <suture/base/Collective.hpp>
#include <suture/base/Types.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// A piece of a rank's part of an unstructured grid, in VTK's terms.
struct GridPiece {
  std::vector<double> points;          ///< points x 3
  std::vector<GlobalId> connectivity;  ///< point numbers on this rank, including points of earlier pieces
  std::vector<GlobalId> ends;          ///< end of each cell's points in this piece's connectivity
  std::vector<unsigned char> types;    ///< VTK cell types
};

/// Size of all pieces of a rank together.
struct GridSize {
  GlobalId points = 0, cells = 0, connectivity = 0;
};

/// Description of an array, without its values.
struct FieldInfo {
  std::string name;
  int components = 1;
  std::string unit;     ///< "" if dimensionless
  std::string meaning;  ///< components and their order, sign
};

/// A file of the format VTKHDF 1.0 with one unstructured grid, one partition per rank; readable by VTK 9.1 and ParaView 5.11. Ranks
/// without points have no partition. Points and cells of a field are in the order of the grid.
/// Source: "VTK File Formats", docs.vtk.org. All functions except append() are collective; errors as in Hdf5Writer.
class VtkHdf {
 public:
  VtkHdf(const Comm& comm, const std::string& path, const GridSize& mine);

  /// Writes the next piece of this rank. Local. \throws EnvironmentError  on this rank only, as Hdf5Rows::append()
  void append(const GridPiece& piece);

  /// Creates an array to which this rank appends the values of its points or cells piece by piece.
  template <typename T>
  Hdf5Rows<T> pointData(const FieldInfo& info) {
    return add<T>("/VTKHDF/PointData/", info, mine_.points);
  }
  template <typename T>
  Hdf5Rows<T> cellData(const FieldInfo& info) {
    return add<T>("/VTKHDF/CellData/", info, mine_.cells);
  }
  /// Writes an array at once.
  template <typename T>
  void pointData(const FieldInfo& info, const std::vector<T>& values) {
    Hdf5Rows<T> rows = pointData<T>(info);
    collectively(comm_, "writing a field", [&] { rows.append(values); });
  }

  /// Writes texts for the whole grid as field data. The same on all ranks.
  void names(const std::string& name, const std::vector<std::string>& texts) {
    if (!texts.empty()) file_.write("/VTKHDF/FieldData/" + name, texts);
  }

  /// The file, for content in addition to the grid (/Record).
  Hdf5Writer& file() { return file_; }
  void close();

 private:
  template <typename T>
  Hdf5Rows<T> add(const std::string& group, const FieldInfo& info, GlobalId rows) {
    const std::string path = group + info.name;
    Hdf5Rows<T> made = file_.rows<T>(path, rows, info.components);
    file_.attribute(path, "unit", info.unit.empty() ? "1" : info.unit);
    file_.attribute(path, "meaning", info.meaning);
    return made;
  }

  // Datasets of the grid, open until the file is closed.
  struct Grid {
    Hdf5Rows<double> points;
    Hdf5Rows<GlobalId> connectivity, offsets;
    Hdf5Rows<unsigned char> types;
  };

  const Comm& comm_;
  Hdf5Writer file_;
  GridSize mine_;
  std::unique_ptr<Grid> grid_;
  GlobalId corners_ = 0;  ///< corners of all pieces so far
  std::vector<GlobalId> offsets_;
};

}  // namespace suture
