#include "Watch.hpp"

#include "Board.hpp"
#include "Names.hpp"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

namespace mpiorder {

namespace {

[[noreturn]] void end(double seconds) {
  std::string text = "no rank has moved for " + std::to_string(static_cast<int>(seconds)) + " seconds:\n";
  for (int rank = 0; rank < board().ranks(); ++rank) {
    const RankState& state = board().state(rank);
    text += "  rank " + std::to_string(rank) + " waits in " + nameOf(static_cast<Function>(state.functionIndex.load())) +
            "; called by, or its last collective was called by,\n        " + board().text(state.placeText) + "\n";
  }
  board().endJob(text);
}

void* run(void*) {
  const char* chosen = std::getenv("MPI_ORDER_PATIENCE");
  const double patience = chosen ? std::atof(chosen) : 20.0, step = 0.25;
  std::uint64_t before = 0;
  double quiet = 0.0;
  for (;;) {
    usleep(static_cast<useconds_t>(step * 1e6));
    std::uint64_t steps = 0;
    bool allWait = true;
    for (int rank = 0; rank < board().ranks(); ++rank) {
      steps += board().state(rank).steps.load();
      allWait = allWait && board().state(rank).functionIndex.load() >= 0;
    }
    quiet = allWait && steps == before ? quiet + step : 0.0;
    before = steps;
    if (quiet >= patience) end(quiet);
  }
}

}  // namespace

void watch() {
  if (board().rank() != 0) return;
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // signals go to the program's own threads
  pthread_attr_t small;
  pthread_attr_init(&small);
  pthread_attr_setstacksize(&small, 1 << 17);
  pthread_t thread;
  if (pthread_create(&thread, &small, &run, nullptr) == 0) pthread_detach(thread);
  pthread_attr_destroy(&small);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace mpiorder
