#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/motion/MovingBodies.hpp>
#include <suture/pairs/ContactPair.hpp>

#include <map>
#include <utility>
#include <vector>

namespace suture {

/// Friction histories of bodies that move far. Partners change from step to step, so that histories belong to the nodes that carry pairs.
/// The slip of a step is the tangential motion, since the end of the last step, of the two points that face each other now, seen from side
/// B: it depends on the shapes at both ends only, not on the iterations between. Where bodies turn against each other about
/// the normal, it has the direction of sliding at the end of the step (endOfArc()), in which friction acts there. Local (rank 0).
class SlipHistory {
 public:
  /// Begins a step. \param bodies  at its beginning \param mesh  in its shape then
  void begin(const MovingBodies& bodies, const Mesh& mesh);
  /// Keeps the results of an accepted step, for the pairs of its end.
  void accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results);
  /// Past of the pairs of the next step, by contact and carrying node; without friction empty.
  using Pasts = std::map<std::pair<int, int>, ContactPair::Past>;
  const Pasts& pasts() const { return of_; }
  /// Takes over pasts from a file.
  void goOnFrom(Pasts pasts) { of_ = std::move(pasts); }
  /// Sets the past of a pair. \param mesh  in its present shape, in which the pair was found
  void setPast(ContactPair& pair, const Mesh& mesh, const MovingBodies& bodies) const;

 private:
  MovingBodies before_;
  Mesh shape_;  // at the beginning of the step
  Pasts of_;
};

}  // namespace suture
