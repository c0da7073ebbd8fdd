#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/motion/MovingBodies.hpp>
#include <suture/motion/RelativeMotion.hpp>
#include <suture/pairs/ContactPair.hpp>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace suture {

/// Friction histories of bodies that move far. Partners change from step to step, so that histories belong to the nodes that carry pairs.
/// The slip of a step is the tangential motion, since the end of the last step, of the two points that face each other now, seen from side
/// B (RelativeMotion): it depends on the shapes at both ends only, not on the iterations between. For a pair that closes in the step it is
/// the mean velocity after closing times the whole step: a roller moves each of its points sideways before it sets it down, and a body that
/// lands slides in the direction in which it lands. Slip and friction work of such a step are therefore those of a contact that lasts for
/// the whole step. Local (rank 0).
class SlipHistory {
 public:
  /// Begins a step. \param bodies  at its beginning \param mesh  in its shape then
  void begin(const MovingBodies& bodies, const Mesh& mesh);
  /// Keeps the results of an accepted step, for the pairs of its end.
  void accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results);
  using Keys = std::set<std::pair<int, int>>;  ///< contact and carrying node
  /// Past of the pairs of the next step, by contact and carrying node; without friction empty.
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
  RelativeMotion motionOf(const ContactPair& pair, const Mesh& mesh, const MovingBodies& bodies) const;
  bool wasClosed(const ContactPair& pair) const { return closed_.count({pair.line, pair.node()}) > 0; }

  MovingBodies before_;
  Mesh shape_;  // at the beginning of the step
  Pasts of_;
  Keys closed_;  // pairs at the beginning of the step
};

}  // namespace suture
