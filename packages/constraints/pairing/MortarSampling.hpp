#pragma once
#include <suture/constraints/ContactSurface.hpp>
#include <suture/constraints/pairing/Segmentation.hpp>
#include <suture/mesh/SideShape.hpp>

#include <optional>
#include <vector>

namespace suture {

/// Two facing sides of a contact, one of which carries the conditions: points where the carrying side meets the other along a given
/// normal, and their gaps. Between straight elements whose nodes lie on curves the gap is taken between smooth curves. Local.
///
/// A second-order element of straight shape stands for the drawn curve: its displacements can follow any change of curvature. Those of a
/// two-node element cannot; where the contact is closed its chord approximates the curve that both sides then share. Its curvature
/// lies between those of the two sides, by the compliances along them (ContactSurface::shareOfA): of rings and pins both are nearly alike,
/// a cylinder on a plane of the same material has half its curvature there.
class MortarSampling {
 public:
  MortarSampling(const Mesh& mesh, const ContactSurface& contact, bool onA);
  MortarSampling(const MortarSampling&) = delete;
  MortarSampling& operator=(const MortarSampling&) = delete;

  /// Elements of the carrying side.
  const std::vector<MortarSegment>& own() const { return own_; }
  /// True if the carrying side has elements of two nodes.
  bool isLinear() const { return own_.front().isLinear(); }
  /// True if either side is curved anywhere.
  bool isCurved() const;

  /// Mean of the two sides' normals at a node of the carrying side, outward there; its own where nothing stands opposite, or the other is
  /// parallel.
  Point meanNormal(const MortarSegment& own, int node) const;

  /// A point of both sides.
  struct Sample {
    double xi, weight;  ///< place in the carrying element; quadrature weight [length]; axisymmetric: times 2 pi r [area]
    double gap, doubt;  ///< doubt: estimated error of the gap by the elements' shape [length]
    const MortarSegment* other;
    double eta;
  };
  struct Samples {
    std::vector<Sample> all;
    double covered = 0;  ///< covered part of the element's interval, in units of its half
  };
  /// Quadrature points of an element of the carrying side, seen along one direction; intervals end where an element of the other begins.
  Samples sample(const MortarSegment& own, const Point& normal) const;

 private:
  struct Nearer {
    double way = 0, doubt = 0;
  };
  Nearer nearer(const MortarSegment& own, double xi, const MortarSegment& other, double eta, const Point& normal) const;

  const Mesh& mesh_;
  const ContactSurface& contact_;
  double share_;  // share of the change of curvature that the carrying side takes where both are pressed together
  std::vector<MortarSegment> own_, other_;
  Segmentation segmentation_;
  LineRule rule_;
};

}  // namespace suture
