#include <suture/algebra/DisjointSets.hpp>
#include <suture/solver/BodyImbalance.hpp>
#include <suture/solver/ClusterScales.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr double kBodies = 4.0;      // accepted residual of a body relative to its own energy, in units of the global tolerance
constexpr double kRounding = 1e-14;  // round-off in the answer of a solve, relative to the energy norm at its start
}  // namespace

ClusterScales::ClusterScales(OuterSolver::Run& run, const ContactProblem& contact) : run_(run), contact_(contact) {
  largest_ = found_ = contact_.bodies().carriedEnergy();
}

void ClusterScales::find(const PairStates& states) {
  const RigidBodyModel& rigid = contact_.bodies().rigid();
  const auto parts = static_cast<int>(contact_.bodies().parts().size());
  DisjointSets clusters(parts);
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].closed() || states[i].transverseStiffness > 0.0)
      for (const int part : rigid.data().bodies[i]) clusters.join(part, rigid.data().bodies[i].front());
  lift_ = Vector::Zero(parts);
  clusterOf_.clear();
  for (int p = 0; p < parts; ++p) clusterOf_.push_back(clusters.lowest(p));
}

bool ClusterScales::oneCluster() const {
  return std::all_of(clusterOf_.begin(), clusterOf_.end(), [&](int cluster) { return cluster == clusterOf_.front(); });
}

/// U.S U of each cluster, stored at its first part.
Vector ClusterScales::energies(const InterfaceState& state) const {
  const Vector ofParts = contact_.energies(state);
  Vector sums = Vector::Zero(ofParts.size());
  for (std::size_t p = 0; p < clusterOf_.size(); ++p) sums(clusterOf_[p]) += std::max(ofParts(static_cast<Eigen::Index>(p)), 0.0);
  return sums;
}

double ClusterScales::negligible() const { return std::max(run_.tolerance(), kNegligibleEnergyNorm / run_.tolerance()); }

void ClusterScales::scaleBy(const InterfaceState* from, const InterfaceState& start, const MultiVector& load) {
  const Vector energy = from ? energies(*from) : Vector(Vector::Zero(static_cast<Eigen::Index>(clusterOf_.size())));
  lift_ = energies(start).cwiseSqrt();
  largest_ = largest_.cwiseMax(contact_.energies(start));
  scale_.clear();
  size_.resize(0);
  scaled_ = false;
  largestScale_ = 1.0;
  // With friction the last solution may be only round-off, for example if all pairs stick and prescribed displacements cause all the
  // motion. The energy norm of the solution is at least that of the correction minus that of the start.
  const bool isRough = contact_.laws().restrictSliding();
  // Where loads are in equilibrium with initial stresses, or return to zero, the whole solution is round-off of what the bodies carry, and
  // no residual is small compared with it: the scale is at least an energy that is negligible beside theirs (as in overestimate()).
  const double least = isRough ? negligible() : 0.0;
  // One cluster needs no scaling.
  if (oneCluster()) {
    reference_ = std::sqrt(energy.sum());
    if (isRough)
      reference_ = std::max({reference_, preconditionedNorm(*run_.preconditioner, load) - lift_.norm(), least * std::sqrt(found_.sum())});
    return;
  }
  const Vector ofParts = productsByPart(contact_, *run_.preconditioner, load);
  Vector fresh = Vector::Zero(energy.size());
  Vector carried = Vector::Zero(energy.size());
  for (std::size_t p = 0; p < clusterOf_.size(); ++p) {
    fresh(clusterOf_[p]) += ofParts(static_cast<Eigen::Index>(p));
    carried(clusterOf_[p]) += found_(static_cast<Eigen::Index>(p));
  }
  size_.resize(energy.size());
  for (Eigen::Index c = 0; c < size_.size(); ++c) {
    const double first = std::sqrt(std::max(fresh(c), 0.0)), last = std::sqrt(std::max(energy(c), 0.0));
    size_(c) = isRough ? std::max({last, first - lift_(c), least * std::sqrt(carried(c))}) : last > 0.0 ? last : first;
  }
  size_ = size_.cwiseMax(lentNorms(size_));
  largestScale_ = size_.maxCoeff() > 0.0 ? size_.maxCoeff() : 1.0;
  for (const int part : contact_.partOfOwned()) {
    const double own = size_(clusterOf_[part]);
    scale_.push_back(own > 0.0 ? own : largestScale_);
  }
  scaled_ = true;
  reference_ = 1.0;
}

/// Energy norms assigned to idle clusters, a fraction of their neighbours' norms; stored at the first parts of the clusters.
Vector ClusterScales::lentNorms(const Vector& norms) const {
  const ContactBodies& bodies = contact_.bodies();
  std::vector<double> own;
  for (const int cluster : clusterOf_) own.push_back(norms(cluster));
  std::vector<char> idle = bodies.idle();
  for (std::size_t p = 0; p < own.size(); ++p)  // a cluster with a body that is not idle has its own scale
    if (!bodies.idle()[p])
      for (std::size_t q = 0; q < own.size(); ++q) idle[q] = idle[q] && clusterOf_[q] != clusterOf_[p];
  const std::vector<double> lent = lentValues(own, idle, kLentForce, bodies.neighbours());
  Vector all = Vector::Zero(norms.size());
  for (std::size_t p = 0; p < own.size(); ++p) all(clusterOf_[p]) = std::max(all(clusterOf_[p]), lent[p]);
  return all;
}

double ClusterScales::overestimate(const InterfaceState& state, double tolerance) const {
  Vector own = energies(state).cwiseSqrt().cwiseMax(kRounding * lift_);
  own = own.cwiseMax(lentNorms(own));
  // The solution of a set may have no energy (a body in rigid motion): earlier energies are the scale then.
  Vector before = Vector::Zero(own.size());
  for (std::size_t p = 0; p < clusterOf_.size(); ++p) before(clusterOf_[p]) += found_(static_cast<Eigen::Index>(p));
  own = own.cwiseMax(std::max(tolerance, kNegligibleEnergyNorm / tolerance) * before.cwiseSqrt());
  if (!scaled_) return own.norm() > 0.0 ? reference_ / own.norm() : 1.0;
  double most = 1.0;
  for (Eigen::Index c = 0; c < size_.size(); ++c)
    if (own(c) > 0.0) most = std::max(most, size_(c) / own(c));
  return most;
}

void ClusterScales::scale(MultiVector& x, bool inverse) const {
  if (!scaled_) return;
  auto values = localView(x);
  for (std::size_t k = 0; k < scale_.size(); ++k) values(static_cast<Eigen::Index>(k), 0) *= inverse ? 1.0 / scale_[k] : scale_[k];
}

void ClusterScales::recordSolution(const InterfaceState& state, double tolerance) {
  const Vector now = contact_.energies(state);
  const double own = std::sqrt(now.sum()), before = std::sqrt(found_.sum()),
               negligible = std::max(tolerance, kNegligibleEnergyNorm / run_.tolerance()) * before;
  unloaded_ = own < negligible ? tolerance * negligible / before : 0.0;
  found_ = found_.cwiseMax(now);
  if (!isSized_ || tolerance <= run_.tolerance()) run_.automatic.startsFrom(own);
  isSized_ = true;
}

ClusterScales::Norm ClusterScales::norm(const MultiVector& residual, const InterfaceState& state) {
  const Vector energy = contact_.energies(state), own = productsByPart(contact_, *run_.preconditioner, residual);
  largest_ = largest_.cwiseMax(energy);
  const Vector nothing = kNegligibleEnergyNorm * kNegligibleEnergyNorm * largest_;
  Vector least = Vector::Zero(energy.size());
  const Vector lent = lentNorms(energies(state).cwiseSqrt());
  double sum = 0.0;
  for (std::size_t p = 0; p < clusterOf_.size(); ++p) {
    const auto at = static_cast<Eigen::Index>(p), cluster = static_cast<Eigen::Index>(clusterOf_[p]);
    const double size = scaled_ ? size_(cluster) : reference_, lift = kRounding * lift_(cluster);
    least(at) = std::max({kPassive * size * size, lift * lift, lent(cluster) * lent(cluster)});
    if (contact_.laws().restrictSliding()) least(at) = std::max(least(at), negligible() * negligible() * found_(at));
    if (own(at) == 0.0 || (energy(at) <= nothing(at) && own(at) <= nothing(at))) continue;
    sum += own(at) / (size > 0.0 ? size * size : std::abs(own(at)));
  }
  return {std::sqrt(std::max(sum, 0.0)), bodyResidual(own, energy, largest_, least) / kBodies};
}

}  // namespace suture
