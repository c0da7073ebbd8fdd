#include <suture/interface/SupportEnergy.hpp>
#include <suture/motion/BodyParts.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>

namespace suture {

SupportEnergy::SupportEnergy(const InterfaceSpace& space, const ContactBodies& bodies,
                             const std::vector<std::unique_ptr<Subdomain>>& subdomains, const std::vector<int>& partOfOwned)
    : bodies_(bodies), comm_(space.comm()), partOfOwned_(partOfOwned) {
  if (bodies.supported().empty()) return;
  Eigen::Index most = 0;
  for (const SupportedMotions& part : bodies.supported()) most = std::max(most, part.motions.cols());
  ofOwned_ = Matrix::Zero(static_cast<Eigen::Index>(partOfOwned.size()), most);
  for (std::size_t s = 0; s < subdomains.size(); ++s) {
    const Subdomain& subdomain = *subdomains[s];
    const auto number = static_cast<std::size_t>(bodies.partOf(static_cast<int>(s)));
    const Matrix& motions = bodies.supported()[number].motions;
    if (motions.cols() == 0) continue;
    for (int dof = 0; dof < subdomain.dofs(); ++dof) {
      const auto at = space.map()->getLocalElement(subdomain.globalDof(dof));
      if (at < 0) continue;
      ofOwned_.row(at).head(motions.cols()) =
          along(bodies.parts()[number], subdomain.mesh().point(subdomain.nodeOf(dof)), subdomain.direction(dof), bodies.dimension())
              .transpose() *
          motions;
    }
  }
}

Vector SupportEnergy::of(const Vector& forces) const {
  const std::vector<SupportedMotions>& supported = bodies_.supported();
  Vector energy = Vector::Zero(static_cast<Eigen::Index>(bodies_.parts().size()));
  if (supported.empty()) return energy;
  Matrix mine = Matrix::Zero(ofOwned_.cols(), energy.size()), work = mine;
  for (std::size_t k = 0; k < partOfOwned_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    mine.col(partOfOwned_[k]) += forces(at) * ofOwned_.row(at).transpose();
  }
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), work.data());
  for (std::size_t p = 0; p < supported.size(); ++p)
    for (Eigen::Index k = 0; k < supported[p].stiffness.size(); ++k)
      if (const double stiffness = supported[p].stiffness(k), own = work(k, static_cast<Eigen::Index>(p)); stiffness > 0.0)
        energy(static_cast<Eigen::Index>(p)) += own * own / stiffness;
  return energy;
}

}  // namespace suture
