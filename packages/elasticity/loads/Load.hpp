#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/Types.hpp>
#include <suture/elasticity/ReferenceElement.hpp>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

struct ConditionForm;

/// A load of the scene: on named side groups, at a point, on the volume of a body, or on its nodes (random, for solver studies; or given by
/// another program).
///
/// Force, Moment, PointForce and ReferenceForce depend on the mesh: resolveLoads() converts the first two to tractions, finds the node of
/// the third, and converts the last to NodalForces.
struct Load {
  enum class Kind {
    Traction,
    Pressure,
    BodyForce,
    Random,
    Gravity,
    Rotation,
    Force,
    Moment,
    PointForce,
    Temperature,
    InitialStrain,
    InitialStress,
    NodalForces,
    ReferenceForce
  };
  Kind kind = Kind::Traction;
  std::string body;  ///< body of a load on bodies or at a point; "": all bodies
  /// Traction [stress], body force [force / volume], Force and PointForce [force]; Pressure: value[0], > 0 acts into the body; Gravity:
  /// acceleration [length / time^2]; Temperature: value[0]; Rotation: angular velocity along its axis [1 / time]; Moment [force x length];
  /// Random: value[0] about value[1] [force]
  Point value{0, 0, 0};
  int seed = 0;                           ///< seed of Random
  std::vector<Expression> expressions{};  ///< functions of position, instead of value: one per component
  std::vector<std::string> groups{};      ///< side groups on which it acts
  Point place{0, 0, 0};                   ///< position of a PointForce; point on the axis of a Rotation; zero of a traction's spin
  Point spin{0, 0, 0};                    ///< added to a Traction: spin x (point - place) [stress / length]
  double tolerance = 0;                   ///< largest distance of a PointForce from its node [length]; 0: 1e-6 of the bodies' extent
  GlobalId node = -1;                     ///< node of a PointForce, once resolved
  std::string path{};                     ///< path in the scene, for messages
  std::string name{};                     ///< name of the boundary condition
  double factor = 1.0;                    ///< factor of its forces (LoadSteps)
  double reference = 0;                   ///< temperature at which a body is free of thermal strain
  /// Control of a load whose amount is unknown (setAmount()) and follows from a target: the mean displacement of its groups along its axis
  /// [length], for a Force; the force that its body carries along its axis [force], for an InitialStrain.
  enum class Control { None, MeanDisplacement, SectionForce };
  Control control = Control::None;
  double target = 0;     ///< required value, in the unit of the control
  Point axis{0, 0, 0};   ///< a unit vector; for a resolved Force divided by the area of its groups
  double length = 0;     ///< length over which an InitialStrain shortens its body by the amount [length]
  bool isLocal = false;  ///< an InitialStrain acts only where its distance from `place` along the axis is at most length / 2
  /// InitialStrain and InitialStress [stress], instead of value, in the order of StressVector.hpp; the last two are unused in 2D
  std::array<double, 6> tensor{};
  /// NodalForces: forces on nodes of the mesh, on every rank those of all ranks [force]: set and changed by another program
  /// (Simulation::coupling()), or made of a ReferenceForce.
  std::map<GlobalId, Point> forces{};
  Point torque{0, 0, 0};     ///< moment of a ReferenceForce about its place, besides the force `value` [force x length]
  bool atReference = false;  ///< NodalForces were made of a ReferenceForce
  /// NodalForces balance the moments that forces gain by displacements: no load of the scene, in no reaction and no work.
  bool isCorrection = false;

  /// Gives a controlled load a known amount: a force along its axis [force], or a shortening [length].
  void setAmount(double amount);

  /// Value at a point, without the factor; for Gravity and Rotation the force per unit mass. \throws InputError  if an expression is not
  /// finite there
  Point at(const Point& point) const {
    if (kind == Kind::Rotation) return cross(cross(value, minus(point, place)), value);
    Point here = value;
    for (std::size_t k = 0; k < expressions.size(); ++k) here[k] = expressions[k].at(point);
    return varies() ? plus(here, cross(spin, minus(point, place))) : here;
  }
  /// The same for a kind with a tensor.
  std::array<double, 6> tensorAt(const Point& point) const {
    if (!covers(point)) return {};
    std::array<double, 6> here = tensor;
    for (std::size_t k = 0; k < expressions.size(); ++k) here[k] = expressions[k].at(point);
    return here;
  }
  /// False outside of the length on which a local load acts.
  bool covers(const Point& point) const { return !isLocal || std::abs(dot(minus(point, place), axis)) <= length / 2; }
  /// True if the value depends on position.
  bool varies() const { return !expressions.empty() || spin != Point{0, 0, 0} || kind == Kind::Rotation; }
  Rule rule() const { return varies() ? Rule::Data : Rule::Load; }

  static Load pressure(const std::string& group, double value) { return {Kind::Pressure, "", {value, 0, 0}, 0, {}, {group}}; }
  static Load traction(const std::string& group, const Point& value) { return {Kind::Traction, "", value, 0, {}, {group}}; }
  /// Total force. [force]
  static Load force(const std::string& group, const Point& value) { return {Kind::Force, "", value, 0, {}, {group}}; }
  /// Total moment about the centroid, counter-clockwise in 2D. [force x length]
  static Load moment(const std::string& group, double value) { return moment(group, Point{0, 0, value}); }
  static Load moment(const std::string& group, const Point& value) { return {Kind::Moment, "", value, 0, {}, {group}}; }
  /// \param body  empty: all bodies
  static Load bodyForce(const Point& value, const std::string& body = "") { return {Kind::BodyForce, body, value}; }
  static Load gravity(const Point& acceleration, const std::string& body = "") { return {Kind::Gravity, body, acceleration}; }
  /// \param velocity  angular velocity, along the axis through `about`: z in 2D, y in axisymmetric scenes [1 / time]
  static Load rotation(const Point& velocity, const Point& about = {0, 0, 0}, const std::string& body = "");
  static Load temperature(double value, double reference, const std::string& body = "");
  /// \param tensor  xx, yy, zz, xy, yz, xz, the last two in 3D only; shear: 2 e_xy
  static Load initialStrain(const std::array<double, 6>& tensor, const std::string& body = "");
  static Load initialStress(const std::array<double, 6>& tensor, const std::string& body = "");
  static Load pointForce(const Point& place, const Point& value, const std::string& body = "");

  /// Uniform traction for which the mean displacement of a group has this component. [length]
  static Load meanDisplacement(const std::string& group, int component, double value);
  /// Shortening of a body along a direction, e.g. a bolt, for which it carries a given force. \param length  between the points where the
  /// force enters and leaves the body [length] \param value  the force, tension positive [force] \param middle  of that length, to
  /// shorten the body only there; none: the whole body
  static Load preload(const std::string& body, const Point& direction, double length, double value,
                      const std::optional<Point>& middle = std::nullopt);

  /// Acts on bodies as a whole.
  bool onBody() const { return onElements() || isInitial() || kind == Kind::Random; }
  /// A state of the bodies before deformation: a strain or stress of each element.
  bool isInitial() const { return kind == Kind::Temperature || hasTensor(); }
  bool hasTensor() const { return kind == Kind::InitialStrain || kind == Kind::InitialStress; }
  /// Acts on the volume of bodies.
  bool onElements() const { return kind == Kind::BodyForce || usesDensity(); }
  /// Acts on the mass of bodies.
  bool usesDensity() const { return kind == Kind::Gravity || kind == Kind::Rotation; }
  bool onNodes() const { return kind == Kind::Random || kind == Kind::PointForce; }
  /// True if a load on bodies acts on the body of this name.
  bool actsOn(const std::string& name) const { return body.empty() || body == name; }
};

/// Form of the boundary condition for a kind. \throws std::out_of_range  if there is none
const ConditionForm& formOf(Load::Kind kind);
/// Name of a kind in the scene's boundary conditions.
const std::string& nameOf(Load::Kind kind);

/// Elastic support of side groups (Winkler): its traction on them is -normal (u.n) n - tangential (u - (u.n) n), n their outward normal.
struct ElasticSupport {
  std::vector<std::string> groups;
  double normal = 0.0, tangential = 0.0;  ///< [stress / length]
  std::string name{};                     ///< name of the boundary condition
};

}  // namespace suture
