#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Errors.hpp>
#include <suture/search/PadModel.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr int kSteps = 40;              // Newton steps before pads are softened
constexpr int kManySteps = 300;         // Newton steps with the final stiffness after that, and on springs: 76 for 400 blocks
constexpr double kTolerance = 1e-10;    // imbalance relative to the sum of forces at convergence
constexpr double kRoughly = 1e-4;       // the same on softened pads
constexpr double kAcceptable = 1e-6;    // imbalance that is accepted as equilibrium if it cannot be reduced further
constexpr double kPadRounding = 8e-16;  // relative round-off of a pad's penetration
constexpr double kSpring = 1e-8;        // spring on motions that no pad stops yet, relative to their reference stiffness
constexpr double kStiffer = 0.1;        // ratio of successive softnesses
constexpr double kPadFlat = 1e-9;       // slope along a line that counts as zero, relative to the first
constexpr double kFlatter = 1e-3;       // slope at which a line search ends
constexpr int kCoulombRounds = 20;      // maximum number of convex problems of the fixed point
constexpr int kDamped = 6;              // rounds after which fixed-point steps are halved
constexpr double kSameSlip = 1e-4;      // relative change of slips at which the fixed point has converged
constexpr double kRigid = 1e-9;         // compliance of pads in limit analysis: bodies move almost by springs only
constexpr double kBalanced = 1e-9;      // imbalance of limit analysis relative to the loads
constexpr double kWeakSpring = 1e-9;    // springs in addition to given rays
constexpr int kBrackets = 60;           // maximum number of steps of a line search

}  // namespace

PadModel::PadModel(const RigidBodyModel::Pairs& data, std::vector<FrictionCone> cones)
    : data_(data), cones_(std::move(cones)), rows_(data.line.size()), motions_(static_cast<int>(data.work.size())) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!data.canChange[i]) continue;
    std::map<int, Eigen::Vector3d> effects;
    for (std::size_t component = 0; component <= data.tangents.size(); ++component)
      for (SparseRows::InnerIterator entry(component == 0 ? data.rows : data.tangents[component - 1], static_cast<Eigen::Index>(i)); entry;
           ++entry)
        effects.try_emplace(static_cast<int>(entry.col()), Eigen::Vector3d::Zero()).first->second(static_cast<Eigen::Index>(component)) =
            entry.value();
    for (const auto& [motion, effect] : effects) {
      rows_[i].motions.push_back(motion);
      rows_[i].effects.push_back(effect);
    }
  }
}

Matrix PadModel::effect(const Vector& motion) const {
  Matrix all = Matrix::Zero(static_cast<Eigen::Index>(rows_.size()), 3);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t k = 0; k < rows_[i].motions.size(); ++k)
      all.row(static_cast<Eigen::Index>(i)) += motion(rows_[i].motions[k]) * rows_[i].effects[k].transpose();
  return all;
}

Vector PadModel::work(const Matrix& force) const {
  Vector all = Vector::Zero(motions_);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t k = 0; k < rows_[i].motions.size(); ++k)
      all(rows_[i].motions[k]) += force.row(static_cast<Eigen::Index>(i)).dot(rows_[i].effects[k]);
  return all;
}

/// Stiffness of each motion with all pads closed and sticking; scale of motions and imbalances.
Vector PadModel::reference(const Vector& stiffness) const {
  Vector all = Vector::Zero(motions_);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    for (std::size_t k = 0; k < rows_[i].motions.size(); ++k)
      all(rows_[i].motions[k]) += stiffness(static_cast<Eigen::Index>(i)) * rows_[i].effects[k].squaredNorm();
  const double most = motions_ > 0 ? std::max(all.maxCoeff(), 1e-300) : 1.0;
  for (double& own : all)
    if (!(own > 0.0)) own = most;
  return all;
}

Matrix PadModel::forces(const Matrix& y, const Vector& stiffness, std::vector<Eigen::Matrix3d>* derivatives) const {
  Matrix force = Matrix::Zero(y.rows(), 3);
  if (derivatives) derivatives->assign(rows_.size(), Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].motions.empty() && !data_.canChange[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    force.row(at) = cones_[i].project(stiffness(at) * y.row(at).transpose(), derivatives ? &(*derivatives)[i] : nullptr).transpose();
  }
  return force;
}

/// Solution of (G^T blocks G + diagonal) x = right, scaled by `scale`.
Vector PadModel::solve(const std::vector<Eigen::Matrix3d>& blocks, const Vector& stiffness, const Vector& diagonal, const Vector& scale,
                       const Vector& right) const {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int k = 0; k < motions_; ++k) entries.emplace_back(k, k, diagonal(k) / (scale(k) * scale(k)));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (blocks[i].isZero(0.0)) continue;
    const Row& row = rows_[i];
    const Eigen::Matrix3d block = stiffness(static_cast<Eigen::Index>(i)) * blocks[i];
    for (std::size_t k = 0; k < row.motions.size(); ++k) {
      const Eigen::Vector3d product = block * row.effects[k];
      for (std::size_t j = 0; j < row.motions.size(); ++j)
        if (row.motions[j] >= row.motions[k])
          entries.emplace_back(row.motions[j], row.motions[k],
                               row.effects[j].dot(product) / (scale(row.motions[j]) * scale(row.motions[k])));
    }
  }
  SparseMatrix matrix(motions_, motions_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Matrix x = right.cwiseQuotient(scale);
  CholmodFactor(matrix).solve(LocalView(x));
  return x.col(0).cwiseQuotient(scale);
}

/// Newton's method with an exact line search. \param spring  on the motions, relaxed at zero [force / length]; empty: none
bool PadModel::newton(Point& at, const Vector& stiffness, const Vector& spring, int steps, double tolerance) const {
  const Vector reference = this->reference(stiffness), scale = reference.cwiseSqrt();
  const Vector& loads = data_.work;
  const double size = loads.cwiseQuotient(scale).norm();
  const Matrix start = at.y;
  const auto pull = [&](const Vector& motion) {
    return spring.size() > 0 ? Vector(spring.cwiseProduct(motion)) : Vector(Vector::Zero(motions_));
  };
  double imbalance = 0.0, rounding = 0.0;
  std::vector<Eigen::Matrix3d> derivatives;
  for (int step = 0;; ++step) {
    const Matrix force = forces(at.y, stiffness, &derivatives);
    const Vector rest = work(force) - loads + pull(at.motion);
    Vector sum = Vector::Zero(motions_), digits = sum;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto pair = static_cast<Eigen::Index>(i);
      if (force.row(pair).isZero(0.0)) continue;
      const double moved = stiffness(pair) * (start.row(pair).cwiseAbs() + (at.y - start).row(pair).cwiseAbs()).maxCoeff();
      for (std::size_t k = 0; k < rows_[i].motions.size(); ++k) {
        sum(rows_[i].motions[k]) += force.row(pair).cwiseAbs().dot(rows_[i].effects[k].cwiseAbs());
        digits(rows_[i].motions[k]) += moved * rows_[i].effects[k].cwiseAbs().sum();
      }
    }
    imbalance = rest.cwiseQuotient(scale).norm();
    rounding = kPadRounding * digits.cwiseQuotient(scale).norm();
    if (imbalance <= tolerance * (size + sum.cwiseQuotient(scale).norm()) + rounding) return true;
    if (step == steps) break;

    const Vector diagonal = spring.size() > 0 ? Vector(spring + 1e-14 * reference) : Vector(kSpring * reference);
    const Vector direction = -solve(derivatives, stiffness, diagonal, scale, rest);
    const Matrix along = effect(direction);
    const double constant = loads.dot(direction);
    const auto slope = [&](double length) {
      const Matrix own = forces(at.y + length * along, stiffness, nullptr);
      return own.cwiseProduct(along).sum() - constant + pull(at.motion + length * direction).dot(direction);
    };
    const double first = slope(0.0), flat = kPadFlat * std::abs(first);
    double low = 0.0, atLow = first, high = 1.0, atHigh = slope(high), length = high;
    for (int n = 0; atHigh < -flat; ++n) {
      if (n == kBrackets) return false;  // nothing stops this motion
      low = high, atLow = atHigh;
      high *= 4.0;
      atHigh = slope(high);
      length = high;
    }
    if (std::abs(atHigh) > flat) {
      // Regula falsi on the monotone slope, with the value at the kept end halved (Illinois), and bisection where that is slow.
      int side = 0;
      for (int n = 0; n < kBrackets; ++n) {
        length = atHigh != atLow && !(n > kBrackets / 3 && n % 3 == 0) ? low - atLow * (high - low) / (atHigh - atLow) : 0.5 * (low + high);
        if (!(low < length && length < high)) length = 0.5 * (low + high);
        const double own = slope(length);
        if (std::abs(own) <= kFlatter * std::abs(first) || high - low < 1e-13 * high) break;
        if (own < 0.0) {
          low = length, atLow = own;
          if (side < 0) atHigh *= 0.5;
          side = -1;
        } else {
          high = length, atHigh = own;
          if (side > 0) atLow *= 0.5;
          side = 1;
        }
      }
    }
    at.motion += length * direction;
    at.y += length * along;
  }
  return imbalance <= kAcceptable * size + 10.0 * rounding;
}

PadModel::Equilibrium PadModel::associated(const Matrix& t, const Vector& compliance) const {
  Vector stiffness = compliance.cwiseInverse();
  Point at{Vector::Zero(motions_), t};
  Equilibrium result;
  result.found = motions_ == 0 || newton(at, stiffness, {}, kSteps, kTolerance);
  if (!result.found && t.rows() > 0) {
    // Soften the pads until all touch; then stiffen them in steps by a factor of ten.
    std::vector<double> sorted(stiffness.data(), stiffness.data() + stiffness.size());
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
    const double load = std::max(data_.work.norm() / std::sqrt(static_cast<double>(motions_)), 1e-300);
    double softer = sorted[sorted.size() / 2] * std::max(t.cwiseAbs().maxCoeff(), 1e-300) / load;
    softer = std::isfinite(softer) && softer >= 10.0 ? std::min(softer, 1e16) : 1e3;
    at = {Vector::Zero(motions_), t};
    for (bool last = false; !last; softer *= kStiffer) {
      last = softer <= 1.0;
      const Vector soft = stiffness / std::max(softer, 1.0);
      result.found = newton(at, soft, {}, last ? kManySteps : kSteps, last ? kTolerance : kRoughly);
    }
  }
  result.motion = at.motion;
  result.force = forces(at.y, stiffness, nullptr);
  result.trial = stiffness.asDiagonal() * at.y;
  return result;
}

RigidBodyModel::Pairs PadModel::frictionless(const SparseRows& rows, const Vector& work) {
  RigidBodyModel::Pairs pairs;
  pairs.rows = rows;
  pairs.work = work;
  pairs.line.assign(static_cast<std::size_t>(rows.rows()), 0);
  pairs.canChange.assign(pairs.line.size(), 1);
  return pairs;
}

PadModel::Equilibrium PadModel::unilateral(const SparseRows& rows, const Vector& work, const Vector& t, const Vector& compliance) {
  const RigidBodyModel::Pairs pairs = frictionless(rows, work);
  Matrix from = Matrix::Zero(t.size(), 3);
  from.col(0) = t;
  return PadModel(pairs, std::vector<FrictionCone>(pairs.line.size())).associated(from, compliance);
}

Vector PadModel::leastRemainder(const SparseRows& rows, const Vector& work) {
  if (work.isZero(0.0)) return Vector::Zero(rows.rows());
  const RigidBodyModel::Pairs pairs = frictionless(rows, work);
  const PadModel model(pairs, std::vector<FrictionCone>(pairs.line.size()));
  const Vector springs = Vector::Ones(work.size()), stiffness = model.rigidPads(springs);
  Point at{Vector::Zero(work.size()), Matrix::Zero(rows.rows(), 3)};
  return model.onSprings(at, stiffness, springs) ? Vector(model.forces(at.y, stiffness, nullptr).col(0)) : Vector();
}

PadModel::Equilibrium PadModel::coulomb(const Matrix& t, const Vector& compliance, const Vector& slip) const {
  Vector friction(t.rows());
  for (Eigen::Index i = 0; i < t.rows(); ++i) friction(i) = cones_[static_cast<std::size_t>(i)].friction;
  Vector opened = slip.size() > 0 ? Vector(friction.cwiseProduct(slip)) : Vector(Vector::Zero(t.rows()));
  PadModel own = *this;
  Equilibrium result;
  for (int round = 0;; ++round) {
    Matrix from = t;
    from.col(0) -= opened;
    Equilibrium next = own.associated(from, compliance);
    next.trial.col(0) += opened.cwiseQuotient(compliance);
    if (!next.found && round > 0) return result;  // bounds that an open pair loses may be needed
    result = std::move(next);
    if (!result.found || round + 1 == kCoulombRounds) return result;
    bool same = true;
    Vector slips(t.rows());
    for (Eigen::Index i = 0; i < t.rows(); ++i) {
      const auto pair = static_cast<std::size_t>(i);
      slips(i) = friction(i) * compliance(i) * (result.trial.row(i) - result.force.row(i)).tail(2).norm();
      double& bound = own.cones_[pair].bound;
      const double law = cones_[pair].bound, now = result.force(i, 0) > 0.0 ? (round < kDamped ? law : bound) : 0.0;
      if (!std::isfinite(law) || now == bound) continue;
      bound = now;
      same = false;
    }
    const Vector change = slips - opened;
    if (same && change.norm() <= kSameSlip * slips.norm()) return result;
    opened += (round < kDamped ? 1.0 : 0.5) * change;
  }
}

/// Stiffness of pads that are rigid compared with the springs on the motions of both bodies, however soft one of them is.
Vector PadModel::rigidPads(const Vector& springs) const {
  Vector stiffness = Vector::Ones(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].motions.empty()) continue;
    double& own = stiffness(static_cast<Eigen::Index>(i)) = 0.0;
    for (const int motion : rows_[i].motions) own = std::max(own, springs(motion) / kRigid);
  }
  return stiffness;
}

/// Equilibrium on springs and pads, from stiff springs to the given ones. False: not found.
bool PadModel::onSprings(Point& at, const Vector& stiffness, const Vector& springs) const {
  bool found = false;
  for (const double stiffer : {1e9, 1e6, 1e3, 1.0}) found = newton(at, stiffness, stiffer * springs, kManySteps, kBalanced);
  return found;
}

Vector PadModel::unbalanced() const {
  if (motions_ == 0 || data_.work.isZero(0.0)) return {};
  // Springs follow the stiffness of each body.
  const Vector reference = this->reference(data_.stiffness), scale = reference.cwiseSqrt();
  Point at{Vector::Zero(motions_), Matrix::Zero(static_cast<Eigen::Index>(rows_.size()), 3)};
  if (!onSprings(at, rigidPads(reference), reference)) return {};
  const double rest = at.motion.cwiseProduct(scale).norm(), loads = data_.work.cwiseQuotient(scale).norm();
  return rest > kUnbalanced * loads && data_.work.dot(at.motion) > 0.0 ? Vector(at.motion.normalized()) : Vector();
}

bool PadModel::balances(const std::vector<Eigen::Matrix3d>& active) const {
  if (motions_ == 0 || data_.work.isZero(0.0)) return true;
  std::vector<Eigen::Matrix3d> blocks;
  for (const Eigen::Matrix3d& own : active) blocks.push_back(own * own.transpose());
  const Vector reference = this->reference(data_.stiffness), scale = reference.cwiseSqrt();
  const Vector held = solve(blocks, data_.stiffness, kWeakSpring * reference, scale, data_.work);
  return kWeakSpring * held.cwiseProduct(scale).norm() < kUnbalanced * data_.work.cwiseQuotient(scale).norm();
}

}  // namespace suture
