#pragma once
#include <interface/ContactScenes.hpp>
#include <suture/answer/verdict/Deformation.hpp>
#include <suture/answer/verdict/Verify.hpp>
#include <suture/monolithic/Monolithic.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <functional>
#include <string>

namespace suture::blocks {

/// An answer to a scene that a test may corrupt before it is judged. Every rank solves the whole scene by the reference and takes its part.
struct Judged {
  Scene scene;
  Blocks all;
  std::vector<Vector> displacement;
  std::vector<PairResult> pairs;  // on rank 0
  double tolerance = 1e-8;
  std::vector<BodyForces> past{};  // on previous load steps

  explicit Judged(const Scene& given);
  void take(const MonolithicResult& found);

  Verification verdict() const;
  double deformation(int body) const;
  double extent(int body) const { return deformations(*world(), all.meshes, displacement, int(all.model.bodies.size()))[body].extent; }

  /// Applies change(place, displacement) to all nodes of a body.
  void move(int body, const std::function<void(const Point& place, double* u)>& change);
  /// The node of a body nearest to a place, in all subdomains that hold it.
  void moveNear(int body, const Point& place, const std::function<void(double* u)>& change);
  /// The pair with the largest force, or with the largest gap; rank 0, -1 on the others.
  int strongest() const;
  int widest() const;
  double largestForce() const { return pairs.empty() ? 0.0 : pairs[strongest()].force; }
};

const Check& check(const Verification& verdict, const std::string& name);

/// Two unequal blocks, the lower fixed, the upper held by contact and one guide only, pressed down with a moment that opens some pairs.
Scene looseBlock(double young = 100.0, double load = 1.0, int cells = 8);

/// The same with pairs of three ends, a node below against two above.
Scene mortarBlock();

/// One block pressed onto a rigid obstacle that is nearer in the middle.
Scene blockOnObstacle(double young = 100.0);

/// A block that its prescribed top lifts off the other and shifts: it carries no load, and moves rigidly.
Scene liftedBlock();

/// Two independent scenes in one: four blocks, of which the second two are `weak` times as stiff and as loaded.
Scene strongAndWeak(double weak);

}  // namespace suture::blocks
