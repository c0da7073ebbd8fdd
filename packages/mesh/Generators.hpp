#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>

namespace suture {

/// A box [x0,x1] x [y0,y1] of nx x ny cells, in space [x0,x1] x [y0,y1] x [z0,z1] of nx x ny x nz ones, as one body: element group `name`;
/// side groups "<name>_left", "_right" (in x), "_bottom", "_top" (in y, in space in z), and in space "_front", "_back" (in y).
struct Box {
  std::string name = "body";
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
  int nx = 8, ny = 8;
  /// Triangles: each cell cut in two, with alternating diagonals; tetrahedra: in six, mirrored from cell to cell; wedges: in two, as
  /// triangles; pyramids: in six about the middle; the others as they are.
  Cell cell = Cell::Triangle3;
  int brickX = 0, brickY = 0;    ///< > 0: bricks of so many cells, in turn in the element groups "<name>_bricks_even" and "_odd"
  int blocksX = 1, blocksY = 1;  ///< also named subdomains "subdomain_<name>_<i>_<j>", in space "_<k>", equal blocks of cells
  double z0 = 0, z1 = 1;         ///< of cells in space only, as what follows
  int nz = 8, brickZ = 0, blocksZ = 1;
};

/// One mesh of several boxes, all in the plane or all in space, which share no node. Local.
/// \throws InputError  empty or unequal boxes, blocks and bricks that do not fit, a mesh that the machine cannot hold: all at once
Mesh boxes(const std::vector<Box>& all);

}  // namespace suture
