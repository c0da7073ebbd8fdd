#pragma once
#include <suture/base/Registry.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <memory>
#include <vector>

namespace suture {

/// What BDDC demands of an edge beside its end points: rows of which both sides must have the same value. Strategies: None, Averages,
/// Rigid Modes; a user adds his own through Registry<EdgeConstraints>.
class EdgeConstraints {
 public:
  static const char* kind() { return "edge constraints"; }
  virtual ~EdgeConstraints() = default;

  /// For each edge of the space: constraints x unknowns of the edge, orthonormal rows, the same on both sides of the edge. Collective.
  /// \param locals  in the order of the space's couplings
  virtual std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals) const = 0;
};

void registerBuiltIns(Registry<EdgeConstraints>& registry);

/// Corners only: the condition grows like H/h.
class NoEdgeConstraints : public EdgeConstraints {
 public:
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals) const override;
};

/// The average of each displacement component; on a contact line, of the normal displacement.
class EdgeAverages : public EdgeConstraints {
 public:
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals) const override;
};

/// All rigid motions of the edge: averages and the first moment; on a contact line average and first moment of the normal displacement.
class EdgeRigidModes : public EdgeConstraints {
 public:
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals) const override;
};

}  // namespace suture
