#include <answer/SolidScenes.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/Surface.hpp>

#include <Teuchos_ParameterList.hpp>

#include <random>

namespace suture::solids {

const std::vector<Cell>& cells() {
  static const std::vector<Cell> all{Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8, Cell::Hexahedron20,
                                     Cell::Hexahedron27, Cell::Wedge6,        Cell::Pyramid5};
  return all;
}

Eigen::Matrix3d rotation(const Point& axis, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(axis[0], axis[1], axis[2]).normalized()).toRotationMatrix();
}

Point operator*(const Eigen::Matrix3d& matrix, const Point& p) {
  const Eigen::Vector3d image = matrix * Eigen::Vector3d(p[0], p[1], p[2]);
  return {image[0], image[1], image[2]};
}

Box cube(Cell cell, int n, int blocks) {
  Box box;
  box.nx = box.ny = box.nz = n;
  box.blocksX = box.blocksY = box.blocksZ = blocks;
  box.cell = cell;
  return box;
}

Scene fromBoxes(const std::vector<Box>& boxes, double young, double poisson) {
  Scene scene = scenes::fromBoxes(boxes, young, poisson);
  scene.model.dimension = 3;
  return scene;
}

void distort(Mesh& mesh, double size, bool bend) {
  std::vector<char> fixed(mesh.nodes(), 0), isVertex(mesh.nodes(), 0);
  for (const auto& group : mesh.sideGroups)
    for (const Side& side : group.second)
      for (const int node : mesh.nodesOf(side)) fixed[node] = 1;
  for (int e = 0; e < mesh.elements(); ++e)
    for (int v = 0; v < cellInfo(mesh.cells[e]).vertices; ++v) isVertex[mesh.nodesOf(e)[v]] = 1;
  std::mt19937 random(11);
  const auto shift = [&](int node) {
    for (int k = 0; k < 3; ++k) mesh.coordinates[std::size_t(node) * 3 + k] += size * (random() / 2147483648.0 - 1.0);
  };
  for (int node = 0; node < mesh.nodes(); ++node)
    if (!fixed[node] && (isVertex[node] || bend)) shift(node);
  if (bend) return;
  for (int e = 0; e < mesh.elements(); ++e) {  // images of the other nodes under the map of the vertices
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Cell linear = cell.vertices == 4 ? Cell::Tetrahedron4 : Cell::Hexahedron8;
    const Span<const int> nodes = mesh.nodesOf(e);
    for (int i = cell.vertices; i < cell.nodes; ++i) {
      ShapeJet jets[kMostCellNodes];
      shapeJets(linear, referencePoint(mesh.cells[e], i), jets);
      Point place{0, 0, 0};
      for (int v = 0; v < cell.vertices; ++v) place = plus(place, scaled(jets[v].value, mesh.point(nodes[v])));
      std::copy(place.begin(), place.end(), &mesh.coordinates[std::size_t(nodes[i]) * 3]);
    }
  }
}

Scene turned(Scene scene, const Eigen::Matrix3d& rotation, const Point& shift) {
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    const Point p = plus(rotation * scene.mesh.point(node), shift);
    std::copy(p.begin(), p.end(), &scene.mesh.coordinates[std::size_t(node) * 3]);
  }
  for (NodeRule& rule : scene.constraints.rules)
    for (Point& axis : rule.axes) axis = rotation * axis;
  for (Support& support : scene.constraints.supports) {
    support.direction = rotation * support.direction;
    support.along = rotation * support.along;
  }
  for (ContactPair& pair : scene.constraints.pairs) {
    pair.normal = rotation * pair.normal;
    pair.position = plus(rotation * pair.position, shift);
  }
  for (Load& load : scene.model.loads)
    if (load.kind != Load::Kind::Pressure) load.value = rotation * load.value;
  return scene;
}

std::vector<SubdomainMesh> distributed(const Scene& scene, const CommPtr& comm) {
  const bool root = comm->getRank() == 0;
  const Mesh mesh = root ? scene.mesh : Mesh();
  const Constraints constraints = root ? scene.constraints : Constraints();
  const auto cut = parseScene("<ParameterList name=\"Suture\"/>", "test.xml", Schema().list("Partition", partitionSchema()),
                              {"Partition/Type=Named Groups", "Partition/Named Groups/Pattern=subdomain_*"});
  const Partition partition = makePartition(*comm, mesh, constraints, cut.parameters->sublist("Partition"), false);
  return distribute(*comm, mesh, constraints, partition);
}

Vector atNodes(const CellBlock& block, const Field& field) {
  Vector all(block.nodes() * 3);
  for (int node = 0; node < block.nodes(); ++node) {
    const Point value = field(block.point(node));
    std::copy(value.begin(), value.end(), all.data() + Eigen::Index(node) * 3);
  }
  return all;
}

std::vector<Vector> atNodes(const std::vector<SubdomainMesh>& meshes, const Field& field) {
  std::vector<Vector> all;
  for (const SubdomainMesh& mesh : meshes) all.push_back(atNodes(static_cast<const CellBlock&>(mesh), field));
  return all;
}

namespace {

Scene pressedBlocks(Cell cell) {
  std::vector<Box> both;
  for (const int k : {0, 1}) {
    Box box = cube(cell, 4, 2);
    box.name = k == 0 ? "lower" : "upper";
    box.z0 = k - 1;
    box.z1 = k;
    both.push_back(box);
  }
  Scene scene = fromBoxes(both, PressedBlocks::young, PressedBlocks::poisson);
  if (isSimplex(cell) || cellInfo(cell).vertices == 8) distort(scene.mesh, 0.03);  // quadrature is exact
  for (const std::string body : {"lower", "upper"}) {
    scene.hold(body + "_left", 0, 0.0);
    scene.hold(body + "_front", 1, 0.0);
  }
  scene.hold("lower_bottom", 2, 0.0);
  scene.constraints.conditions = {"left", "front", "bottom", "top"};
  for (const NodeRule& rule : scene.constraints.rules)
    for (int k = 0; k < 3; ++k)
      if (rule.fixed[k]) scene.constraints.supports.push_back({rule.node, k, rule.axes[k], rule.axes[k]});
  scene.pressure("upper_top", PressedBlocks::pressure);
  const std::vector<int> above = scene.nodesOf("upper_bottom");
  const Surface below(scene.mesh, scene.mesh.sideGroups.at("lower_top"));
  ContactPiece piece{"joint", {}, {0, 1}, {}, 0.0, {}};
  for (const auto& [node, data] : below.nodes())
    for (const int other : above) {
      if (norm(minus(scene.mesh.point(other), data.position)) > 1e-9) continue;
      ContactPair pair;
      pair.id = int(scene.constraints.pairs.size());
      pair.line = pair.piece = 0;
      pair.ends = matchingEnds(node, other);
      pair.normal = {0, 0, 1};
      pair.length = data.tributary;
      pair.position = data.position;
      piece.pairs.push_back(pair.id);
      scene.constraints.pairs.push_back(pair);
    }
  scene.constraints.pieces = {piece};
  return scene;
}

}  // namespace

PressedBlocks::PressedBlocks(Cell cell, const Eigen::Matrix3d& turn, const Point& shift)
    : scene(turned(pressedBlocks(cell), turn, shift)), meshes(distributed(scene)), frame(turn), origin(shift) {
  displacement = atNodes(meshes, [&](const Point& place) {
    const Point x = turn.transpose() * minus(place, shift);
    const double strain = pressure / young;
    return turn * Point{poisson * strain * x[0], poisson * strain * x[1], -strain * (x[2] + 1)};
  });
  if (world()->getRank() > 0) return;
  for (const ContactPair& pair : scene.constraints.pairs) {
    PairResult result;
    result.id = pair.id;
    result.line = result.piece = 0;
    result.node = pair.node();
    result.bodies = {0, 1};
    result.state = PairStatus::Slip;
    result.force = pressure * pair.length;
    result.length = pair.length;
    result.pressure = pressure;
    result.position = pair.position;
    result.normal = pair.normal;
    pairs.push_back(result);
  }
}

Verification PressedBlocks::verdict() const {
  return verify(*world(), {meshes, scene.model, displacement, pairs, scene.constraints.pieces, tolerance});
}

void PressedBlocks::move(int body, const std::function<void(const Point& place, Point& u)>& change) {
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int node = 0; meshes[i].body == body && node < meshes[i].nodes(); ++node) {
      double* values = &displacement[i][Eigen::Index(node) * 3];
      Point u = frame.transpose() * Point{values[0], values[1], values[2]};
      change(frame.transpose() * minus(meshes[i].point(node), origin), u);
      u = frame * u;
      std::copy(u.begin(), u.end(), values);
    }
}

}  // namespace suture::solids
