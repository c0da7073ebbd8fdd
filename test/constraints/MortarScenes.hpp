#pragma once
#include "ConstraintsTesting.hpp"

namespace constraintstesting {

/// Two boxes stacked, the upper one from x0 to x1, the lower from 0 to 4, with the given number of cells.
inline Mesh twoBoxes(double x0, double x1, int upperCells, int lowerCells, Cell upper, Cell lower) {
  Box above, below;
  above.name = "upper";
  above.x0 = x0, above.x1 = x1, above.y0 = 1, above.y1 = 2;
  above.nx = upperCells, above.ny = 2, above.cell = upper;
  below.name = "lower";
  below.x1 = 4, below.nx = lowerCells, below.ny = 2, below.cell = lower;
  Mesh mesh = boxes({above, below});
  assignBodies(mesh, {"upper", "lower"});
  return mesh;
}

inline std::string mortar(const std::string& carrier = "Automatic", std::vector<std::pair<std::string, std::string>> more = {}) {
  more.insert(more.end(), {{"Side A", "upper_bottom"}, {"Side B", "lower_top"}, {"Coupling", "Mortar"}, {"Multipliers On", carrier}});
  return entry("joint", more);
}

inline const std::string held = displacement("above", "upper_top", "{0.0, 0.0}") + displacement("below", "lower_bottom", "{0.0, 0.0}");

constexpr Cell P1 = Cell::Triangle3, P2 = Cell::Triangle6, Q8 = Cell::Quadrilateral8;

/// Boxes of twoBoxes().
struct Case {
  double x0, x1;
  int upperCells, lowerCells;
  Cell upper, lower;
};
inline const Case cases[] = {{0, 4, 8, 13, P1, P1},     {0, 4, 40, 3, P1, P1},         {1, 3, 7, 11, P1, P1},        {-1, 5, 9, 5, P1, P1},
                             {-0.7, 3.3, 8, 8, P1, P1}, {0, 4, 8, 13, P2, P2},         {0, 4, 7, 5, P2, P1},         {0, 4, 5, 8, P1, Q8},
                             {-0.7, 3.3, 8, 9, P2, P2}, {-0.001, 3.999, 8, 8, P1, P1}, {-0.001, 3.999, 8, 8, P2, P2}};

/// Sum of weight times f(place) over the ends of a pair that lie on a body.
inline double sum(const Mesh& mesh, const ContactPair& pair, int body, const std::function<double(Point)>& f) {
  double all = 0;
  for (const PairEnd& end : pair.ends)
    if (mesh.bodyOfNode[end.node] == body) all += end.weight * f(mesh.point(end.node));
  return all;
}

}  // namespace constraintstesting
