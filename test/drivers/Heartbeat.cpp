// Console output while a phase takes long, read through a pipe as a batch system does.
#include <unistd.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <chrono>
#include <iostream>
#include <suture/base/Timers.hpp>
#include <thread>

#include "../../drivers/support/Heartbeat.hpp"
#include "../../drivers/support/StoppableOutput.hpp"

using namespace suture;

namespace {

/// Text that `work` writes to standard output and error, both redirected into one pipe.
template <typename Work>
std::string textOf(const Work& work) {
  std::cout.flush();
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  const int before[] = {dup(STDOUT_FILENO), dup(STDERR_FILENO)};
  dup2(ends[1], STDOUT_FILENO);
  dup2(ends[1], STDERR_FILENO);
  close(ends[1]);
  {
    const StoppableOutput output;
    work();
  }
  dup2(before[0], STDOUT_FILENO);
  dup2(before[1], STDERR_FILENO);
  for (const int file : before) close(file);
  std::string text(4096, '\0');
  text.resize(static_cast<std::size_t>(read(ends[0], text.data(), text.size())));
  close(ends[0]);
  return text;
}

void takes(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

TEUCHOS_UNIT_TEST(Heartbeat, TellsALongPhaseBetweenTheLinesOfTheProgram) {
  const std::string text = textOf([] {
    const Heartbeat heartbeat(true);
    Timers timers;
    {
      const Timers::Scope scope(timers, "partition");
      takes(0.3);
    }
    const Timers::Scope scope(timers, "factor");
    const Progress::Step step("factoring the subdomains");
    Progress::count("subdomains", 8);
    std::cout << "a line ";
    std::cout << "in two pieces" << std::endl;
    takes(2.5);
    std::cout << "the end" << std::endl;
  });
  TEST_EQUALITY(text, "a line in two pieces\n   ... factor: 2 s, factoring the subdomains, 1 of 8 subdomains\nthe end\n");
}

TEUCHOS_UNIT_TEST(Heartbeat, IsSilentWithinALineAndWhenNobodyListens) {
  const std::string text = textOf([] {
    Timers timers;
    const Heartbeat heartbeat(true);
    std::cout << "begun, " << std::flush;
    const Timers::Scope scope(timers, "solve");
    takes(2.3);
    std::cout << "done" << std::endl;
  });
  TEST_EQUALITY(text, "begun, done\n");
  TEST_EQUALITY(textOf([] {
                  const Heartbeat heartbeat(false);
                  Timers timers;
                  const Timers::Scope scope(timers, "solve");
                  takes(2.3);
                }).size(),
                0);
}

TEUCHOS_UNIT_TEST(Heartbeat, SaysWhatIsLeftOfAnIteration) {
  Progress::State state;
  state.phase = "solve";
  state.since = 10.0;
  state.done = 41;
  state.residual = 3.2e-4;
  state.tolerance = 1e-8;
  TEST_EQUALITY(Heartbeat::line(state, 17.2), "   ... solve: 7 s, iteration 41, residual 3.2e-04 of 1.0e-08");
}

}  // namespace
