#pragma once
#include <mutex>
#include <string>

namespace suture {

/// Where a run is, for another thread that tells its user: the phase, the step within it, how much of it is done. The program that wants to
/// know makes one and watches; the library tells whoever watches the thread it runs on. Nobody watching costs one look at a pointer.
class Progress {
 public:
  /// Plain.
  struct State {
    std::string phase, step;  ///< "factor", "factoring the subdomains"; empty: none
    double since = 0.0;       ///< begin of the phase, by Timers::now() [s]
    std::string unit;         ///< counted things: "subdomains"
    long done = 0;            ///< number of things done, or of iterations
    long total = 0;           ///< number of things to do; zero: not known
    double residual = -1.0;   ///< residual of the last iteration, relative to the start; negative: none runs
    double tolerance = 0.0;   ///< residual at which the iterations end
  };
  State state() const;

  /// Watches the thread that made it while it lives: what this thread does is told to `progress`.
  class Watch {
   public:
    explicit Watch(Progress& progress);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    Progress* before_;
  };

  /// Begins a phase; empty: ends it.
  static void phase(const std::string& name);
  /// A step of the phase, while it lives.
  struct Step {
    explicit Step(const std::string& name);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;
  };
  /// Counts one more of `total` things.
  static void count(const char* unit, long total);
  /// Counts an iteration.
  static void iteration(long number, double residual, double tolerance);

 private:
  template <typename Change>
  void change(const Change& change);

  mutable std::mutex mutex_;
  State state_;
};

}  // namespace suture
