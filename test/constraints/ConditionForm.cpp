// Forms of the types of boundary conditions: what is missing, what is too much, and the springs that hold bodies.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/constraints/ConditionForm.hpp>
#include <suture/constraints/RigidMotion.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

TEUCHOS_UNIT_TEST(ConditionForm, TellsWhatLoadsLackOrHaveTooMuch) {
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
                                 "on a side/Group: a Point Force acts at a point, not on a curve group; name its place in Point",
                                 "slack/Normal Stiffness: an Elastic Support needs a stiffness above zero, here or in Tangential Stiffness",
                                 "stiff gravity/Normal Stiffness: only an Elastic Support has it; found in a Gravity",
                                 "varying force/Expression x: this Force does not have it: expected numbers in Value",
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
