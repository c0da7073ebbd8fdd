#pragma once
#include <mutex>
#include <string>

namespace suture {

/// State of a run (phase, step within it, how much is done) for another thread that reports it to the user. The program makes an object and
/// watches a thread; the library reports to the object that watches the current thread. Without a watch, this costs one pointer test.
class Progress {
 public:
  /// Plain.
  struct State {
    std::string phase, step;  ///< "factor", "factoring the subdomains"; empty: none
    double since = 0.0;       ///< start of the phase, by Timers::now() [s]
    std::string unit;         ///< the objects counted: "subdomains"
    long done = 0;            ///< objects or iterations done
    long total = 0;           ///< objects in total; zero: unknown
    double residual = -1.0;   ///< residual of the last iteration, relative to the start; negative: no solver runs
    double tolerance = 0.0;   ///< residual at which the iterations stop
    double path = -1.0;       ///< part of the load path that is done, from 0 to 1; negative: no load steps
    double pathSince = 0.0;   ///< start of the load path, by Timers::now() [s]
  };
  State state() const;

  /// While it exists, `progress` receives what the thread that made this object does.
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
  /// A step of the phase, while the object exists.
  struct Step {
    explicit Step(const std::string& name);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;
  };
  /// A path of load steps, while the object exists. It continues through phases.
  struct Path {
    Path();
    ~Path();
    Path(const Path&) = delete;
    Path& operator=(const Path&) = delete;
    /// \param part  of the path that is done, from 0 to 1
    void reach(double part) const;
  };
  /// Counts one more of `total` objects.
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
