#pragma once
#include <suture/interface/ContactBodies.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Energy that elastic supports store in rigid motions of bodies. It says nothing about the deformation of a body, by which residuals are
/// measured: a body that a soft spring stops after a long way has a thousand times the energy of its deformation.
class SupportEnergy {
 public:
  /// \param bodies       must outlive it
  /// \param subdomains   of this rank, in the order of `bodies`
  /// \param partOfOwned  part of each owned unknown of the space
  /// Local.
  SupportEnergy(const InterfaceSpace& space, const ContactBodies& bodies, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                const std::vector<int>& partOfOwned);

  /// Twice the energy of the supports, per part, for the forces S U on the owned unknowns: that of the rigid motion m of the supports whose
  /// rest U - m has forces without work in any such motion. Collective.
  Vector of(const Vector& forces) const;

 private:
  const ContactBodies& bodies_;
  CommPtr comm_;
  std::vector<int> partOfOwned_;
  Matrix ofOwned_;  // owned unknowns x supported motions of their part
};

}  // namespace suture
