#pragma once
#include <suture/base/Types.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Wall time of the named phases of a run, in the order in which they first began. One object per run, passed as an argument; no global
/// state.
class Timers {
 public:
  /// Adds the time between construction and destruction to a phase; phases do not nest.
  class Scope {
   public:
    Scope(Timers& timers, const std::string& phase);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
    std::string phase_;
    double begin_;
  };

  struct Statistics {
    std::string phase;
    double min, avg, max;  ///< seconds over ranks
  };

  void add(const std::string& phase, double seconds);
  double seconds(const std::string& phase) const;
  /// Seconds since construction.
  double total() const;
  Timers();

  /// Statistics over all ranks, the same on every rank; a rank that never entered a phase counts as 0. Collective.
  std::vector<Statistics> statistics(const Comm& comm) const;

  /// Seconds of a monotonic clock.
  static double now();

 private:
  double begin_;
  std::vector<std::string> order_;
  std::map<std::string, double> seconds_;
};

/// Returns the result of `make` and adds its time to a phase.
template <typename Make>
auto timed(Timers& timers, const std::string& phase, const Make& make) {
  const Timers::Scope scope(timers, phase);
  return make();
}

/// High-water mark of this process's resident memory [MB of 1024 kB].
double peakMemoryMb();

/// Returns freed memory that malloc retains to the system, before a file is written, so that its pages serve for the file. Where the host
/// of a virtual machine has taken back unused memory, fresh pages cost more than writing to them. Phase write at 1M unknowns on such a
/// machine, without and with, medians of 4 and 5: tunnel on two ranks 0.40 and 0.25 s, on one 0.51 and 0.47; hertz 0.19 and 0.26, 0.87 and
/// 0.45. Local.
void giveBackFreedMemory();

/// Resets the high-water mark to the memory resident now, for programs that run several scenes. False if the system does not support it.
bool resetPeakMemory();

}  // namespace suture
