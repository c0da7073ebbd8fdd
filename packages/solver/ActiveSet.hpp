#pragma once
#include <suture/solver/OuterSolver.hpp>

#include <vector>

namespace suture {

/// Primal-dual active set on the interface, that is semismooth Newton for Contact On The Interface: solve the linear problem of a set of
/// closed pairs, close what penetrates, open what pulls, until the set stays. Started from the bilateral solution.
///
/// Linear solves end at the inner tolerance until the set stays, then at that of the outer solver; both relative to the residual of the
/// lifted start, so that no step repeats what the last one reached. A set that returns tightens the inner tolerance by a hundred; one that
/// returns at the final tolerance is a proven cycle: the solver gives up and names the pairs that alternate.
class ActiveSet : public OuterSolver {
 public:
  static Schema schema();
  explicit ActiveSet(const Parameters& own);

 protected:
  void doSolve(Run& run) const override;
  double auxiliaryTolerance(const OuterSettings& settings) const override;

 private:
  double innerTolerance_;
};

/// Sets that were met, to notice a return. Collective.
class VisitedSets {
 public:
  explicit VisitedSets(const InterfaceProblem& problem) : problem_(problem) {}
  /// Remembers a set; true if it was there already.
  bool returnsTo(const ContactStatus& set);
  /// Pairs that changed since the set last given was met before.
  std::vector<int> alternating() const;
  void clear() { sets_.clear(); }

 private:
  const InterfaceProblem& problem_;
  std::vector<ContactStatus> sets_;
  std::size_t first_ = 0;
};

}  // namespace suture
