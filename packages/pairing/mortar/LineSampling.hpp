#pragma once
#include <suture/mesh/SideShape.hpp>
#include <suture/pairing/mortar/MortarSampling.hpp>
#include <suture/pairing/mortar/Segmentation.hpp>

#include <vector>

namespace suture {

/// Two facing lines of a contact in the plane: points where the carrying line meets the other along a given normal, and their gaps. Between
/// straight elements whose nodes lie on curves the gap is taken between smooth curves. Local.
///
/// A second-order element of straight shape stands for the drawn curve: its displacements can follow any change of curvature. Those of a
/// two-node element cannot; where the contact is closed its chord approximates the curve that both sides then share. Its curvature
/// lies between those of the two sides, by the compliances along them (ContactSurface::shareOfA): of rings and pins both are nearly alike,
/// a cylinder on a plane of the same material has half its curvature there.
class LineSampling : public MortarSampling {
 public:
  LineSampling(const Mesh& mesh, const ContactSurface& contact, bool onA);
  LineSampling(const LineSampling&) = delete;
  LineSampling& operator=(const LineSampling&) = delete;

  /// As many as the side has nodes where it is covered wholly, else two: a quadratic stress is not positive on a part.
  int functions(int side, bool whole) const override { return whole ? own_[side].count() : 2; }
  Point meanNormal(int side, int node) const override;
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
  double share_;  // share of the change of curvature that the carrying side takes where both are pressed together
  std::vector<MortarSegment> own_, other_;
  Segmentation segmentation_;
  LineRule rule_;
};

}  // namespace suture
