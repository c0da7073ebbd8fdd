#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/motion/MovingBodies.hpp>
#include <suture/pairs/ContactPair.hpp>

#include <map>
#include <utility>
#include <vector>

namespace suture {

/// Friction histories of bodies that move far, by the nodes that carry pairs: partners change from step to step. A pair remembers which
/// points of the two sides faced each other at the end of the last step; how far they are apart now is the slip of the step. Local (rank
/// 0).
class SlipHistory {
 public:
  /// Keeps the pairs of an accepted step. \param mesh  in its shape at its end
  void accept(const std::vector<ContactPair>& pairs, const std::vector<PairResult>& results, const Mesh& mesh, const MovingBodies& bodies);
  /// Sets the past of a pair. \param mesh  in its present shape, in which the pair was found \param beside  MovingBodies::beside()
  void setPast(ContactPair& pair, const Mesh& mesh, const MovingBodies& bodies) const;

 private:
  struct Entry {
    std::vector<PairEnd> ends;
    Point offset{0, 0, 0};  ///< tangential distance between the two points at the end of the step, turned back into the drawn side B
    ContactPair::Past past;
  };
  std::map<std::pair<int, int>, Entry> of_;  // by contact and carrying node
};

}  // namespace suture
