#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>

namespace suture {

/// A box [x0,x1] x [y0,y1] of nx x ny cells, in 3D [x0,x1] x [y0,y1] x [z0,z1] of nx x ny x nz cells, as one body: element group `name`;
/// side groups "<name>_left", "_right" (in x), "_bottom", "_top" (in y, in 3D in z), and in 3D "_front", "_back" (in y).
struct Box {
  std::string name = "body";
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
  int nx = 8, ny = 8;
  /// Triangles: each cell is split in two, with alternating diagonals; tetrahedra: in six, mirrored from cell to cell; wedges: in two, like
  /// triangles; pyramids: in six about the centre; other shapes: not split.
  Cell cell = Cell::Triangle3;
  int brickX = 0, brickY = 0;    ///< > 0: bricks of this many cells, alternately in the element groups "<name>_bricks_even" and "_odd"
  int blocksX = 1, blocksY = 1;  ///< equal blocks of cells as named subdomains "subdomain_<name>_<i>_<j>", in 3D "_<k>"
  double z0 = 0, z1 = 1;         ///< this and the next line: 3D only
  int nz = 8, brickZ = 0, blocksZ = 1;
};

/// One mesh of several boxes, all in 2D or all in 3D, which share no node. Local.
/// \throws InputError  empty or unequal boxes, blocks and bricks that do not fit, a mesh too large for the memory: all problems together
Mesh boxes(const std::vector<Box>& all);

}  // namespace suture
