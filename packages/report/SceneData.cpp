#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/Outline.hpp>
#include <suture/report/ParametersJson.hpp>
#include <suture/report/SceneData.hpp>
#include <suture/report/VtkHdf.hpp>

namespace suture {
namespace {

struct DrawnCells {
  GridPiece grid;
  std::vector<int> body;
  std::map<std::string, std::vector<int>> ofGroup;  // cells of each side group in 3D
  std::vector<GlobalId> nodes;                      // numbers in the mesh, by point
};

// VTK's type of a face with this number of nodes.
unsigned char faceType(std::size_t nodes) {
  switch (nodes) {
    case 3:
      return 5;
    case 4:
      return 9;
    case 6:
      return 22;
    case 8:
      return 23;
    case 9:
      return 28;
    default:
      throw InternalError("a face of " + std::to_string(nodes) + " nodes");
  }
}

// Numbers the points in the order of the nodes, so that the file does not depend on the order of the faces.
class PointsInUse {
 public:
  explicit PointsInUse(const Mesh& mesh) : mesh_(mesh), number_(std::size_t(mesh.nodes()), -1) {}

  void use(int node) { number_[std::size_t(node)] = 0; }
  void numberThem(DrawnCells& drawn) {
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] < 0) continue;
      number_[node] = GlobalId(drawn.nodes.size());
      drawn.nodes.push_back(GlobalId(node));
      const Point x = mesh_.point(int(node));
      drawn.grid.points.insert(drawn.grid.points.end(), x.begin(), x.end());
    }
  }
  GlobalId of(int node) const { return number_[std::size_t(node)]; }

 private:
  const Mesh& mesh_;
  std::vector<GlobalId> number_;
};

template <typename Nodes>
void addCell(const Nodes& nodes, int type, int body, const PointsInUse& points, DrawnCells& drawn) {
  for (const int node : nodes) drawn.grid.connectivity.push_back(points.of(node));
  drawn.grid.ends.push_back(GlobalId(drawn.grid.connectivity.size()));
  drawn.grid.types.push_back(static_cast<unsigned char>(type));
  drawn.body.push_back(body);
}

DrawnCells elementsOf(const Mesh& mesh) {
  DrawnCells drawn;
  PointsInUse points(mesh);
  for (const int node : mesh.connectivity) points.use(node);
  points.numberThem(drawn);
  for (int e = 0; e < mesh.elements(); ++e)
    addCell(mesh.nodesOf(e), cellInfo(mesh.cells[std::size_t(e)]).vtkType, mesh.bodyOfElement[std::size_t(e)], points, drawn);
  return drawn;
}

DrawnCells outsideOf(const Mesh& mesh) {
  DrawnCells drawn;
  PointsInUse points(mesh);
  const std::vector<Side> sides = outline(mesh);
  for (const Side& side : sides)
    for (const int node : mesh.nodesOf(side)) points.use(node);
  points.numberThem(drawn);
  for (const Side& side : sides) {
    const std::vector<int> nodes = mesh.nodesOf(side);
    addCell(nodes, faceType(nodes.size()), mesh.bodyOfElement[std::size_t(side.element)], points, drawn);
  }
  std::map<std::pair<int, int>, int> cellOf;
  for (std::size_t cell = 0; cell < sides.size(); ++cell) cellOf[{sides[cell].element, sides[cell].side}] = int(cell);
  for (const auto& [name, members] : mesh.sideGroups)
    for (const Side& side : members)
      if (const auto found = cellOf.find({side.element, side.side}); found != cellOf.end()) drawn.ofGroup[name].push_back(found->second);
  return drawn;
}

std::vector<double> endPoints(const Mesh& mesh, const std::vector<Side>& sides) {
  std::vector<double> rows;
  for (const Side& side : sides) {
    const std::vector<int> nodes = mesh.nodesOf(side);
    for (std::size_t end = 0; end < 2; ++end) {
      const Point x = mesh.point(nodes[end]);
      rows.insert(rows.end(), x.begin(), x.end());
    }
  }
  return rows;
}

void writeGrid(const Comm& comm, const DrawnCells& drawn, VtkHdf& file) {
  Hdf5Rows<GlobalId> nodes = file.pointData<GlobalId>({"NodeId", 1, "", "number of the node in the mesh, from 0"});
  Hdf5Rows<int> body = file.cellData<int>({"Body", 1, "", "number of the body, from 0; names in BodyNames"});
  collectively(comm, "writing the scene's data", [&] {
    if (drawn.body.empty()) return;
    file.append(drawn.grid);
    nodes.append(drawn.nodes);
    body.append(drawn.body);
  });
}

void writeRecord(const Comm& comm, const Mesh& mesh, const DrawnCells& drawn, const SceneFile& scene, VtkHdf& vtk) {
  Packer mine;
  mine.put(mesh.bodies);
  mine.put(mesh.sideGroupNames());
  mine.put(std::vector<int>{mesh.dimension});
  Unpacker ofRoot(broadcast(comm, mine.bytes()));
  std::vector<std::string> bodies, groups;
  std::vector<int> dimension;
  ofRoot.get(bodies);
  ofRoot.get(groups);
  ofRoot.get(dimension);
  Hdf5Writer& file = vtk.file();
  file.group("/Record");
  file.attribute("/Record", "dimension", std::vector<GlobalId>{dimension.front()});
  file.write("/Record/Scene", toJson(*scene.parameters).dump());
  file.write("/Record/InputPath", scene.path);
  file.write("/Record/Bodies", nlohmann::json(bodies).dump());
  file.group("/Record/SideGroups");
  vtk.names("BodyNames", bodies);
  vtk.names("GroupNames", groups);
  for (const std::string& group : groups) {
    const auto found = mesh.sideGroups.find(group);
    std::string step = group;  // one component of an HDF5 path
    std::replace(step.begin(), step.end(), '/', '_');
    file.write("/Record/SideGroups/" + step, found == mesh.sideGroups.end() ? std::vector<double>{} : endPoints(mesh, found->second), 6);
    if (dimension.front() != 3) continue;
    const auto cells = drawn.ofGroup.find(group);
    file.write("/Record/GroupCells/" + step, cells == drawn.ofGroup.end() ? std::vector<int>{} : cells->second);
  }
}

}  // namespace

void writeSceneData(const Comm& comm, const Mesh& mesh, const SceneFile& scene, const std::string& path) {
  const DrawnCells drawn =
      onRoot(comm, "collecting the outside of the bodies", [&] { return mesh.dimension == 3 ? outsideOf(mesh) : elementsOf(mesh); });
  const GridSize size{GlobalId(drawn.nodes.size()), GlobalId(drawn.body.size()), GlobalId(drawn.grid.connectivity.size())};
  VtkHdf file(comm, path, size);
  writeGrid(comm, drawn, file);
  writeRecord(comm, mesh, drawn, scene, file);
  file.close();
}

}  // namespace suture
