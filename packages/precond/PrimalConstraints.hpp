#pragma once
#include <suture/base/Registry.hpp>
#include <suture/precond/Weighting.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Constraints that the local problems of BDDC share; identical on all ranks that know the unknown or the entity.
struct PrimalChoice {
  std::vector<char> alone;   ///< for each unknown of overlap(), by place: true if primal alone
  std::vector<Matrix> rows;  ///< for each entity of the space: constraints x its unknowns that are not alone, in their order; orthonormal
                             ///< rows, at most as many as unknowns. All sharers have the same value of a row. The rows of an entity take
                             ///< the global ids of its first unknowns.
};

/// Strategy that chooses the primal unknowns of BDDC: unknowns that are primal alone (vertices), and averages, moments or modes of the rest
/// of each entity. Strategies: Automatic, None, Averages, Rigid Modes, Adaptive; Registry<PrimalConstraints> adds user strategies.
class PrimalConstraints {
 public:
  static const char* kind() { return "edge constraints"; }
  virtual ~PrimalConstraints() = default;

  /// The strategy's choice, with additional vertices if it leaves a mechanism (stopMechanisms). Collective.
  /// \param locals  in the order of the space's couplings; \param weighting  set up for them
  PrimalChoice choose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const;
  /// True if the number of rows is not known in advance and must be reported to the user.
  virtual bool isAdaptive() const { return false; }

 protected:
  virtual PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const = 0;

  /// Unmodified choice of another strategy, for decorators.
  static PrimalChoice plainChoice(const PrimalConstraints& other, const InterfaceSpace& space, const LocalProblems& locals,
                                  const Weighting& weighting) {
    return other.doChoose(space, locals, weighting);
  }
};

void registerBuiltIns(Registry<PrimalConstraints>& registry);

/// The unknowns of vertices, and of edge ends that are not at a vertex, by place. Local.
std::vector<char> verticesAndEnds(const InterfaceSpace& space);

/// Vertices and ends of edges only; the largest condition number of all choices.
class VertexConstraints : public PrimalConstraints {
 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;
};

/// Vertices, ends of edges, and moments of the rest of each entity: the average of each displacement component (on a contact: of the normal
/// displacement) and, if requested for the entity, the first moments, which together are all rigid motions of the entity. Also the flux
/// through the entity if the space has one (InterfaceSpace::flux).
///
/// In 3D, averages and moments on faces with averages on edges give a condition number that does not grow with the number of subdomains,
/// and grows half as fast with their size as with averages alone. Moments on edges halve it again, at six more unknowns per subdomain.
class MomentConstraints : public PrimalConstraints {
 public:
  /// Entities with first moments. OnSeams: on contact, and on edges in 2D and faces in 3D.
  enum class First { Nowhere, OnSeams, Everywhere };
  explicit MomentConstraints(First first) : first_(first) {}

 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  First first_;
};

/// The default: rigid motions of seams, averages of edges in 3D, and the stiff traces of nearly incompressible subdomains
/// (VolumetricPrimalModes).
std::unique_ptr<PrimalConstraints> automaticConstraints();

}  // namespace suture
