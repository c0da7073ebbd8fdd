#pragma once
#include <suture/pairs/ContactRow.hpp>

#include <vector>

namespace suture {

/// Prescribed displacements of a scene with load steps, as sums over the factors of LoadSteps: the displacements, and their contributions
/// to the gaps of contact rows. Lists by factor; empty if no factor multiplies a displacement.
struct PrescribedParts {
  struct Closing {
    int pair, equation;  ///< id, and index in the equations of its row
    double value;        ///< [length]
  };
  std::vector<std::vector<RuleValue>> rules;
  std::vector<std::vector<Closing>> gaps;

  bool empty() const { return rules.empty(); }

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.rules), each(self.gaps);
  }
};

/// Finds the prescribed parts of the whole mesh. Local (rank 0).
PrescribedParts prescribedParts(const Mesh& mesh, const Constraints& constraints);

}  // namespace suture
