#pragma once
#include <pairs/PairsTesting.hpp>
#include <suture/pairs/ContactPairs.hpp>

namespace pairstesting {

/// Boxes "lower" [0,2] x [0,1.5] x [-1,0] and "upper" [0,2] x [0,1.5] x [gap,1] with the given number of cells in x and y, two in z.
Mesh facing(Cell lower, int nx, int ny, Cell upper, int mx, int my, double gap);

/// Turns about an axis through the origin.
class Turned {
 public:
  Turned(const Point& axis, double angle);
  Point operator()(const Point& p) const;

 private:
  Matrix by_;
};

/// The pairs of a contact. \throws InputError  with its errors
PairedSurface pairsOf(const Mesh& mesh, const Contact& contact, std::vector<std::string>* notes = nullptr);

}  // namespace pairstesting
