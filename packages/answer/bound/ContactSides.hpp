#pragma once
#include <suture/answer/bound/LinearPressures.hpp>

#include <array>
#include <vector>

namespace suture {

/// A side of a contact, as sent to rank 0.
struct TouchingSide {
  int contact = -1, rank = -1, number = -1;  // place in BoundaryParts::touching; entry of BoundParts::boundary on its rank
  int onA = 0;
  std::array<GlobalId, 6> nodes{{-1, -1, -1, -1, -1, -1}};  // in the order of the bound
  std::array<Point, 6> places{}, moved{};                   // and displacements
  Point normal{0, 0, 0};
  double size = 0.0;
  double young = 0.0;      // modulus of the element behind it, in its stiffest direction [stress]
  double stiffness = 0.0;  // springs of a softened contact [stress / length]
  WholeSide whole{};       // in 3D: the side of the cell that it is a triangle of

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.contact), each(self.rank), each(self.number), each(self.onA), each(self.nodes), each(self.places), each(self.moved);
    each(self.normal), each(self.size), each(self.young), each(self.stiffness);
    each(self.whole);
  }
};

/// The sides of all contacts on this rank, with their displacements. Local.
template <int D>
std::vector<TouchingSide> touchingSides(const Comm& comm, const BoundedSolution& solution, const BoundaryParts& contacts,
                                        const BoundParts<D>& parts);

}  // namespace suture
