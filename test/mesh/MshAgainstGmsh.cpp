// Needs SUTURE_GMSH. Meshes that libgmsh writes in every form, read by Suture and, as the reference, by libgmsh.
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/gmsh/GmshReader.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "MeshTesting.hpp"

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

const std::map<int, Cell> cells = {
    {2, Cell::Triangle3}, {3, Cell::Quadrilateral4}, {9, Cell::Triangle6}, {10, Cell::Quadrilateral9}, {16, Cell::Quadrilateral8}};

// The mesh in libgmsh: nodes by their tags, elements by surface and type, groups by name.
Mesh reference(const std::string& path) {
  gmsh::open(path);
  std::vector<std::size_t> tags;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(tags, places, parameters);
  std::map<std::size_t, std::pair<double, double>> placeOf;
  for (std::size_t i = 0; i < tags.size(); ++i) placeOf[tags[i]] = {places[3 * i], places[3 * i + 1]};

  Mesh mesh;
  gmsh::vectorpair surfaces, groups;
  gmsh::model::getEntities(surfaces, 2);
  std::vector<std::pair<Cell, std::vector<std::size_t>>> all;
  std::map<int, std::vector<int>> elementsOf;
  std::set<std::size_t> used;
  std::map<std::set<std::size_t>, int> known;
  for (const auto& entity : surfaces) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 2, entity.second);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::ptrdiff_t each = static_cast<std::ptrdiff_t>(nodes[t].size() / elements[t].size());
      for (auto at = nodes[t].begin(); at != nodes[t].end(); at += each) {
        used.insert(at, at + each);
        const auto [found, isNew] = known.emplace(std::set<std::size_t>(at, at + each), static_cast<int>(all.size()));
        if (isNew) all.emplace_back(cells.at(types[t]), std::vector<std::size_t>(at, at + each));
        elementsOf[entity.second].push_back(found->second);
      }
    }
  }
  std::map<std::size_t, int> number;
  for (const std::size_t tag : used) {
    number.emplace(tag, static_cast<int>(number.size()));
    mesh.coordinates.insert(mesh.coordinates.end(), {placeOf.at(tag).first, placeOf.at(tag).second});
  }
  for (const auto& [cell, nodes] : all) {
    mesh.cells.push_back(cell);
    for (const std::size_t node : nodes) mesh.connectivity.push_back(number.at(node));
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  }
  const SideTable table(mesh, std::vector<char>(mesh.nodes(), 1));
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    std::vector<int> entities;
    gmsh::model::getPhysicalName(dimension, tag, name);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    if (name.empty()) name = (dimension == 2 ? "surface " : "curve ") + std::to_string(tag);
    std::set<int> members;
    std::set<std::pair<int, int>> sides;
    for (const int entity : entities) {
      int parentDimension = 0, parent = 0;
      gmsh::model::getParent(dimension, std::abs(entity), parentDimension, parent);
      if (parentDimension > dimension) continue;  // a curve between two parts of a surface has the numbers of the surface's groups
      if (dimension == 2) members.insert(elementsOf[entity].begin(), elementsOf[entity].end());
      if (dimension != 1) continue;
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 1, std::abs(entity));
      for (std::size_t t = 0; t < types.size(); ++t) {
        const std::size_t each = nodes[t].size() / elements[t].size();
        for (std::size_t i = 0; i < nodes[t].size(); i += each)
          for (const Side& side : table.between(number.at(nodes[t][i]), number.at(nodes[t][i + 1])))
            sides.insert({side.element, side.side});
      }
    }
    if (members.empty() && sides.empty()) continue;
    if (dimension == 2) mesh.elementGroups[name].assign(members.begin(), members.end());
    if (dimension == 1)
      for (const auto& [element, side] : sides) mesh.sideGroups[name].push_back({element, side});
  }
  gmsh::clear();
  return mesh;
}

// Two rectangles that share no node, the second behind the first in a group of its own, with named and unnamed groups.
void makeModel(bool recombine, int order, bool incomplete) {
  gmsh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeMax", 0.21);
  gmsh::option::setNumber("Mesh.ElementOrder", order);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", incomplete);
  gmsh::model::occ::addRectangle(0, 0, 0, 2, 1, 5);
  gmsh::model::occ::addRectangle(0, 1, 0, 2, 1, 3);
  gmsh::model::occ::addPoint(9, 9, 0, 0, 40);  // a node of no element
  gmsh::model::occ::synchronize();
  const auto group = [](int dimension, std::vector<int> tags, int number, const std::string& name) {
    gmsh::model::addPhysicalGroup(dimension, tags, number);
    if (!name.empty()) gmsh::model::setPhysicalName(dimension, number, name);
  };
  group(2, {5}, 1, "lower");
  group(2, {3}, 2, "upper");
  group(2, {3, 5}, 9, "both of them");
  group(2, {5}, 11, "");
  group(1, {1}, 1, "bottom");
  group(1, {2, 4}, 4, "sides");
  group(1, {4}, 3, "");
  group(0, {1}, 1, "corner");
  if (recombine) gmsh::model::mesh::setRecombine(2, 5);  // some triangles remain, and the other surface has only them
  gmsh::model::mesh::generate(2);
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
                if (partitioned) {
                  gmsh::option::setNumber("Mesh.PartitionCreatePhysicals", 0);
                  gmsh::model::mesh::partition(3);
                }
                gmsh::option::setNumber("Mesh.MshFileVersion", version);
                gmsh::option::setNumber("Mesh.Binary", binary);
                gmsh::option::setNumber("Mesh.SaveParametric", parametric);
                const std::string path = folder.path() + "/a.msh";
                gmsh::write(path);
                const Mesh expected = reference(path), found = readGmsh({path, {}, 1.0});
                TEST_COMPARE(found.elements(), >, 50);
                TEST_COMPARE_ARRAYS(found.coordinates, expected.coordinates);
                TEST_COMPARE_ARRAYS(found.connectivity, expected.connectivity);
                TEST_COMPARE_ARRAYS(found.elementGroupNames(), expected.elementGroupNames());
                TEST_COMPARE_ARRAYS(found.sideGroupNames(), expected.sideGroupNames());
                TEST_EQUALITY(found.hash(), expected.hash());
                if (!success) {
                  out << "recombine " << recombine << ", order " << order << ", incomplete " << incomplete << ", version " << version
                      << ", binary " << binary << ", parametric " << parametric << ", partitioned " << partitioned << "\n";
                  return;
                }
              }
}
