#pragma once
#include <suture/base/Registry.hpp>
#include <suture/precond/StiffTraces.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Primal constraints of BDDC on an edge beside its end points: rows whose value is the same on both sides. Strategies: None, Averages,
/// Rigid Modes, Adaptive; a user adds his own through Registry<EdgeConstraints>.
class EdgeConstraints {
 public:
  static const char* kind() { return "edge constraints"; }
  virtual ~EdgeConstraints() = default;

  /// For each edge of the space: constraints x unknowns of the edge, orthonormal rows, the same on both sides of the edge. Collective.
  /// \param locals  in the order of the space's couplings; \param weighting  set up for them
  virtual std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const = 0;
  /// True if their number is not known beforehand, so that the user is told.
  virtual bool isAdaptive() const { return false; }
};

void registerBuiltIns(Registry<EdgeConstraints>& registry);

/// Corners only: of all choices the largest condition.
class NoEdgeConstraints : public EdgeConstraints {
 public:
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;
};

/// The average of each displacement component; on a contact line, of the normal displacement; the flux through the edge where the space has
/// one (InterfaceSpace::flux), and the other stiff traces of nearly incompressible subdomains (StiffTraces.hpp).
class EdgeAverages : public EdgeConstraints {
 public:
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  mutable StiffTraces stiff_;
};

/// The same and the first moment: all rigid motions of the edge; on a contact line average and first moment of the normal displacement.
class EdgeRigidModes : public EdgeConstraints {
 public:
  std::vector<Matrix> rows(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  mutable StiffTraces stiff_;
};

}  // namespace suture
