#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <random>
#include <vector>

/// Cells written by hand, for tests of the code's cell data.
namespace referencecells {

using suture::Cell;
using suture::CellBlock;
using suture::Point;

inline const std::vector<Cell> plane = {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9};
inline const std::vector<Cell> solid = {Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8, Cell::Hexahedron20,
                                        Cell::Hexahedron27, Cell::Wedge6,        Cell::Pyramid5};

inline std::vector<Cell> all() {
  std::vector<Cell> cells = plane;
  cells.insert(cells.end(), solid.begin(), solid.end());
  return cells;
}

/// Coordinates of a cell's nodes, read from the drawings of VTK's file formats (the base of the wedge as in Gmsh).
inline std::vector<Point> places(Cell cell) {
  static const std::vector<Point> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {.5, 0, 0}, {.5, .5, 0}, {0, .5, 0}};
  static const std::vector<Point> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0},  {-1, 1, 0}, {0, -1, 0},
                                         {1, 0, 0},   {0, 1, 0},  {-1, 0, 0}, {0, 0, 0}};
  static const std::vector<Point> tetrahedron{{0, 0, 0},   {1, 0, 0},  {0, 1, 0},  {0, 0, 1},   {.5, 0, 0},
                                              {.5, .5, 0}, {0, .5, 0}, {0, 0, .5}, {.5, 0, .5}, {0, .5, .5}};
  static const std::vector<Point> cube{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
                                       {-1, 1, 1},   {0, -1, -1}, {1, 0, -1},  {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
                                       {0, 1, 1},    {-1, 0, 1},  {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},   {-1, 1, 0}, {-1, 0, 0},
                                       {1, 0, 0},    {0, -1, 0},  {0, 1, 0},   {0, 0, -1},  {0, 0, 1},   {0, 0, 0}};
  static const std::vector<Point> wedge{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  static const std::vector<Point> pyramid{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  const auto first = [](const std::vector<Point>& of, int count) { return std::vector<Point>(of.begin(), of.begin() + count); };
  switch (cell) {
    case Cell::Triangle3:
      return first(triangle, 3);
    case Cell::Triangle6:
      return triangle;
    case Cell::Quadrilateral4:
      return first(square, 4);
    case Cell::Quadrilateral8:
      return first(square, 8);
    case Cell::Quadrilateral9:
      return square;
    case Cell::Tetrahedron4:
      return first(tetrahedron, 4);
    case Cell::Tetrahedron10:
      return tetrahedron;
    case Cell::Hexahedron8:
      return first(cube, 8);
    case Cell::Hexahedron20:
      return first(cube, 20);
    case Cell::Hexahedron27:
      return cube;
    case Cell::Wedge6:
      return wedge;
    case Cell::Pyramid5:
      return pyramid;
  }
  return {};
}

/// Shape functions of all nodes.
inline std::vector<suture::ShapeJet> jets(Cell cell, const Point& at) {
  std::vector<suture::ShapeJet> all(suture::cellInfo(cell).nodes);
  suture::shapeJets(cell, at, all.data());
  return all;
}

/// Area or volume of the cell of places().
inline double size(Cell cell) {
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Triangle6:
      return 0.5;
    case Cell::Quadrilateral4:
    case Cell::Quadrilateral8:
    case Cell::Quadrilateral9:
      return 4;
    case Cell::Tetrahedron4:
    case Cell::Tetrahedron10:
      return 1.0 / 6;
    case Cell::Wedge6:
      return 1;
    case Cell::Pyramid5:
      return 4.0 / 3;
    default:
      return 8;
  }
}

/// One element: the image of the cell under x -> (columns) x + shift.
inline CellBlock image(Cell cell, const std::vector<Point>& columns, const Point& shift = {7, -3, 2}) {
  CellBlock block;
  block.dimension = suture::dimensionOf(cell);
  for (const Point& p : places(cell)) {
    Point x = shift;
    for (int k = 0; k < block.dimension; ++k) x = suture::plus(x, suture::scaled(p[k], columns[k]));
    block.coordinates.insert(block.coordinates.end(), x.begin(), x.begin() + block.dimension);
    block.connectivity.push_back(static_cast<int>(block.connectivity.size()));
  }
  block.cells = {cell};
  block.offsets = {0, static_cast<int>(block.connectivity.size())};
  return block;
}

/// A point inside the cell.
inline Point inside(Cell cell, std::mt19937& random) {
  Point sum{0, 0, 0};
  double total = 0;
  for (const Point& p : places(cell)) {
    const double weight = random() / 4294967296.0;
    sum = suture::plus(sum, suture::scaled(weight, p));
    total += weight;
  }
  return suture::scaled(1 / total, sum);
}

}  // namespace referencecells
