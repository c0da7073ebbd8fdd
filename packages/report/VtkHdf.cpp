#include <suture/report/VtkHdf.hpp>

namespace suture {

VtkHdf::VtkHdf(const Comm& comm, const std::string& path, const GridSize& mine) : comm_(comm), file_(comm, path), mine_(mine) {
  file_.group("/VTKHDF");
  file_.attribute("/VTKHDF", "Version", std::vector<GlobalId>{1, 0});
  file_.fixedAttribute("/VTKHDF", "Type", "UnstructuredGrid");
  const bool none = mine.points == 0;
  const auto count = [&](GlobalId n) { return none ? std::vector<GlobalId>{} : std::vector<GlobalId>{n}; };
  file_.write("/VTKHDF/NumberOfPoints", count(mine.points));
  file_.write("/VTKHDF/NumberOfCells", count(mine.cells));
  file_.write("/VTKHDF/NumberOfConnectivityIds", count(mine.connectivity));
  grid_.reset(
      new Grid{file_.rows<double>("/VTKHDF/Points", mine.points, 3), file_.rows<GlobalId>("/VTKHDF/Connectivity", mine.connectivity),
               file_.rows<GlobalId>("/VTKHDF/Offsets", none ? 0 : mine.cells + 1), file_.rows<unsigned char>("/VTKHDF/Types", mine.cells)});
  collectively(comm, "writing " + path, [&] {
    if (!none) grid_->offsets.append({0});
  });
  file_.group("/VTKHDF/PointData");
  file_.group("/VTKHDF/CellData");
}

void VtkHdf::append(const GridPiece& piece) {
  offsets_.clear();
  for (const GlobalId end : piece.ends) offsets_.push_back(corners_ + end);
  corners_ += static_cast<GlobalId>(piece.connectivity.size());
  grid_->points.append(piece.points);
  grid_->connectivity.append(piece.connectivity);
  grid_->offsets.append(offsets_);
  grid_->types.append(piece.types);
}

void VtkHdf::close() {
  grid_.reset();
  file_.close();
}

}  // namespace suture
