#pragma once
#include <suture/base/Registry.hpp>
#include <suture/precond/Weighting.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Constraints that the local problems of BDDC share, the same on all ranks that know an unknown or an entity.
struct PrimalChoice {
  std::vector<char> alone;   ///< for each unknown of overlap(), by place: true if it is primal alone
  std::vector<Matrix> rows;  ///< for each entity of the space: constraints x its unknowns that are not alone, in their order; orthonormal
                             ///< rows, no more than unknowns. A row's value is the same for all sharers. The rows of an entity get the
                             ///< global ids of its first unknowns.
};

/// Strategy that chooses the primal unknowns of BDDC: unknowns that are primal alone (vertices), and averages, moments or modes of the rest
/// of each entity. Strategies: Automatic, None, Averages, Rigid Modes, Adaptive; a user adds his own through Registry<PrimalConstraints>.
class PrimalConstraints {
 public:
  static const char* kind() { return "edge constraints"; }
  virtual ~PrimalConstraints() = default;

  /// The strategy's choice, and vertices where that leaves a mechanism (stopMechanisms). Collective.
  /// \param locals  in the order of the space's couplings; \param weighting  set up for them
  PrimalChoice choose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const;
  /// True if the number of rows is not known beforehand, so that the user is told.
  virtual bool isAdaptive() const { return false; }

 protected:
  virtual PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const = 0;

  /// Another strategy's choice as it is, for decorators.
  static PrimalChoice plainChoice(const PrimalConstraints& other, const InterfaceSpace& space, const LocalProblems& locals,
                                  const Weighting& weighting) {
    return other.doChoose(space, locals, weighting);
  }
};

void registerBuiltIns(Registry<PrimalConstraints>& registry);

/// The unknowns of vertices, and those where an edge ends at no vertex, by place. Local.
std::vector<char> verticesAndEnds(const InterfaceSpace& space);

/// Vertices and ends of edges only: of all choices the largest condition.
class VertexConstraints : public PrimalConstraints {
 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;
};

/// Vertices, ends of edges, and moments of the rest of each entity: the average of each displacement component, on a contact of the normal
/// displacement; and on entities for which they are asked for the first moments as well: all rigid motions of the entity. The flux through
/// it where the space has one (InterfaceSpace::flux).
///
/// In space averages and moments on faces with averages on edges have a condition that does not grow with the number of subdomains and
/// half as fast with their size as averages alone; moments on edges halve it again, for six unknowns more a subdomain.
class MomentConstraints : public PrimalConstraints {
 public:
  enum class First { Nowhere, OnSeams, Everywhere };  ///< entities with first moments; seams are edges in the plane, faces in space
  explicit MomentConstraints(First first) : first_(first) {}

 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  First first_;
};

/// The default: rigid motions of seams, averages of edges in space, and the other stiff traces of nearly incompressible subdomains, see
/// StiffTraces.
std::unique_ptr<PrimalConstraints> automaticConstraints();

}  // namespace suture
