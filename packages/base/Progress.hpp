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
    long done = 0;            ///< how many of them; iterations
    long total = 0;           ///< zero: not known
    double residual = -1.0;   ///< relative, of the last iteration; negative: none runs
    double tolerance = 0.0;   ///< where it ends
  };
  State state() const;

  /// While it lives, the thread that made it tells `progress`.
  class Watch {
   public:
    explicit Watch(Progress& progress);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    Progress* before_;
  };

  /// A phase begins; empty: it ends.
  static void phase(const std::string& name);
  /// A step of the phase, while it lives.
  struct Step {
    explicit Step(const std::string& name);
    ~Step();
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;
  };
  /// One more of `total` is done.
  static void count(const char* unit, long total);
  /// An iteration is done.
  static void iteration(long number, double residual, double tolerance);

 private:
  template <typename Change>
  void change(const Change& change);

  mutable std::mutex mutex_;
  State state_;
};

}  // namespace suture
