#pragma once
#include <suture/constraints/ContactRow.hpp>

#include <vector>

namespace suture {

/// Prescribed displacements of a scene with load steps, as sums over the factors of LoadSteps: the displacements themselves, and the parts
/// that they close in the gaps of contact rows. Lists by factor; none where no factor multiplies a displacement.
struct PrescribedParts {
  struct Closing {
    int pair, equation;  ///< id, and place among the equations of its row
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

/// Finds those of the whole mesh. Local (rank 0).
PrescribedParts prescribedParts(const Mesh& mesh, const Constraints& constraints);

}  // namespace suture
