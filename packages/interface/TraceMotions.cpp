#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/interface/TraceMotions.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {

TraceMotions::TraceMotions(const InterfaceSpace& space, const ContactBodies& bodies,
                           const std::vector<std::unique_ptr<Subdomain>>& subdomains, const std::vector<int>& partOfOwned)
    : bodies_(bodies), comm_(space.comm()), partOfOwned_(partOfOwned) {
  const int all = bodies.rigid().motions();
  if (all == 0 || bodies.areBound()) return;
  Eigen::Index most = 0;
  for (const RigidPart& part : bodies.parts()) most = std::max(most, part.free.cols());
  ofOwned_ = Matrix::Zero(static_cast<Eigen::Index>(partOfOwned.size()), most);
  Matrix mine = Matrix::Zero(all, most);
  for (std::size_t s = 0; s < subdomains.size(); ++s) {
    const Subdomain& subdomain = *subdomains[s];
    const int number = bodies.partOf(static_cast<int>(s)), first = bodies.firstMotion(number);
    const RigidPart& part = bodies.parts()[number];
    if (part.free.cols() == 0) continue;
    for (int dof = 0; dof < subdomain.dofs(); ++dof) {
      const auto at = space.map()->getLocalElement(subdomain.globalDof(dof));
      if (at < 0 || !ofOwned_.row(at).isZero(0.0)) continue;
      const Point along = subdomain.direction(dof);
      const Matrix moved = part.at(subdomain.mesh().point(subdomain.nodeOf(dof)), subdomain.components());
      const Vector own = part.free.transpose() * (moved.transpose() * Eigen::Map<const Vector>(along.data(), moved.rows()));
      ofOwned_.row(at).head(own.size()) = own.transpose();
      mine.block(first, 0, own.size(), own.size()) += own * own.transpose();
    }
  }
  squared_ = mine;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), squared_.data());
}

Vector TraceMotions::takeOut(MultiVector& trace) const {
  if (squared_.size() == 0) return {};
  auto owned = localView(trace);
  Vector mine = Vector::Zero(squared_.rows()), sums = mine;
  const auto columns = [&](std::size_t at) {
    const int part = partOfOwned_[at];
    return std::make_pair(bodies_.firstMotion(part), bodies_.parts()[part].free.cols());
  };
  for (std::size_t k = 0; k < partOfOwned_.size(); ++k) {
    const auto [first, count] = columns(k);
    const auto at = static_cast<Eigen::Index>(k);
    mine.segment(first, count) += owned(at, 0) * ofOwned_.row(at).head(count).transpose();
  }
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), sums.data());
  Vector motion = Vector::Zero(sums.size());
  for (std::size_t part = 0; part < bodies_.parts().size(); ++part) {
    const Eigen::Index first = bodies_.firstMotion(static_cast<int>(part)), count = bodies_.parts()[part].free.cols();
    if (count > 0) motion.segment(first, count) = leastSquares(squared_.block(first, 0, count, count), sums.segment(first, count));
  }
  for (std::size_t k = 0; k < partOfOwned_.size(); ++k) {
    const auto [first, count] = columns(k);
    const auto at = static_cast<Eigen::Index>(k);
    owned(at, 0) -= ofOwned_.row(at).head(count).dot(motion.segment(first, count));
  }
  return motion;
}

}  // namespace suture
