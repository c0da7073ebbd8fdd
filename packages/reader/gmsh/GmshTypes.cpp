#include <suture/reader/gmsh/GmshTypes.hpp>

#include <algorithm>
#include <vector>

namespace suture {

namespace {

// Sorted by number. To support a further shape, enter its Cell here: all readers of Gmsh meshes use this table. Most elements of order
// three and higher are omitted: they are refused by number, without a name.
//
// Source of the node orders: Gmsh 4.8 Reference Manual, section 9.2, "Node ordering"; Suture uses VTK's (Cell.cpp).
const std::vector<GmshType> types = {
    {1, "Line 2", 1, 2, {}, {}},
    {2, "Triangle 3", 2, 3, Cell::Triangle3, {}},
    {3, "Quadrilateral 4", 2, 4, Cell::Quadrilateral4, {}},
    {4, "Tetrahedron 4", 3, 4, Cell::Tetrahedron4, {}},
    {5, "Hexahedron 8", 3, 8, Cell::Hexahedron8, {}},
    {6, "Prism 6", 3, 6, Cell::Wedge6, {}},
    {7, "Pyramid 5", 3, 5, Cell::Pyramid5, {}},
    {8, "Line 3", 1, 3, {}, {}},
    {9, "Triangle 6", 2, 6, Cell::Triangle6, {}},
    {10, "Quadrilateral 9", 2, 9, Cell::Quadrilateral9, {}},
    {11, "Tetrahedron 10", 3, 10, Cell::Tetrahedron10, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {12, "Hexahedron 27", 3, 27, Cell::Hexahedron27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                                      19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26}},
    {13, "Prism 18", 3, 18, {}, {}},
    {14, "Pyramid 14", 3, 14, {}, {}},
    {15, "Point", 0, 1, {}, {}},
    {16, "Quadrilateral 8", 2, 8, Cell::Quadrilateral8, {}},
    {17, "Hexahedron 20", 3, 20, Cell::Hexahedron20, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
    {18, "Prism 15", 3, 15, {}, {}},
    {19, "Pyramid 13", 3, 13, {}, {}},
    {21, "Triangle 10", 2, 10, {}, {}},
    {26, "Line 4", 1, 4, {}, {}},
    {29, "Tetrahedron 20", 3, 20, {}, {}},
    {36, "Quadrilateral 16", 2, 16, {}, {}}};

}  // namespace

const GmshType* gmshType(int number) {
  const auto at = std::lower_bound(types.begin(), types.end(), number, [](const GmshType& type, int n) { return type.number < n; });
  return at != types.end() && at->number == number ? &*at : nullptr;
}

std::string knownGmshTypes() {
  std::string names;
  for (const GmshType& type : types)
    if (type.cell) names += (names.empty() ? "" : ", ") + std::string(type.name);
  return names;
}

}  // namespace suture
