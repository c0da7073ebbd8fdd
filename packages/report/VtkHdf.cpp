#include <suture/report/VtkHdf.hpp>

namespace suture {

VtkHdf::VtkHdf(const Comm& comm, const std::string& path, const GridPart& part) : file_(Hdf5File::create(comm, path)) {
  file_.group("/VTKHDF");
  file_.attribute("/VTKHDF", "Version", std::vector<GlobalId>{1, 0});
  file_.fixedAttribute("/VTKHDF", "Type", "UnstructuredGrid");
  const bool none = part.points.empty();
  const auto count = [&](std::size_t n) { return none ? std::vector<GlobalId>{} : std::vector<GlobalId>{GlobalId(n)}; };
  file_.write("/VTKHDF/NumberOfPoints", count(part.points.size() / 3));
  file_.write("/VTKHDF/NumberOfCells", count(part.types.size()));
  file_.write("/VTKHDF/NumberOfConnectivityIds", count(part.connectivity.size()));
  file_.write("/VTKHDF/Points", part.points, 3);
  file_.write("/VTKHDF/Connectivity", part.connectivity);
  file_.write("/VTKHDF/Offsets", none ? std::vector<GlobalId>{} : part.offsets);
  file_.write("/VTKHDF/Types", part.types);
  file_.group("/VTKHDF/PointData");
  file_.group("/VTKHDF/CellData");
}

}  // namespace suture
