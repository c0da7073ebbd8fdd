#pragma once
#include <suture/interface/ContactBodies.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The rigid motions of free parts of bodies in a trace: what a formulation keeps beside its trace, so that the rounding of forces is that
/// of deformations and not of the ways that bodies go.
class TraceMotions {
 public:
  /// \param bodies       must outlive it
  /// \param subdomains   of this rank, in the order of `bodies`
  /// \param partOfOwned  part of each owned unknown of the space
  /// Collective.
  TraceMotions(const InterfaceSpace& space, const ContactBodies& bodies, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
               const std::vector<int>& partOfOwned);

  /// Subtracts from the trace each part's best rigid motion (least squares over its unknowns). Returns the amplitudes of all parts' motions
  /// [length], as those of RigidContact; empty: no part is free. Collective.
  Vector takeOut(MultiVector& trace) const;

 private:
  const ContactBodies& bodies_;
  CommPtr comm_;
  std::vector<int> partOfOwned_;
  Matrix ofOwned_;  // owned unknowns x motions of their part
  Matrix squared_;  // inner products over all ranks: motions of all parts, squared
};

}  // namespace suture
