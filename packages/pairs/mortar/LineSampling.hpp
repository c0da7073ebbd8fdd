#pragma once
#include <suture/mesh/GaussRule.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>
#include <suture/pairs/mortar/Segmentation.hpp>

#include <map>
#include <vector>

namespace suture {

/// Two facing lines of a 2D contact: points where the carrying line meets the other along a given normal, and their gaps. Between straight
/// elements whose nodes lie on curves the gap is measured between smooth curves. Local.
///
/// A second-order element of straight shape represents the drawn curve: its displacements can follow any change of curvature. A two-node
/// element cannot follow it; where the contact is closed, its chord approximates the curve shared by both sides. The curvature of that
/// curve lies between those of the two sides, according to their compliances (ContactSurface::shareOfA): for rings and pins both are nearly
/// equal, a cylinder on a plane of the same material keeps half of its curvature.
class LineSampling : public MortarSampling {
 public:
  LineSampling(const Mesh& mesh, const ContactSurface& contact, bool onA);
  LineSampling(const LineSampling&) = delete;
  LineSampling& operator=(const LineSampling&) = delete;

  /// The number of nodes of the side where it is covered (MortarSamples::kWhole), else two: a quadratic stress is not positive on part of
  /// a side.
  int functions(int side, bool whole) const override { return whole ? own_[side].count() : 2; }
  Point rowNormal(int side, int node) const override;
  MortarSamples sample(int side, const Point& normal) const override;
  bool isFaceted() const override;
  bool estimatesDoubt() const override { return true; }

 private:
  struct Nearer {
    double way = 0, doubt = 0;
  };
  Nearer nearer(const MortarSegment& own, double xi, const MortarSegment& other, double eta, const Point& normal) const;

  const Mesh& mesh_;
  const ContactSurface& contact_;
  const Surface& surface_;
  std::map<int, Point> rim_;  // see rimOf()
  double share_;              // fraction of the change of curvature that the carrying side takes where both are pressed together
  std::vector<MortarSegment> own_, other_;
  Segmentation segmentation_;
  LineRule rule_;
};

}  // namespace suture
