#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/ConditionForm.hpp>

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
      {"Displacement", Type::Displacement, Place::Sides, kVector, kVectorInSpace, true, {}, {}, ""},
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
      {"Preload", Type::Preload, Place::Body, kScalar, kScalar, false, {"Direction", "Length"}, {}, ""},
      {"Elastic Support",
       Type::ElasticSupport,
       Place::Sides,
       {},
       {},
       false,
       {},
       {"Normal Stiffness", "Tangential Stiffness"},
       "it has Normal Stiffness and Tangential Stiffness"},
      {"Random Load", Type::RandomLoad, Place::Body, {}, {}, false, {"Amplitude"}, {"Seed", "Mean"}, "it has Amplitude and Seed"}};
  return all;
}

const ConditionForm& formOf(Condition::Type type) {
  for (const ConditionForm& form : conditionForms())
    if (form.type == type) return form;
  throw InternalError("a type of boundary condition without a form");
}

const ConditionForm& formNamed(const std::string& name) {
  for (const ConditionForm& form : conditionForms())
    if (form.name == name) return form;
  throw InternalError("no type of boundary condition is called '" + name + "'");
}

std::vector<std::string> ConditionForm::expressions(int dimension, const std::string& which) const {
  std::vector<std::string> names;
  for (const std::string& component : componentsIn(dimension))
    if (which == "All" || which.find(component.back()) != std::string::npos) names.push_back("Expression" + component);
  return names;
}

bool ConditionForm::takes(const std::string& parameter) const { return contains(needs, parameter) || contains(may, parameter); }

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
  return Schema("one boundary condition; several may meet at a corner")
      .texts(
          "Group", std::nullopt,
          "curve group of the mesh, in space surface group, on which it acts, or several as {left, right}; not for loads on bodies and at "
          "points")
      .orOne()
      .optional()
      .oneOf("Type", std::nullopt, names,
             "Displacement: given; Bilateral: normal displacement zero, free to slide; Traction: force vector on an area of the undeformed "
             "body; Pressure: > 0 pushes into the body; Force: total force on a group, the same traction everywhere; Moment: total moment "
             "on a group about its centroid, as a traction that grows linearly from there, counterclockwise > 0 in the plane; Point Force: "
             "at a node, where stresses are then singular; Body Force: force on a volume; Gravity: acceleration, on the Density of the "
             "materials; Rotation: centrifugal force of a body that turns about a point (in the plane), its axis (axisymmetric) or an axis "
             "through a point (in space), by Density; Temperature: strain Thermal Expansion x (Temperature - Reference Temperature); "
             "Initial Strain: of shrinkage, swelling, "
             "or a "
             "bolt's preload as the shortening of its shank; Initial Stress: of rock before it is cut; Mean Displacement: "
             "of a group, by the uniform traction that gives it; Preload: shortening of a body, as of a bolt, at which it carries a force; "
             "Elastic Support: springs on an area (Winkler); Random Load: forces on all nodes of a body, for studies of solvers")
      .reals(
          "Value", std::nullopt,
          "Displacement: one entry a component [length]; Traction: one a direction [stress]; Pressure: one [stress]; Force: one a "
          "direction "
          "[force]; Moment: one, in space three [force x length]; Point Force: one a direction [force]; Body Force: one a direction [force "
          "/ "
          "volume]; Gravity: one a direction [length / time^2]; Rotation: the angular velocity, one, in space three along its axis [1 / "
          "time]; Temperature: one; Initial Strain: xx, yy, zz, xy, in space also yz, xz, of which xy is 2 e_xy; Initial Stress: xx, yy, "
          "zz, xy, in space also yz, xz [stress], tension positive; Mean Displacement: one entry a component [length]; Preload: one "
          "[force], "
          "tension positive; none for Bilateral, Elastic Support and Random Load. Per unit thickness in the plane, of the whole circle in "
          "axisymmetric scenes")
      .optional()
      .text("Expression x", std::nullopt,
            "instead of Value: the component along x as a function of x and y, in space of x, y and z, the place on the undeformed body. "
            "Known "
            "are the names in "
            "Constants and Functions, pi, + - * / ^, comparisons, c ? a : b, and sqrt, sin, atan2, exp, ln, abs, min and others; in the "
            "file < is written &lt;")
      .optional()
      .text("Expression y", std::nullopt, "the same of the component along y")
      .optional()
      .text("Expression z", std::nullopt, "the same of the component along z, in space")
      .optional()
      .text("Expression", std::nullopt, "the same of a Pressure or Temperature")
      .optional()
      .text("Expression xx", std::nullopt, "the same of an Initial Strain or Initial Stress, all four of which are given, in space all six")
      .optional()
      .text("Expression yy", std::nullopt, "likewise")
      .optional()
      .text("Expression zz", std::nullopt,
            "likewise: across the plane, or along the hoop in axisymmetric scenes; 0 for a stress in plane stress")
      .optional()
      .text("Expression xy", std::nullopt, "likewise; of a strain 2 e_xy")
      .optional()
      .text("Expression yz", std::nullopt, "likewise, in space; of a strain 2 e_yz")
      .optional()
      .text("Expression xz", std::nullopt, "likewise, in space; of a strain 2 e_xz")
      .optional()
      .oneOf("Components", "All", {"All", "x", "y", "z", "xy", "xz", "yz"},
             "components that a Displacement or Mean Displacement prescribes; the others are free")
      .text("Body", std::nullopt, "body on which a load on bodies acts, all bodies if left out; body whose node a Point Force takes")
      .optional()
      .reals("Point", std::nullopt,
             "place of a Point Force; point about which a Rotation turns in the plane, or of its axis in space, the origin if left out",
             "length")
      .optional()
      .real("Tolerance", std::nullopt, "Point Force: largest distance of the nearest node; 1e-6 of the bodies' extent if left out",
            Range::positive(), "length")
      .optional()
      .reals("Direction", std::nullopt, "Preload: the axis of its bolt, of any length")
      .optional()
      .real("Length", std::nullopt, "Preload: from where the force enters the body to where it leaves it, as between head and nut",
            Range::positive(), "length")
      .optional()
      .real("Reference Temperature", std::nullopt, "Temperature: where a body has no thermal strain; 0 if left out", Range::any(),
            "temperature")
      .optional()
      .real("Normal Stiffness", std::nullopt, "Elastic Support: pressure per displacement along the normal; 0 if left out",
            Range::atLeast(0.0), "stress / length")
      .optional()
      .real("Tangential Stiffness", std::nullopt, "Elastic Support: the same along the side; 0 if left out", Range::atLeast(0.0),
            "stress / length")
      .optional()
      .integer("Seed", std::nullopt, "Random Load: forces depend on it, on the number of the node and on the component only; 0 if left out")
      .optional()
      .real("Amplitude", std::nullopt, "Random Load: forces are uniform between minus and plus this", Range::positive(), "force")
      .optional()
      .real("Mean", std::nullopt, "Random Load: added to every component; 0 if left out", Range::any(), "force")
      .optional();
}

}  // namespace suture
