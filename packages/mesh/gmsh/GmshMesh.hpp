#pragma once
#include <suture/mesh/Cell.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace suture {

constexpr const char* kMeshFile = "Mesh/File";  ///< the parameter that errors of a mesh file are told of

/// A mesh in Gmsh's own numbers, as suture_mesher hands it on.
struct GmshMesh {
  struct Surface {
    int tag;                         ///< Gmsh's surface
    Cell cell;                       ///< all of these elements
    std::vector<std::size_t> nodes;  ///< nodes of one element after the other
    template <typename Self, typename Each>
    static void forEachField(Self& self, Each each) {
      each(self.tag), each(self.cell), each(self.nodes);
    }
  };
  std::vector<std::size_t> tags;    ///< tags of nodes, ascending
  std::vector<double> coordinates;  ///< x, y, z of each
  std::vector<Surface> surfaces;
  std::map<int, std::vector<std::size_t>> curves;                      ///< two end points of each curve element, by Gmsh's curve
  std::map<std::string, std::vector<int>> surfaceGroups, curveGroups;  ///< name -> Gmsh's surfaces or curves
  std::vector<std::string> problems;                                   ///< problems of the mesh

  template <typename Self, typename Each>
  static void forEachField(Self& self, Each each) {
    each(self.tags), each(self.coordinates), each(self.surfaces), each(self.curves), each(self.surfaceGroups), each(self.curveGroups),
        each(self.problems);
  }
};

/// Messages of suture_mesher to its parent through its file descriptor 3: one letter, the length in eight bytes, and the text.
enum class MesherMessage : char {
  Opened = 'O',  ///< all statements are read; meshing begins
  Failed = 'F',  ///< text: Gmsh's complaints
  Mesh = 'M'     ///< a packed GmshMesh: all went well
};

}  // namespace suture
