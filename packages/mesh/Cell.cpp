#include <suture/base/Errors.hpp>
#include <suture/mesh/Cell.hpp>

namespace suture::detail {

// Node order as in Gmsh, VTK and Intrepid2: vertices, then mid-side nodes side by side, then the centre.
const std::array<CellInfo, 5> cells = {{
    {"Triangle3", 2, 3, 3, {{0, 1}, {1, 2}, {2, 0}}, 5},
    {"Triangle6", 2, 6, 3, {{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}, 22},
    {"Quadrilateral4", 2, 4, 4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, 9},
    {"Quadrilateral8", 2, 8, 4, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}, 23},
    {"Quadrilateral9", 2, 9, 4, {{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}, 28},
}};

void noSuchCell(int number) { throw InternalError("there is no cell of number " + std::to_string(number)); }

}  // namespace suture::detail
