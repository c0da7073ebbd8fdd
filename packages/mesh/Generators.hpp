#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>

namespace suture {

/// A box [x0,x1] x [y0,y1] of nx x ny cells, as one body: element group `name`, side groups "<name>_left", "_right", "_bottom", "_top".
struct Box {
  std::string name = "body";
  double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
  int nx = 8, ny = 8;
  Cell cell = Cell::Triangle3;   ///< Triangle3: each cell cut in two, with alternating diagonals; Quadrilateral4: as it is
  int brickX = 0, brickY = 0;    ///< > 0: bricks of so many cells, in turn in the element groups "<name>_bricks_even" and "_odd"
  int blocksX = 1, blocksY = 1;  ///< also named subdomains "subdomain_<name>_<i>_<j>", equal blocks of cells
};

/// One mesh of several boxes, which share no node. Local.
Mesh boxes(const std::vector<Box>& all);

}  // namespace suture
