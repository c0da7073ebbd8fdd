#include <suture/report/RunMonitor.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <sstream>
#include <suture/base/Errors.hpp>

using namespace suture;

namespace {

TEUCHOS_UNIT_TEST(RunMonitor, PrintsTheTableOfTheStylePage) {
  std::ostringstream console;
  RunMonitor monitor(&console, false);
  monitor.auxiliary({8, 22.6, 1e-2, 3e-3, true});
  monitor.outer({1, 9, 24.1, 3.1e-3, 1e-3, 84, 5, -1.2093e8, 1.0, 0.02});
  monitor.outer({2, 7, 24.0, 4.4e-6, 1e-6, 87, 3, -1.2094e8, 1.0, 0.03});
  monitor.inner(1, 0.5);  // not wanted, hence not printed
  TEST_EQUALITY(console.str(),
                "auxiliary problem (all pairs closed)      8 PCG    condition 22.6    1.0e-02\n"
                "  k   PCG   condition   residual   active  changed         energy    seconds\n"
                "  1     9        24.1    3.1e-03       84        5    -1.2093e+08       0.02\n"
                "  2     7        24.0    4.4e-06       87        3    -1.2094e+08       0.03\n");
}

TEUCHOS_UNIT_TEST(RunMonitor, CallsALinearSceneByItsName) {
  std::ostringstream console;
  RunMonitor monitor(&console, false);
  monitor.auxiliary({12, 3.0, 1e-8, 3e-9, false});
  TEST_ASSERT(console.str().find("linear problem") == 0);
  TEST_ASSERT(console.str().find("12 PCG") != std::string::npos);
  TEST_ASSERT(console.str().find("pairs") == std::string::npos);
}

TEUCHOS_UNIT_TEST(RunMonitor, CollectsEverythingInSilenceToo) {
  RunMonitor monitor(nullptr, false);
  monitor.auxiliary({8, 22.6, 1e-2, 3e-3, true});
  monitor.outer({1, 9, 24.1, 3.1e-3, 1e-3, 84, 5, -1.2093e8, 0.75, 0.02});
  monitor.note("mu is 21.6");
  TEST_EQUALITY(monitor.rows().size(), 1);
  TEST_EQUALITY(monitor.rows()[0].step, 0.75);
  TEST_EQUALITY(monitor.notes().size(), 1);
  TEST_EQUALITY(monitor.notes()[0], "mu is 21.6");
}

TEUCHOS_UNIT_TEST(RunMonitor, PrintsInnerIterationsOnRequest) {
  std::ostringstream console;
  RunMonitor monitor(&console, true);
  TEST_ASSERT(monitor.wantsInner());
  monitor.inner(3, 1.25e-4);
  TEST_ASSERT(console.str().find("3   1.250e-04") != std::string::npos);
}

TEUCHOS_UNIT_TEST(RunMonitor, TurnsWarningsButNotNotesIntoErrorsWhenStrict) {
  RunMonitor lenient(nullptr, false), strict(nullptr, false, true);
  TEST_NOTHROW(lenient.note("warning: a subdomain was split"));
  TEST_NOTHROW(strict.note("relaxation 0.08 chosen"));
  TEST_THROW(strict.note("warning: a subdomain was split"), InputError);
}

TEUCHOS_UNIT_TEST(RunMonitor, ColoursOnRequestOnly) {
  std::ostringstream console;
  RunMonitor monitor(&console, false);
  TEST_EQUALITY(monitor.in(RunMonitor::Colour::Bad, "not converged"), "not converged");
  monitor.useColours();
  TEST_EQUALITY(monitor.in(RunMonitor::Colour::Bad, "not converged"), "\033[31mnot converged\033[0m");
  monitor.note("a choice");
  TEST_EQUALITY(console.str(), "   note: a choice\n");
}

TEUCHOS_UNIT_TEST(RunMonitor, PrintsEachWarningOnceAndCountsThemAtTheEnd) {
  std::ostringstream console;
  RunMonitor monitor(&console, false);
  for (const char* note :
       {"warning: a subdomain was split", "relaxation 0.08 chosen", "warning: nu is near .5", "warning: a subdomain was split"})
    monitor.note(note);
  monitor.countWarnings();
  TEST_EQUALITY(
      console.str(),
      "   warning: a subdomain was split\n   note: relaxation 0.08 chosen\n   warning: nu is near .5\n   2 warnings, see above\n");
  TEST_EQUALITY(monitor.notes().size(), 3);
  std::ostringstream one, none;
  RunMonitor single(&one, false), silent(&none, false);
  single.note("warning: nu is near .5");
  single.countWarnings();
  TEST_EQUALITY(one.str(), "   warning: nu is near .5\n   1 warning, see above\n");
  silent.countWarnings();
  TEST_EQUALITY(none.str(), "");
}

}  // namespace
