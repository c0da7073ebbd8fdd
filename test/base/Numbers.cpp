#include <suture/base/Numbers.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <cstdlib>

namespace {

using namespace suture;

TEUCHOS_UNIT_TEST(Numbers, RealsAreConsumedEntirely) {
  TEST_EQUALITY(parseReal("0.52e10").value(), 5.2e9);
  TEST_EQUALITY(parseReal(" -2.5e-2 ").value(), -0.025);
  TEST_EQUALITY(parseReal("+1").value(), 1.0);
  for (const char* bad : {"", " ", "abc", "1e-8x", "1,5", "1 2", "--1", "+-1", "1e", "0x10", "nan", "inf", "-inf", "1e999"})
    TEST_ASSERT(!parseReal(bad).has_value());
}

TEUCHOS_UNIT_TEST(Numbers, IntegersAreConsumedEntirely) {
  TEST_EQUALITY(parseInteger("-12").value(), -12);
  for (const char* bad : {"", "abc", "3.7", "3.0", "1e3", "12a", "2147483648", "0x10"}) TEST_ASSERT(!parseInteger(bad).has_value());
}

TEUCHOS_UNIT_TEST(Numbers, EntriesNeedBothBracesAndNoGaps) {
  TEST_ASSERT((parseEntries("{ a, b c ,d}").value() == std::vector<std::string>{"a", "b c", "d"}));
  TEST_ASSERT((parseEntries("a").value() == std::vector<std::string>{"a"}));
  TEST_ASSERT(parseEntries("{}").value().empty());
  TEST_ASSERT((parseEntries("{{1, 2}, b={3, {4}},c}").value() == std::vector<std::string>{"{1, 2}", "b={3, {4}}", "c"}));
  for (const char* bad : {"{{1, 2}", "{{1}, 2}}", "{1}, {2}", "{{1, 2},}"}) TEST_ASSERT(!parseEntries(bad).has_value());
  for (const char* bad : {"", "{a", "a}", "{a,}", "{,a}", "{a,,b}", "{"}) TEST_ASSERT(!parseEntries(bad).has_value());
}

TEUCHOS_UNIT_TEST(Numbers, TextOfANumberReadsBackExactly) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-8, -5.2e9, 4.9e-324, 1.7976931348623157e308})
    TEST_EQUALITY(std::strtod(realText(value).c_str(), nullptr), value);
  TEST_EQUALITY(realText(0.1), "0.1");
}

}  // namespace
