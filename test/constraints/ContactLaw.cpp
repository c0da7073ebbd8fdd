#include <Teuchos_UnitTestHarness.hpp>
#include <limits>
#include <pairs/RoughLaw.hpp>
#include <suture/pairs/ContactLaw.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

ContactTrial trial(double force, double jump) {
  ContactTrial t;
  t.force[0] = force;
  t.jump[0] = jump;
  return t;
}

}  // namespace

// Signorini: forces f >= 0, gap g >= 0, f g = 0 are equivalent to f = max(0, f - c g) with any c > 0.
TEUCHOS_UNIT_TEST(ContactLaw, FrictionlessPairsAreClosedWhereTheProjectedForcePresses) {
  const Frictionless law;
  for (const double force : {-2.0, 0.0, 3.0})
    for (const double jump : {-1.5, 0.0, 0.5}) {
      const double projected = std::max(0.0, force + jump);
      for (const PairStatus now : {PairStatus::Open, PairStatus::Slip}) {
        const ContactState next = law.project(trial(force, jump), now);
        TEST_EQUALITY(next.closed(), force + jump == 0.0 ? now == PairStatus::Slip : projected > 0.0);
        TEST_ASSERT(next.status != PairStatus::Stick);
      }
    }
  TEST_EQUALITY(law.rows(2), 1);
  TEST_EQUALITY(law.rows(3), 1);
  TEST_THROW(law.project(trial(std::numeric_limits<double>::quiet_NaN(), 0.0), {}), NumericalError);
}

// Contract of every law: a pair that is pressed without slip is closed; its state is the projection of its force; a pair that is pulled
// opens if the law allows it; the decision does not depend on the unit of force; the number of rows is one or the dimension.
TEUCHOS_UNIT_TEST(ContactLaw, EveryRegisteredLawKeepsTheContract) {
  TEST_ASSERT(Registry<ContactLaw>::instance().has(Frictionless::kName));
  for (const std::string& name : Registry<ContactLaw>::instance().names()) {
    const auto law = Registry<ContactLaw>::instance().make(name, Constants(), Parameters());
    for (const int dimension : {2, 3}) TEST_ASSERT(law->rows(dimension) == 1 || law->rows(dimension) == dimension);
    const ContactState pressed = law->pressed();
    TEST_ASSERT(pressed.closed());
    TEST_ASSERT(law->project(trial(1.0, 0.0), pressed) == pressed);
    TEST_EQUALITY(law->project(trial(0.0, -1.0), pressed).closed(), !law->separates());
    for (const double unit : {1e-30, 1e30}) {
      TEST_EQUALITY(law->project(trial(unit, 0.0), {}).closed(), true);
      TEST_EQUALITY(law->project(trial(-unit, 0.0), pressed).closed(), !law->separates());
    }
  }
}

const Registration<ContactLaw> rough("Rough", Schema("What is pressed sticks."),
                                     [](const Constants&, const Parameters&) { return std::make_unique<RoughLaw>(); });

// A user's law is chosen by name for each contact; a scene that names none is frictionless.
TEUCHOS_UNIT_TEST(ContactLaw, IsChosenByItsNameInTheScene) {
  Schema schema("scene");
  schema.list("Contact", Schema("lines").each("<line>", contactSchema()));
  const std::string law = "<Parameter name=\"Law\" type=\"string\" value=\"";
  const auto line = [](const std::string& name, const std::string& more) {
    return "<ParameterList name=\"" + name + "\"><Parameter name=\"Side A\" type=\"string\" value=\"a\"/>" +
           "<Parameter name=\"Side B\" type=\"string\" value=\"b\"/>" + more + "</ParameterList>";
  };
  const auto lawsOf = [&](const std::string& lines) {
    const std::string text = "<ParameterList name=\"Suture\"><ParameterList name=\"Contact\">" + lines + "</ParameterList></ParameterList>";
    return ContactLaws(parseScene(text, "test.xml", schema, {}).parameters->sublist("Contact"));
  };
  const ContactLaws laws = lawsOf(line("first", "") + line("second", law + "Rough\"/>") + line("third", law + "Frictionless\"/>"));
  TEST_EQUALITY(laws.size(), 3);
  for (const int at : {0, 1, 2, 3}) TEST_EQUALITY(laws.of(at).rows(2), at == 1 ? 2 : 1);
  TEST_THROW(lawsOf(line("first", law + "Ruogh\"/>")), InputError);
}

// A state that the law does not have is an error at once.
TEUCHOS_UNIT_TEST(ContactLaw, RefusesAnswersThatAreNoState) {
  struct Wrong : RoughLaw {
    ContactState answer;
    ContactState doProject(const ContactTrial&, const ContactState&) const override { return answer; }
  };
  Wrong law;
  for (const ContactState& answer : {ContactState(PairStatus::Slip, {0, 2, 0}, 0.0), ContactState(PairStatus::Stick, {0, 1, 0}, 1.0),
                                     ContactState(PairStatus::Slip, {0, 1, 0}, -1.0)}) {
    law.answer = answer;
    TEST_THROW(law.project({}, {}), InternalError);
  }
  law.answer = {PairStatus::Slip, {0, 0.6, 0.8}, 2.0};
  TEST_NOTHROW(law.project({}, {}));
}

TEUCHOS_UNIT_TEST(ContactLaw, AnOpenPairHoldsNoRowAndAStickingOneAll) {
  for (int component = 0; component < 3; ++component) {
    TEST_ASSERT(!ContactState(PairStatus::Open).holds(component));
    TEST_EQUALITY(ContactState(PairStatus::Slip).holds(component), component == 0);
    TEST_ASSERT(ContactState(PairStatus::Stick).holds(component));
  }
}
