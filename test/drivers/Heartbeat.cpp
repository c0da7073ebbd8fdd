// Console output while a phase takes long, read through a pipe as a batch system does.
#include <unistd.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <suture/base/Timers.hpp>
#include <thread>

#include "../../drivers/support/Heartbeat.hpp"
#include "../../drivers/support/RemainingTime.hpp"
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
  TEST_EQUALITY(Heartbeat::line(state, 17.2, 38.0), "   ... solve: 7 s, iteration 41, residual 3.2e-04 of 1.0e-08 in about 40 s");
  state.path = 0.25;
  state.pathSince = -83.0;
  TEST_EQUALITY(Heartbeat::line(state, 17.0, 300.0),
                "   ... load steps: 100 s, 25 % done, about 5 min left; solve: 7 s, iteration 41, residual 3.2e-04 of 1.0e-08");
}

/// A run of known duration: its state at each time, seen as the heartbeat sees it.
struct Imitation {
  double whole;                                  // seconds
  std::function<Progress::State(double)> state;  // at a time after the start
};

Progress::State counted(long done, long total) {
  Progress::State state;
  state.phase = "factor";
  state.unit = "subdomains";
  state.done = done;
  state.total = total;
  return state;
}

Progress::State iterating(long number, double residual, double tolerance) {
  Progress::State state;
  state.phase = "solve";
  state.done = number;
  state.residual = residual;
  state.tolerance = tolerance;
  return state;
}

Progress::State following(double part, double now) {
  Progress::State state = iterating(static_cast<long>(now), 1e-3, 1e-8);  // which must not count
  state.since = now;                                                      // phases change all the time
  state.path = part;
  return state;
}

struct Estimates {
  bool early = false;               // shown within the first percent
  int shown = 0, all = 0;           // in the second half
  double worst = 1.0;               // ratio of estimate and truth from half of the time to nine tenths
  double last = 0.0;                // largest error in the last tenth, as part of the whole time
  double lowest = 0.0, jump = 0.0;  // smallest estimate; largest change in a second, beyond the second itself, relative to the estimate
};

Estimates estimatesOf(const Imitation& run) {
  RemainingTime remaining;
  Estimates found;
  double before = -1.0, second = 0.0;
  for (double now = 0.0; now < run.whole; now += 0.1) {
    const std::optional<double> left = remaining.after(run.state(now), now);
    const double truth = run.whole - now;
    if (left && now < 0.01 * run.whole) found.early = true;
    if (left) found.lowest = std::min(found.lowest, *left);
    if (now >= 0.5 * run.whole && truth > 2.0) {
      ++found.all;
      if (left) ++found.shown;
      if (left && now <= 0.9 * run.whole) found.worst = std::max({found.worst, *left / truth, truth / std::max(*left, 1e-3)});
      if (left && now > 0.9 * run.whole) found.last = std::max(found.last, std::abs(*left - truth) / run.whole);
    }
    if (now - second < 1.0) continue;
    if (left && before >= 0.0 && *left > 5.0) found.jump = std::max(found.jump, std::abs(*left - (before - (now - second))) / before);
    before = left ? *left : -1.0;
    second = now;
  }
  return found;
}

void checkEstimates(const std::string& name, const Imitation& run, Teuchos::FancyOStream& out, bool& success) {
  const Estimates found = estimatesOf(run);
  out << name << ": shown " << found.shown << " of " << found.all << ", worst ratio " << found.worst << ", largest jump " << found.jump
      << "\n";
  TEST_ASSERT(!found.early);
  TEST_EQUALITY(found.shown, found.all);
  TEST_COMPARE(found.worst, <=, 2.0);
  TEST_COMPARE(found.last, <=, 0.1);
  TEST_COMPARE(found.lowest, >=, 0.0);
  TEST_COMPARE(found.jump, <=, 0.3);
}

TEUCHOS_UNIT_TEST(RemainingTime, IsWithinAFactorOfTwoInTheSecondHalf) {
  const auto wave = [](double x) { return std::sin(37.0 * x) * std::cos(11.0 * x); };  // between -1 and 1, not periodic within a run
  checkEstimates("steady load steps", {100.0, [](double t) { return following(std::floor(t / 2.0) / 50.0, t); }}, out, success);
  checkEstimates("load steps of unequal duration",
                 {120.0,
                  [&](double t) {
                    double end = 0.0;  // 40 steps of one to five seconds, three on average
                    int step = 0;
                    for (; step < 40; ++step)
                      if ((end += 3.0 + 2.0 * wave(step)) > t) break;
                    return following(std::min(step / 40.0, 1.0), t);
                  }},
                 out, success);
  checkEstimates("iterations with a constant rate and oscillations",
                 {60.0, [&](double t) { return iterating(long(4 * t), std::pow(1e-8, t / 60.0) * (1.0 + 0.5 * wave(t)), 1e-8); }}, out,
                 success);
  checkEstimates("iterations that speed up",
                 {60.0, [](double t) { return iterating(long(4 * t), std::pow(1e-8, std::pow(t / 60.0, 1.5)), 1e-8); }}, out, success);
  checkEstimates("subdomains of unequal size",
                 {40.0, [&](double t) { return counted(long(512 * (t / 40.0 + 0.02 * wave(t / 10.0)) + 0.5), 512); }}, out, success);
  checkEstimates("an hour of load steps that slow down",
                 {3600.0, [](double t) { return following(std::floor(200.0 * std::pow(t / 3600.0, 0.8)) / 200.0, t); }}, out, success);
}

TEUCHOS_UNIT_TEST(RemainingTime, IsUnknownForIterationsThatStagnateAndAtTheBeginning) {
  RemainingTime remaining;
  for (double t = 0.0; t < 100.0; t += 0.1) {
    const double residual = t < 10.0 ? std::pow(1e-3, t / 10.0) : 1e-3;  // no progress after ten seconds
    const std::optional<double> left = remaining.after(iterating(long(4 * t), residual, 1e-8), t);
    if (t < 0.5) TEST_ASSERT(!left);
    if (t > 25.0) TEST_ASSERT(!left);
  }
}

TEUCHOS_UNIT_TEST(RemainingTime, IsUnknownOnceAllObjectsAreCounted) {
  RemainingTime remaining;
  for (double t = 0.0; t < 4.0; t += 0.1) remaining.after(counted(long(3 * t), 12), t);
  TEST_ASSERT(remaining.after(counted(11, 12), 4.0).has_value());
  TEST_ASSERT(!remaining.after(counted(12, 12), 4.1));
}

TEUCHOS_UNIT_TEST(RemainingTime, StartsAnewWithEachSolve) {
  RemainingTime remaining;
  for (double t = 0.0; t < 20.0; t += 0.1) remaining.after(iterating(long(4 * t), std::pow(1e-8, t / 20.0), 1e-8), t);
  TEST_ASSERT(!remaining.after(iterating(1, 0.9, 1e-9), 20.1));  // the next solve has another tolerance
  TEST_ASSERT(!remaining.after(Progress::State(), 20.2));
}

TEUCHOS_UNIT_TEST(RemainingTime, SpeaksInRoundNumbers) {
  TEST_EQUALITY(RemainingTime::words(2.0), "a few seconds");
  TEST_EQUALITY(RemainingTime::words(38.0), "about 40 s");
  TEST_EQUALITY(RemainingTime::words(58.0), "about 1 min");
  TEST_EQUALITY(RemainingTime::words(740.0), "about 12 min");
  TEST_EQUALITY(RemainingTime::words(3600.0 * 3.46), "about 3.5 h");
}

}  // namespace
