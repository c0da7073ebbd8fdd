#pragma once
#include <suture/interface/ContactBodies.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The rigid motions of free parts contained in a trace. Formulations keep these motions apart from the trace, so that forces have the
/// round-off of deformations and not that of large displacements.
class TraceMotions {
 public:
  /// \param bodies       must outlive it
  /// \param subdomains   of this rank, in the order of `bodies`
  /// \param partOfOwned  part of each owned unknown of the space
  /// Collective.
  TraceMotions(const InterfaceSpace& space, const ContactBodies& bodies, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
               const std::vector<int>& partOfOwned);

  /// Subtracts from the trace each part's best rigid motion (least squares over its unknowns). Returns the amplitudes of all parts' motions
  /// [length], as for RigidBodyModel; empty: no part is free. Collective.
  Vector takeOut(MultiVector& trace) const;

 private:
  const ContactBodies& bodies_;
  CommPtr comm_;
  std::vector<int> partOfOwned_;
  Matrix ofOwned_;  // owned unknowns x motions of their part
  Matrix squared_;  // inner products of the motions of each part, summed over ranks: one square block per part, below each other
};

}  // namespace suture
