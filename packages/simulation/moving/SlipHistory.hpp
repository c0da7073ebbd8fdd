#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/motion/MovingBodies.hpp>
#include <suture/pairs/ContactPair.hpp>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace suture {

/// Friction histories of bodies that move far. Partners change from step to step, so that histories belong to the nodes that carry pairs.
/// The slip of a step is the tangential motion, since the end of the last step, of the two points that face each other now, seen from side
/// B: it depends on the shapes at both ends only, not on the iterations between. A pair that closes in the step counts the motion after
/// it closes, which it does in a uniform motion of the bodies, as if it had lasted for the whole step: a roller moves each of its points
/// sideways before it sets it down, and a body that lands slides in the direction in which it lands. Where bodies turn against each other
/// about the normal, it has the direction of sliding at the end of the step (endOfArc()), in which friction acts there. Local (rank 0).
class SlipHistory {
 public:
  /// Begins a step. \param bodies  at its beginning \param mesh  in its shape then
  void begin(const MovingBodies& bodies, const Mesh& mesh);
  /// Keeps the results of an accepted step, for the pairs of its end.
  void accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results);
  /// Past of the pairs of the next step, by contact and carrying node; without friction empty.
  using Keys = std::set<std::pair<int, int>>;
  using Pasts = std::map<std::pair<int, int>, ContactPair::Past>;
  const Pasts& pasts() const { return of_; }
  /// Takes over pasts, and the pairs that are closed, from a file.
  void goOnFrom(Pasts pasts, Keys closed) { of_ = std::move(pasts), closed_ = std::move(closed); }
  /// Sets the past of a pair. \param gap  between the present shapes \param mesh  in its present shape, in which the pair was found
  void setPast(ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies) const;
  /// Part of the step after which a pair closes in a uniform motion of the bodies: 0 if it was closed before, nearly 1 if it stays open.
  /// \param gap, mesh  see setPast()
  double closing(const ContactPair& pair, double gap, const Mesh& mesh, const MovingBodies& bodies) const;

 private:
  class Way;
  bool wasClosed(const ContactPair& pair) const { return closed_.count({pair.line, pair.node()}) > 0; }

  MovingBodies before_;
  Mesh shape_;  // at the beginning of the step
  Pasts of_;
  Keys closed_;  // pairs at the beginning of the step
};

}  // namespace suture
