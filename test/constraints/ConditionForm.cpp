// Parameters of the types of boundary conditions: missing ones, superfluous ones, and springs that hold bodies.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/motion/RigidMotion.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

TEUCHOS_UNIT_TEST(ConditionForm, ReportsMissingAndSuperfluousParametersOfLoads) {
  const Mesh mesh = stack(1);
  const std::string text =
      said(mesh, bilateral("hold", "b0_bottom") + entry("lost", {{"Type", "Point Force"}, {"Value", "{1, 2}"}}) +
                     entry("in space", {{"Type", "Point Force"}, {"Value", "{1, 2}"}, {"Point", "{1, 2, 3}"}}) +
                     entry("on a side", {{"Type", "Point Force"}, {"Value", "{1, 2}"}, {"Point", "{1, 2}"}, {"Group", "b0_top"}}) +
                     entry("slack", {{"Type", "Elastic Support"}, {"Group", "b0_top"}}) +
                     entry("stiff gravity", {{"Type", "Gravity"}, {"Value", "{0, -1}"}, {"Normal Stiffness", "1.0"}}) +
                     entry("varying force", {{"Type", "Force"}, {"Group", "b0_top"}, {"Expression x", "x"}}) +
                     entry("three strains", {{"Type", "Initial Strain"}, {"Value", "{1, 2, 3}"}}) +
                     entry("bolt", {{"Type", "Preload"}, {"Value", "1"}, {"Body", "b1"}}) +
                     entry("mean", {{"Type", "Mean Displacement"}, {"Group", "b0_top"}, {"Value", "{1, 2}"}, {"Components", "x"}}));
  for (const std::string part : {"lost/Point: is missing: a Point Force needs it", "in space/Point: 3 coordinates; expected 2",
                                 "on a side/Group: a Point Force acts at a point, not on a curve group; give its position in Point",
                                 "slack/Normal Stiffness: an Elastic Support needs a stiffness above zero, here or in Tangential Stiffness",
                                 "stiff gravity/Normal Stiffness: only an Elastic Support takes this parameter; found in a Gravity",
                                 "varying force/Expression x: not a parameter of this Force: expected numbers in Value",
                                 "three strains/Value: 3 values; this Initial Strain needs 4 values",
                                 "bolt/Direction: is missing: a Preload needs it", "bolt/Length: is missing: a Preload needs it",
                                 "bolt/Body: no such body 'b1'", "mean/Value: 2 values; this Mean Displacement needs 1 value"})
    SUTURE_CHECK_SAYS(text, "Boundary Conditions/" + part);
}

TEUCHOS_UNIT_TEST(ConditionForm, HoldsABodyByElasticSupportsAsFarAsTheyReach) {
  const Mesh mesh = stack(1);
  const auto freeMotions = [&](const std::vector<std::pair<std::string, std::string>>& stiffness) {
    std::vector<std::pair<std::string, std::string>> all{{"Type", "Elastic Support"}, {"Group", "b0_bottom"}};
    all.insert(all.end(), stiffness.begin(), stiffness.end());
    return Matrix(freeRigidMotions(mesh, build(mesh, entry("bed", all))).parts[0].free);
  };
  const Matrix slides = freeMotions({{"Normal Stiffness", "2.0"}});
  TEST_EQUALITY(slides.cols(), 1);
  TEST_COMPARE(std::abs(std::abs(slides(0, 0)) - 1.0), <, 1e-12);  // along the bed
  TEST_EQUALITY(freeMotions({{"Normal Stiffness", "2.0"}, {"Tangential Stiffness", "1e-6"}}).cols(), 0);
  TEST_EQUALITY(freeMotions({{"Tangential Stiffness", "1.0"}}).cols(), 2);
}

// Values, components and expressions for three directions.
TEUCHOS_UNIT_TEST(ConditionForm, HasAnEntryForEachDirectionIn3D) {
  Box box;
  box.name = "b0";
  box.nx = box.ny = box.nz = 2;
  box.cell = Cell::Hexahedron8;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"b0"});
  Constants constants{{"A", 2.5}};
  constants.dimension = 3;
  const auto with = [](const std::string& name, std::vector<std::pair<std::string, std::string>> more) {
    more.insert(more.begin(), {{"Group", "b0_top"}, {"Type", name}});
    return entry(name, more);
  };
  TEST_EQUALITY(said(mesh, displacement("hold", "b0_bottom", "{0, 0, 0}") + with("Traction", {{"Value", "{1, 2, 3}"}}) +
                               with("Moment", {{"Value", "{1, 2, 3}"}}) + with("Pressure", {{"Value", "1"}}) +
                               entry("Rotation", {{"Type", "Rotation"}, {"Value", "{0, 0, 1}"}, {"Point", "{1, 2, 3}"}}) +
                               entry("Initial Stress", {{"Type", "Initial Stress"}, {"Value", "{1, 2, 3, 4, 5, 6}"}})),
                "no error");
  const std::string text =
      said(mesh, displacement("two", "b0_bottom", "{0, 0}") + with("Traction", {{"Value", "{1, 2}"}}) + with("Moment", {{"Value", "1"}}) +
                     entry("four", {{"Type", "Initial Strain"}, {"Value", "{1, 2, 3, 4}"}}) + entry("nowhere", {{"Type", "Bilateral"}}) +
                     entry("flat", {{"Type", "Traction"}, {"Group", "b0_top"}, {"Expression x", "1"}, {"Expression y", "1"}}) +
                     entry("lost", {{"Type", "Pressure"}, {"Group", "b0_topp"}, {"Value", "1"}}));
  for (const std::string part :
       {"two/Value: 2 values; this Displacement needs 3 values, as in {0.0, 0.0, 0.0}, or Expression x, Expression y and Expression z",
        "Traction/Value: 2 values; this Traction needs 3 values", "Moment/Value: 1 values; this Moment needs 3 values",
        "four/Value: 4 values; this Initial Strain needs 6 values",
        "nowhere/Group: is missing: a Bilateral needs a surface group. Surface groups: b0_back, b0_bottom, b0_front, ",
        "flat/Expression z: is missing: this Traction needs Expression x, Expression y and Expression z",
        "lost/Group: in the mesh boxes: no such surface group 'b0_topp'. Did you mean 'b0_top'?"})
    SUTURE_CHECK_SAYS(text, "Boundary Conditions/" + part);

  const Constraints some = build(mesh, displacement("slide", "b0_top", "{0.5, -1}", "xz"));
  TEST_EQUALITY(some.rules.size(), std::size_t(9));
  for (const NodeRule& rule : some.rules) {
    TEST_ASSERT(rule.fixed[0] && !rule.fixed[1] && rule.fixed[2]);
    TEST_EQUALITY(rule.value[0], 0.5);
    TEST_EQUALITY(rule.value[2], -1.0);
  }
  SUTURE_CHECK_SAYS(said(stack(1), displacement("up", "b0_left", "1", "z")), "up/Components: 'z' in 2D; expected All, x or y");
}

TEUCHOS_UNIT_TEST(ConditionForm, HoldsABodyIn3DByElasticSupportsAsFarAsTheyReach) {
  Box box;
  box.name = "b0";
  box.nx = box.ny = box.nz = 1;
  box.cell = Cell::Hexahedron8;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"b0"});
  const auto freeMotions = [&](const std::string& which) {
    const Constraints constraints = build(mesh, entry("bed", {{"Type", "Elastic Support"}, {"Group", "b0_bottom"}, {which, "2.0"}}));
    return freeRigidMotions(mesh, constraints).parts[0];
  };
  const RigidPart slides = freeMotions("Normal Stiffness");
  TEST_EQUALITY(slides.free.cols(), 3);  // two translations along the bed and the rotation about its normal
  TEST_COMPARE(slides.free.row(2).norm() + slides.free.row(3).norm() + slides.free.row(4).norm(), <, 1e-12);
  TEST_EQUALITY(freeMotions("Tangential Stiffness").free.cols(), 3);  // off the bed, and rotations about lines in it
  Vector turn = Vector::Zero(6);
  turn[5] = 1.0, turn[1] = -0.5;  // the point half a radius from the centre along x does not move
  SUTURE_CHECK_SAYS(inWords(slides, turn, 3), "turn about the axis (0, 0, 1) through (0.933, 0.5, 0.5)");
}
