// Needs SUTURE_GMSH. Meshes that libgmsh writes in every form, read by Suture and, as the reference, by libgmsh.
#include <suture/base/Point.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/reader/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include <reader/MeshTesting.hpp>

using namespace suture;
using meshtesting::Folder;

namespace {

struct Gmsh {
  Gmsh() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~Gmsh() { gmsh::finalize(); }
};

const std::map<int, Cell> cells = {{2, Cell::Triangle3},       {3, Cell::Quadrilateral4},  {9, Cell::Triangle6},
                                   {10, Cell::Quadrilateral9}, {16, Cell::Quadrilateral8}, {4, Cell::Tetrahedron4},
                                   {5, Cell::Hexahedron8},     {6, Cell::Wedge6},          {7, Cell::Pyramid5},
                                   {11, Cell::Tetrahedron10},  {12, Cell::Hexahedron27},   {17, Cell::Hexahedron20}};
const char* const kinds[] = {"point ", "curve ", "surface ", "volume "};

using Tags = std::vector<std::size_t>;
using PlaceOf = std::map<std::size_t, Point>;  // by tag

/// Nodes of an element with straight sides in the order of its cell: vertices first, then each node at the mean of its vertices.
Tags ordered(Cell cell, Tags nodes, const PlaceOf& placeOf) {
  const CellInfo& info = cellInfo(cell);
  std::vector<std::vector<int>> around;
  for (const auto& edge : info.edges) around.push_back({edge[0], edge[1]});
  if (cell == Cell::Hexahedron27)
    for (const auto& side : info.sideNodes) around.emplace_back(side.begin(), side.begin() + 4);
  for (std::size_t k = 0; std::size_t(info.vertices) + k < nodes.size(); ++k) {
    std::vector<int> all(static_cast<std::size_t>(info.vertices));
    std::iota(all.begin(), all.end(), 0);
    const std::vector<int>& of = k < around.size() ? around[k] : all;
    Point mean{0, 0, 0};
    for (const int vertex : of) mean = plus(mean, scaled(1.0 / double(of.size()), placeOf.at(nodes[vertex])));
    const auto first = nodes.begin() + info.vertices + std::ptrdiff_t(k);
    const auto away = [&](std::size_t node) { return norm(minus(placeOf.at(node), mean)); };
    std::iter_swap(first, std::min_element(first, nodes.end(), [&](std::size_t a, std::size_t b) { return away(a) < away(b); }));
  }
  return nodes;
}

// The mesh in libgmsh: nodes by their tags, elements by entity and type, groups by name.
Mesh reference(const std::string& path) {
  gmsh::open(path);
  Tags tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters);
  PlaceOf placeOf;
  for (std::size_t i = 0; i < tags.size(); ++i) placeOf[tags[i]] = {places[3 * i], places[3 * i + 1], places[3 * i + 2]};

  Mesh mesh;
  gmsh::vectorpair entities, groups;
  gmsh::model::getEntities(entities, 3);
  mesh.dimension = entities.empty() ? 2 : 3;
  gmsh::model::getEntities(entities, mesh.dimension);
  std::vector<std::pair<Cell, Tags>> all;
  std::map<int, std::vector<int>> elementsOf;
  std::set<std::size_t> used;
  std::map<std::set<std::size_t>, int> known;
  for (const auto& entity : entities) {
    std::vector<int> types;
    std::vector<Tags> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, mesh.dimension, entity.second);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::ptrdiff_t each = static_cast<std::ptrdiff_t>(nodes[t].size() / elements[t].size());
      for (auto at = nodes[t].begin(); at != nodes[t].end(); at += each) {
        used.insert(at, at + each);
        const auto [found, isNew] = known.emplace(std::set<std::size_t>(at, at + each), static_cast<int>(all.size()));
        if (isNew) all.emplace_back(cells.at(types[t]), ordered(cells.at(types[t]), Tags(at, at + each), placeOf));
        elementsOf[entity.second].push_back(found->second);
      }
    }
  }
  std::map<std::size_t, int> number;
  for (const std::size_t tag : used) {
    number.emplace(tag, static_cast<int>(number.size()));
    mesh.coordinates.insert(mesh.coordinates.end(), placeOf.at(tag).begin(), placeOf.at(tag).begin() + mesh.dimension);
  }
  for (const auto& [cell, nodes] : all) {
    mesh.cells.push_back(cell);
    for (const std::size_t node : nodes) mesh.connectivity.push_back(number.at(node));
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  }
  const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    if (dimension < mesh.dimension - 1) continue;
    std::string name;
    std::vector<int> ofGroup;
    gmsh::model::getPhysicalName(dimension, tag, name);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, ofGroup);
    if (name.empty()) name = kinds[dimension] + std::to_string(tag);
    std::set<int> members;
    std::set<std::pair<int, int>> sides;
    for (const int entity : ofGroup) {
      int parentDimension = 0, parent = 0;
      gmsh::model::getParent(dimension, std::abs(entity), parentDimension, parent);
      if (parentDimension > dimension) continue;  // an interface between two parts of an entity has the entity's group numbers
      if (dimension == mesh.dimension) {
        members.insert(elementsOf[entity].begin(), elementsOf[entity].end());
        continue;
      }
      std::vector<int> types;
      std::vector<Tags> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, dimension, std::abs(entity));
      for (std::size_t t = 0; t < types.size(); ++t) {
        std::string called;
        int ofType = 0, order = 0, each = 0, primary = 0;
        gmsh::model::mesh::getElementProperties(types[t], called, ofType, order, each, parameters, primary);
        for (std::size_t i = 0; i < nodes[t].size(); i += std::size_t(each)) {
          std::vector<int> vertices;
          for (int k = 0; k < primary; ++k) vertices.push_back(number.at(nodes[t][i + std::size_t(k)]));
          for (const Side& side : table.of(sideKey(vertices.data(), primary))) sides.insert({side.element, side.side});
        }
      }
    }
    if (members.empty() && sides.empty()) continue;
    if (dimension == mesh.dimension)
      mesh.elementGroups[name].assign(members.begin(), members.end());
    else
      for (const auto& [element, side] : sides) mesh.sideGroups[name].push_back({element, side});
  }
  gmsh::clear();
  return mesh;
}

void addGroup(int dimension, const std::vector<int>& tags, int number, const std::string& name) {
  gmsh::model::addPhysicalGroup(dimension, tags, number);
  if (!name.empty()) gmsh::model::setPhysicalName(dimension, number, name);
}

// Two rectangles that share no node, the second behind the first in a separate group, with named and unnamed groups.
void makeModel(bool recombine, int order, bool incomplete) {
  gmsh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.21);
  gmsh::option::setNumber("Mesh.ElementOrder", order);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", incomplete);
  gmsh::model::occ::addRectangle(0, 0, 0, 2, 1, 5);
  gmsh::model::occ::addRectangle(0, 1, 0, 2, 1, 3);
  gmsh::model::occ::addPoint(9, 9, 0, 0, 40);  // a node of no element
  gmsh::model::occ::synchronize();
  addGroup(2, {5}, 1, "lower");
  addGroup(2, {3}, 2, "upper");
  addGroup(2, {3, 5}, 9, "both of them");
  addGroup(2, {5}, 11, "");
  addGroup(1, {1}, 1, "bottom");
  addGroup(1, {2, 4}, 4, "sides");
  addGroup(1, {4}, 3, "");
  addGroup(0, {1}, 1, "corner");
  if (recombine) gmsh::model::mesh::setRecombine(2, 5);  // some triangles remain, and the other surface has only triangles
  gmsh::model::mesh::generate(2);
}

// Two boxes that share no node: the lower one of hexahedra, the upper one of tetrahedra, or of prisms.
void makeModelInSpace(bool prisms, int order, bool incomplete) {
  gmsh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  gmsh::option::setNumber("Mesh.ElementOrder", order);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", incomplete);
  gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1, 5);
  int upper = 3;
  if (prisms) {
    gmsh::vectorpair made;
    gmsh::model::occ::addRectangle(0, 0, 1, 1, 1, 77);
    gmsh::model::occ::extrude({{2, 77}}, 0, 0, 1, made, {2}, {}, true);
    for (const auto& entity : made)
      if (entity.first == 3) upper = entity.second;
  } else {
    gmsh::model::occ::addBox(0, 0, 1, 1, 1, 1, upper);
  }
  gmsh::model::occ::addPoint(9, 9, 9, 0, 400);
  gmsh::model::occ::synchronize();
  for (int surface = 1; surface <= 6; ++surface) {  // those of the lower box
    gmsh::model::mesh::setTransfiniteSurface(surface);
    gmsh::model::mesh::setRecombine(2, surface);
  }
  gmsh::model::mesh::setTransfiniteVolume(5);
  addGroup(3, {5}, 1, "lower");
  addGroup(3, {upper}, 2, "upper");
  addGroup(3, {5, upper}, 4, "");
  addGroup(2, {5}, 1, "bottom");
  addGroup(2, {1, 2}, 7, "");
  addGroup(1, {1}, 3, "edge");
  gmsh::model::mesh::generate(3);
}

/// Writes the model with the options, and reads it back twice.
void compare(const std::string& path, bool partitioned, Teuchos::FancyOStream& out, bool& success) {
  if (partitioned) {
    gmsh::option::setNumber("Mesh.PartitionCreatePhysicals", 0);
    gmsh::model::mesh::partition(3);
  }
  gmsh::write(path);
  const Mesh expected = reference(path), found = readGmsh({path, {}, 1.0});
  TEST_EQUALITY(found.dimension, expected.dimension);
  TEST_COMPARE(found.elements(), >, 20);
  TEST_COMPARE_ARRAYS(found.coordinates, expected.coordinates);
  TEST_COMPARE_ARRAYS(found.connectivity, expected.connectivity);
  TEST_COMPARE_ARRAYS(found.elementGroupNames(), expected.elementGroupNames());
  TEST_COMPARE_ARRAYS(found.sideGroupNames(), expected.sideGroupNames());
  TEST_EQUALITY(found.hash(), expected.hash());
}

}  // namespace

TEUCHOS_UNIT_TEST(MshAgainstGmsh, ReadsTheSameMesh) {
  const Gmsh started;
  const Folder folder;
  for (const bool recombine : {false, true})
    for (const int order : {1, 2})
      for (const bool incomplete : {false, true})
        for (const double version : {2.2, 4.1})
          for (const bool binary : {false, true})
            for (const bool parametric : {false, true})
              for (const bool partitioned : {false, true}) {
                if (partitioned && version < 4) continue;  // libgmsh invents groups for the partitions of version 2
                makeModel(recombine, order, incomplete);
                gmsh::option::setNumber("Mesh.MshFileVersion", version);
                gmsh::option::setNumber("Mesh.Binary", binary);
                gmsh::option::setNumber("Mesh.SaveParametric", parametric);
                compare(folder.path() + "/a.msh", partitioned, out, success);
                if (!success) {
                  out << "recombine " << recombine << ", order " << order << ", incomplete " << incomplete << ", version " << version
                      << ", binary " << binary << ", parametric " << parametric << ", partitioned " << partitioned << "\n";
                  return;
                }
              }
}

TEUCHOS_UNIT_TEST(MshAgainstGmsh, ReadsTheSameMeshIn3D) {
  const Gmsh started;
  const Folder folder;
  for (const auto& [prisms, order, incomplete] : {std::tuple(false, 1, false), {false, 2, false}, {false, 2, true}, {true, 1, false}})
    for (const double version : {2.2, 4.1})
      for (const bool binary : {false, true})
        for (const bool partitioned : {false, true}) {
          if (partitioned && version < 4) continue;
          makeModelInSpace(prisms, order, incomplete);
          gmsh::option::setNumber("Mesh.MshFileVersion", version);
          gmsh::option::setNumber("Mesh.Binary", binary);
          compare(folder.path() + "/a.msh", partitioned, out, success);
          if (!success) {
            out << "prisms " << prisms << ", order " << order << ", incomplete " << incomplete << ", version " << version << ", binary "
                << binary << ", partitioned " << partitioned << "\n";
            return;
          }
        }
}
