#include <suture/solver/BodyImbalance.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

double bodyImbalance(const ContactBodies& bodies, const Matrix& force, const Vector& energy, const Vector& largest) {
  const RigidBodyModel::Pairs& data = bodies.rigid().data();
  if (bodies.areBound()) return 0.0;  // forces of bound pairs are unknown here
  const std::size_t parts = bodies.parts().size();
  std::vector<double> size(parts, 0.0), stiffness(parts, 0.0);
  std::vector<char> idle = bodies.idle();
  for (std::size_t p = 0; p < parts; ++p) {
    size[p] = data.work.segment(bodies.firstMotion(static_cast<int>(p)), bodies.parts()[p].free.cols()).norm();
    idle[p] = idle[p] || size[p] == 0.0;
  }
  for (std::size_t i = 0; i < data.bodies.size(); ++i)
    for (const int p : data.bodies[i]) {
      size[p] += force.row(static_cast<Eigen::Index>(i)).norm();
      stiffness[p] = std::max(stiffness[p], data.stiffness(static_cast<Eigen::Index>(i)));
    }
  std::vector<double> own = size;
  for (std::size_t p = 0; p < parts; ++p)
    if (!bodies.idle()[p]) own[p] = std::max(own[p], std::sqrt(std::max(energy(static_cast<Eigen::Index>(p)), 0.0) * stiffness[p]));
  const std::vector<double> lent = lentValues(own, idle, kLentForce, bodies.neighbours());
  Vector excess = data.rows.transpose() * force.col(0) - data.work;
  for (Eigen::Index k = 0; k < std::min(force.cols() - 1, static_cast<Eigen::Index>(data.tangents.size())); ++k)
    excess += data.tangents[static_cast<std::size_t>(k)].transpose() * force.col(k + 1);
  double most = 0.0;
  for (std::size_t p = 0; p < parts; ++p) {
    const auto at = static_cast<Eigen::Index>(p);
    const Eigen::Index first = bodies.firstMotion(static_cast<int>(p)), count = bodies.parts()[p].free.cols();
    if (count == 0) continue;
    const Vector rest = excess.segment(first, count);
    if (rest.norm() <= kNegligibleEnergyNorm * std::sqrt(largest(at) * stiffness[p])) continue;
    size[p] = std::max({size[p], lent[p], kLentForce * std::sqrt(std::max(energy(at), 0.0) * stiffness[p])});
    most = std::max(most, rest.norm() / size[p]);
  }
  return most;
}

double bodyResidual(const Vector& own, const Vector& energy, const Vector& largest, const Vector& least) {
  const Vector nothing = kNegligibleEnergyNorm * kNegligibleEnergyNorm * largest;
  double most = 0.0;
  for (Eigen::Index p = 0; p < own.size(); ++p) {
    if (own(p) == 0.0 || (energy(p) <= nothing(p) && own(p) <= nothing(p))) continue;
    const double scale = std::max(energy(p), least(p));
    if (scale > 0.0) most = std::max(most, std::sqrt(std::abs(own(p)) / scale));
  }
  return most;
}

Vector productsByPart(const ContactProblem& contact, const Preconditioner& preconditioner, const MultiVector& r) {
  const MultiVectorPtr z = preconditioner.space()->vector();
  preconditioner.apply(r, *z);
  const std::vector<int>& partOf = contact.partOfOwned();
  Vector mine = Vector::Zero(static_cast<Eigen::Index>(contact.bodies().parts().size())), all = mine;
  const auto a = localView(r), b = localView(static_cast<const MultiVector&>(*z));
  for (std::size_t k = 0; k < partOf.size(); ++k)
    mine(partOf[k]) += a(static_cast<Eigen::Index>(k), 0) * b(static_cast<Eigen::Index>(k), 0);
  Teuchos::reduceAll(*preconditioner.space()->comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

}  // namespace suture
