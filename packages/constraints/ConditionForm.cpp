#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/constraints/SupportDirection.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

using Type = Condition::Type;
using Place = ConditionForm::Place;

const std::vector<std::string> kScalar{""}, kVector{" x", " y"}, kTensor{" xx", " yy", " zz", " xy"}, kVectorInSpace{" x", " y", " z"},
    kTensorInSpace{" xx", " yy", " zz", " xy", " yz", " xz"};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

const std::vector<ConditionForm>& conditionForms() {
  static const std::vector<ConditionForm> all{
      {"Displacement",
       Type::Displacement,
       Place::Sides,
       kVector,
       kVectorInSpace,
       true,
       {},
       {"Point", "Tolerance", "Direction", "Along", "Axis Point"},
       ""},
      {"Bilateral", Type::Bilateral, Place::Sides, {}, {}, false, {}, {}, "the normal displacement is zero"},
      {"Traction", Type::Traction, Place::Sides, kVector, kVectorInSpace, true, {}, {}, ""},
      {"Pressure", Type::Pressure, Place::Sides, kScalar, kScalar, true, {}, {}, ""},
      {"Force", Type::Force, Place::Sides, kVector, kVectorInSpace, false, {}, {}, ""},
      {"Moment", Type::Moment, Place::Sides, kScalar, kVectorInSpace, false, {}, {}, ""},
      {"Point Force", Type::PointForce, Place::Point, kVector, kVectorInSpace, false, {"Point"}, {"Tolerance"}, ""},
      {"Body Force", Type::BodyForce, Place::Body, kVector, kVectorInSpace, true, {}, {}, ""},
      {"Gravity", Type::Gravity, Place::Body, kVector, kVectorInSpace, false, {}, {}, ""},
      {"Rotation", Type::Rotation, Place::Body, kScalar, kVectorInSpace, false, {}, {"Point"}, ""},
      {"Temperature", Type::Temperature, Place::Body, kScalar, kScalar, true, {}, {"Reference Temperature"}, ""},
      {"Initial Strain", Type::InitialStrain, Place::Body, kTensor, kTensorInSpace, true, {}, {}, ""},
      {"Initial Stress", Type::InitialStress, Place::Body, kTensor, kTensorInSpace, true, {}, {}, ""},
      {"Mean Displacement", Type::MeanDisplacement, Place::Sides, kVector, kVectorInSpace, false, {}, {}, ""},
      {"Preload", Type::Preload, Place::Body, kScalar, kScalar, false, {"Direction", "Length"}, {"Point"}, ""},
      {"Elastic Support",
       Type::ElasticSupport,
       Place::Sides,
       {},
       {},
       false,
       {},
       {"Normal Stiffness", "Tangential Stiffness"},
       "it has Normal Stiffness and Tangential Stiffness"},
      {"Random Load", Type::RandomLoad, Place::Body, {}, {}, false, {"Amplitude"}, {"Seed", "Mean"}, "it has Amplitude and Seed"},
      {"Rigid Group",
       Type::RigidGroup,
       Place::Sides,
       {},
       {},
       false,
       {"Point"},
       {"Force", "Moment", "Motion x", "Motion y", "Motion z", "Rotation x", "Rotation y", "Rotation z"},
       "it has Motion x, Rotation z and the like, Force and Moment"}};
  return all;
}

const ConditionForm& formOf(Condition::Type type) {
  for (const ConditionForm& form : conditionForms())
    if (form.type == type) return form;
  throw InternalError("boundary condition type without a form");
}

const ConditionForm& formNamed(const std::string& name) {
  for (const ConditionForm& form : conditionForms())
    if (form.name == name) return form;
  throw InternalError("there is no boundary condition type '" + name + "'");
}

std::vector<std::string> ConditionForm::expressions(int dimension, const std::string& which) const {
  std::vector<std::string> names;
  for (const std::string& component : componentsIn(dimension))
    if (which == "All" || which.find(component.back()) != std::string::npos) names.push_back("Expression" + component);
  return names;
}

bool ConditionForm::takes(const std::string& parameter) const { return contains(needs, parameter) || contains(may, parameter); }

const std::vector<std::string>& motionNames() {
  static const std::vector<std::string> all{"Motion x", "Motion y", "Motion z", "Rotation x", "Rotation y", "Rotation z"};
  return all;
}

std::vector<std::string> specialParameters() {
  std::set<std::string> all;
  for (const ConditionForm& form : conditionForms()) {
    all.insert(form.needs.begin(), form.needs.end());
    all.insert(form.may.begin(), form.may.end());
  }
  return {all.begin(), all.end()};
}

std::string withArticle(const std::string& name) {
  return (std::string("AEIOU").find(name.front()) == std::string::npos ? "a " : "an ") + name;
}

std::string takersOf(const std::string& parameter) {
  std::string text;
  for (const ConditionForm& form : conditionForms())
    if (form.takes(parameter)) text += (text.empty() ? "" : " or ") + withArticle(form.name);
  return text;
}

Schema boundaryConditionSchema() {
  std::vector<std::string> names;
  for (const ConditionForm& form : conditionForms()) names.push_back(form.name);
  return Schema("a boundary condition; several may meet at a corner")
      .texts(
          "Group", std::nullopt,
          "curve group of the mesh (in 3D surface group) on which the condition acts, or several as {left, right}; not for body loads and "
          "conditions at a Point")
      .orOne()
      .optional()
      .oneOf(
          "Type", std::nullopt, names,
          "Displacement: prescribed, of a group or of the node at a Point; Bilateral: zero normal displacement, free to slide; Traction: "
          "force vector per undeformed area; "
          "Pressure: > 0 pushes into the body; Force: total force on a group, as a uniform traction; Moment: total moment "
          "on a group about its centroid, as a traction that grows linearly from there, counterclockwise > 0 in 2D; Point Force: "
          "at a node, where stresses are then singular; Body Force: force per volume; Gravity: acceleration, on the Density of the "
          "materials; Rotation: centrifugal force of a body that turns about a point (2D), its axis (axisymmetric) or an axis "
          "through a point (3D), by Density; Temperature: strain Thermal Expansion x (Temperature - Reference Temperature); "
          "Initial Strain: of shrinkage, swelling, or a bolt's preload as the shortening of its shank; Initial Stress: of rock before it "
          "is excavated; Mean Displacement: of a group, imposed by a uniform traction, counts as a support; Preload: shortening of a body, "
          "such as a bolt, under which it carries a given force; Elastic Support: springs on an area (Winkler); Random Load: forces on all "
          "nodes of a body, for studies of solvers; Rigid Group: the nodes of a group move as one rigid body about its Point, with "
          "prescribed or free motions, and a Force and Moment that act at the Point")
      .reals(
          "Value", std::nullopt,
          "Displacement: one entry per component [length]; Traction: one per direction [stress]; Pressure: one [stress]; Force: one per "
          "direction [force]; Moment: one, in 3D three [force x length]; Point Force: one per direction [force]; Body Force: one per "
          "direction [force / volume]; Gravity: one per direction [length / time^2]; Rotation: the angular velocity, one, in 3D three "
          "along "
          "its axis [1 / time]; Temperature: one; Initial Strain: xx, yy, zz, xy, in 3D also yz, xz, where xy is 2 e_xy; Initial Stress: "
          "xx, yy, zz, xy, in 3D also yz, xz [stress], tension positive; Mean Displacement: one entry per component [length]; Preload: one "
          "[force], tension positive; none for Bilateral, Elastic Support, Random Load and Rigid Group. In 2D per unit thickness, in "
          "axisymmetric "
          "scenes "
          "for the whole circle")
      .optional()
      .text(
          "Expression x", std::nullopt,
          "instead of Value: the x component as a function of x and y, in 3D of x, y and z, the position on the undeformed body. "
          "Available are the names in Constants and Functions, pi, + - * / ^, comparisons, c ? a : b, and sqrt, sin, atan2, exp, ln, abs, "
          "min and others; in the file < is written &lt;")
      .optional()
      .text("Expression y", std::nullopt, "likewise, for the y component")
      .optional()
      .text("Expression z", std::nullopt, "likewise, for the z component, in 3D")
      .optional()
      .text("Expression", std::nullopt, "likewise, for a Pressure or Temperature")
      .optional()
      .text("Expression xx", std::nullopt, "likewise, for an Initial Strain or Initial Stress: give all four expressions, in 3D all six")
      .optional()
      .text("Expression yy", std::nullopt, "likewise")
      .optional()
      .text("Expression zz", std::nullopt,
            "likewise: the out-of-plane component, in axisymmetric scenes the hoop component; 0 for a stress in plane stress")
      .optional()
      .text("Expression xy", std::nullopt, "likewise; for a strain 2 e_xy")
      .optional()
      .text("Expression yz", std::nullopt, "likewise, in 3D; for a strain 2 e_yz")
      .optional()
      .text("Expression xz", std::nullopt, "likewise, in 3D; for a strain 2 e_xz")
      .optional()
      .oneOf("Components", "All", {"All", "x", "y", "z", "xy", "xz", "yz"},
             "components that a Displacement or Mean Displacement prescribes; the others are free")
      .text("Body", std::nullopt, "body on which a body load acts, by default all bodies; body of the node of a condition at a Point")
      .optional()
      .reals("Point", std::nullopt,
             "position of a Point Force, or of the single node that a Displacement holds; point about which a Rotation turns in 2D, or a "
             "point of its axis in 3D, by default the origin; Preload: middle of the Length on which the body is shortened, such as the "
             "shank of a bolt, by default the whole body; Rigid Group: its reference point, anywhere",
             "length")
      .optional()
      .real("Tolerance", std::nullopt,
            "Point Force, Displacement at a Point: largest distance of the nearest node; by default 1e-6 of the bodies' extent",
            Range::positive(), "length")
      .optional()
      .reals("Direction", std::nullopt,
             "a vector of any length. Displacement: only the component along it is prescribed, with one number in Value; with Along, it is "
             "the direction of the axis. Preload: the axis of the bolt")
      .optional()
      .oneOf("Along", std::nullopt, SupportDirection::names(),
             "Displacement: the only component that is prescribed. Direction: along the vector Direction, the default if there is one; "
             "Radius: away from the axis through Axis Point along Direction, in 2D perpendicular to the plane; Circumference: around this "
             "axis, counterclockwise if Direction points to the viewer")
      .optional()
      .reals("Axis Point", std::nullopt, "Displacement with Along: a point of the axis, by default the origin", "length")
      .optional()
      .real("Length", std::nullopt,
            "Preload: distance between the places where the force enters and leaves the body, as between head and nut", Range::positive(),
            "length")
      .optional()
      .real("Reference Temperature", std::nullopt, "Temperature: temperature without thermal strain; 0 by default", Range::any(),
            "temperature")
      .optional()
      .real("Normal Stiffness", std::nullopt, "Elastic Support: pressure per normal displacement; 0 by default", Range::atLeast(0.0),
            "stress / length")
      .optional()
      .real("Tangential Stiffness", std::nullopt, "Elastic Support: the same along the side; 0 by default", Range::atLeast(0.0),
            "stress / length")
      .optional()
      .integer("Seed", std::nullopt, "Random Load: forces depend only on the seed, the node number and the component; 0 by default")
      .optional()
      .real("Amplitude", std::nullopt, "Random Load: forces are uniformly distributed between -Amplitude and Amplitude", Range::positive(),
            "force")
      .optional()
      .real("Mean", std::nullopt, "Random Load: value added to every component; 0 by default", Range::any(), "force")
      .optional()
      .reals("Force", std::nullopt, "Rigid Group: force at its Point, one entry per direction; none by default", "force")
      .optional()
      .reals("Moment", std::nullopt, "Rigid Group: moment about its Point, one entry, in 3D three; none by default", "force x length")
      .optional()
      .real("Motion x", std::nullopt, "Rigid Group: prescribed displacement of its Point along x; free by default", Range::any(), "length")
      .optional()
      .real("Motion y", std::nullopt, "likewise, along y", Range::any(), "length")
      .optional()
      .real("Motion z", std::nullopt, "likewise, along z, in 3D", Range::any(), "length")
      .optional()
      .real("Rotation x", std::nullopt, "Rigid Group: prescribed rotation about an axis through its Point along x, in 3D; free by default")
      .optional()
      .real("Rotation y", std::nullopt, "likewise, along y, in 3D")
      .optional()
      .real("Rotation z", std::nullopt, "likewise, along z; counterclockwise > 0 in 2D")
      .optional();
}

}  // namespace suture
