#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Decides how many sweeps over the stars are made: a sweep costs about a twentieth of the whole bound, so that more are made as long as
/// the last one made the bound noticeably smaller. On meshes of well-shaped elements that is a sweep or two beyond the least number; flat
/// elements and nearly incompressible ones need more.
class SweepGain {
 public:
  /// \param mine  squared energy over this rank before the first sweep \param least  number of sweeps made in any case. Collective.
  SweepGain(const Comm& comm, double mine, int least);
  /// The same on all ranks. Local.
  bool worthAnotherSweep() const;
  /// \param decrease  of the squared energy over all ranks
  void add(double decrease);
  int sweeps() const { return sweeps_; }

 private:
  double square_, last_ = 0.0;
  int least_, sweeps_ = 0;
};

}  // namespace suture
