#include <suture/base/Errors.hpp>
#include <suture/mesh/Cell.hpp>

namespace suture::detail {

namespace {

using Edges = std::vector<std::array<int, 2>>;
using Sides = std::vector<std::vector<int>>;

const Edges triangle = {{0, 1}, {1, 2}, {2, 0}};
const Edges square = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
const Edges tetrahedron = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
const Edges cube = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
const Edges wedge = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
const Edges pyramid = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};

const Sides tetrahedronSides = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
const Sides cubeSides = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
const Sides wedgeSides = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
const Sides pyramidSides = {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

/// Sides of a cell of order 2 from those of the linear cell: the mid-edge nodes follow the vertices.
Sides withMiddles(const Sides& sides, const Edges& edges, int vertices) {
  Sides all = sides;
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (std::size_t k = 0; k < sides[s].size(); ++k) {
      const int a = sides[s][k], b = sides[s][(k + 1) % sides[s].size()];
      for (std::size_t e = 0; e < edges.size(); ++e)
        if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a))
          all[s].push_back(vertices + static_cast<int>(e));
    }
  return all;
}

/// Adds a centre node to each side. \param first  node number at the centre of the first side
Sides withCentres(Sides sides, int first) {
  for (std::vector<int>& side : sides) side.push_back(first++);
  return sides;
}

}  // namespace

// Node order as in VTK (in 2D also Gmsh and Intrepid2): vertices, then mid-edge nodes, then centres of sides, then the centre. The base of
// a wedge is counter-clockwise seen from its top, as in Gmsh; VTK has the opposite order.
const std::array<CellInfo, kCells> cells = {{
    {"Triangle3", 2, 1, 3, 3, triangle, {{0, 1}, {1, 2}, {2, 0}}, 5},
    {"Triangle6", 2, 2, 6, 3, triangle, {{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}, 22},
    {"Quadrilateral4", 2, 1, 4, 4, square, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, 9},
    {"Quadrilateral8", 2, 2, 8, 4, square, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}, 23},
    {"Quadrilateral9", 2, 2, 9, 4, square, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}, 28},
    {"Tetrahedron4", 3, 1, 4, 4, tetrahedron, tetrahedronSides, 10},
    {"Tetrahedron10", 3, 2, 10, 4, tetrahedron, withMiddles(tetrahedronSides, tetrahedron, 4), 24},
    {"Hexahedron8", 3, 1, 8, 8, cube, cubeSides, 12},
    {"Hexahedron20", 3, 2, 20, 8, cube, withMiddles(cubeSides, cube, 8), 25},
    {"Hexahedron27", 3, 2, 27, 8, cube, withCentres(withMiddles(cubeSides, cube, 8), 20), 29},
    {"Wedge6", 3, 1, 6, 6, wedge, wedgeSides, 13},
    {"Pyramid5", 3, 1, 5, 5, pyramid, pyramidSides, 14},
}};

void noSuchCell(int number) { throw InternalError("there is no cell of number " + std::to_string(number)); }

}  // namespace suture::detail
