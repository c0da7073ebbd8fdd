#include "StopSignals.hpp"

#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <suture/base/Errors.hpp>

namespace suture {

namespace {

constexpr unsigned secondsToStop = 4;  // seconds

volatile std::sig_atomic_t stopAsked = 0;
std::function<bool()> host;  // empty without a host

// The following functions are safe in signal handlers.
void say(const char* text, std::size_t length) {
  if (!takesText(STDERR_FILENO, 0) || write(STDERR_FILENO, text, length) < 0) return;
}

void giveUp(int) {
  static const char text[] = "suture: stopped on request; no iteration ended within four seconds, and no new checkpoint was written\n";
  say(text, sizeof text - 1);
  _exit(static_cast<int>(ExitCode::Stopped));
}

void ask(int) { stopAsked = 1; }

void askInAHurry(int number) {
  if (stopAsked != 0) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  stopAsked = 1;
  std::signal(SIGALRM, giveUp);
  alarm(secondsToStop);
}

}  // namespace

StopsByHost::StopsByHost(std::function<bool()> isAsked) { host = std::move(isAsked); }
StopsByHost::~StopsByHost() { host = nullptr; }

void listenForStop(RunMonitor& monitor) {
  monitor.stopWhen(stopWasAsked);
  if (host) return;
  std::signal(SIGUSR1, ask);
  std::signal(SIGTERM, askInAHurry);
  std::signal(SIGINT, askInAHurry);
}

bool stopWasAsked() { return host ? host() : stopAsked != 0; }

void stopIsHeard() {
  if (!host) alarm(0);
}

bool takesText(int file, int milliseconds) {
  pollfd reader{file, POLLOUT, 0};
  return poll(&reader, 1, milliseconds) > 0;
}

}  // namespace suture
