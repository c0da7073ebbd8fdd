#include <suture/reference/FrictionConditions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

Vector FrictionConditions::ontoAllowed(Vector force, const Vector& bounds) const {
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const int first = pairs_[p].first;
    if (!able_[p] || (pairs_[p].law->separates() && force[first] < 0.0)) force[first] = 0.0;
    if (pairs_[p].rows == 1) continue;
    auto tangential = force.segment(first + 1, pairs_[p].rows - 1);
    const double size = tangential.norm(), bound = bounds[Eigen::Index(p)];
    if (size > bound) tangential *= bound / size;
  }
  return force;
}

FrictionConditions::Evaluation FrictionConditions::solveByBlocks(Unknowns& at, const Vector& bounds, int sweeps) const {
  constexpr double drag = 0.1;
  const Vector eases = amplitude_.cwiseAbs2() / drag;  // motion per unit of unbalanced force
  const Matrix all = compliance_ + motions_ * eases.asDiagonal() * motions_.transpose();
  at.force = ontoAllowed(at.force, bounds);
  Evaluation best = evaluate(at, bounds);
  double last = std::numeric_limits<double>::infinity();
  for (int proximal = 0; proximal < 500 && best.error > 1.0; ++proximal) {
    const Vector given = open_ + motions_ * (at.place + eases.cwiseProduct(work_));
    const auto energy = [&](const Vector& f) { return 0.5 * f.dot(all * f) - given.dot(f); };
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      Vector jump = given - all * at.force;
      double change = 0.0;
      for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const int first = pairs_[p].first;
        for (const bool normal : {true, false}) {
          const int begin = normal ? first : first + 1, size = normal ? 1 : pairs_[p].rows - 1;
          if (size == 0 || (normal && !able_[p])) continue;
          // A step with the largest curvature of the block decreases the energy.
          double curvature = all(begin, begin);
          if (size == 2) {
            const double mean = 0.5 * (all(begin, begin) + all(begin + 1, begin + 1));
            curvature = mean + std::hypot(0.5 * (all(begin, begin) - all(begin + 1, begin + 1)), all(begin, begin + 1));
          }
          Vector force = at.force.segment(begin, size) + jump.segment(begin, size) / curvature;
          if (normal && pairs_[p].law->separates()) force[0] = std::max(0.0, force[0]);
          if (!normal && force.norm() > bounds[Eigen::Index(p)]) force *= bounds[Eigen::Index(p)] / force.norm();
          const Vector step = force - at.force.segment(begin, size);
          if (step.isZero(0.0)) continue;
          change = std::max(change, step.cwiseAbs().maxCoeff());
          at.force.segment(begin, size) = force;
          jump -= all.middleCols(begin, size) * step;
        }
      }
      const Unknowns moved{at.force, at.place + eases.cwiseProduct(work_ - motions_.transpose() * at.force)};
      Unknowns next;
      if (solveOnce(evaluate(moved, bounds).branches, at, 0.0, drag, next) ||
          solveOnce(evaluate(moved, bounds).branches, at, kHold, drag, next)) {
        next.force = ontoAllowed(next.force, bounds);
        if (energy(next.force) < energy(at.force)) {
          change = std::max(change, (next.force - at.force).cwiseAbs().maxCoeff());
          at.force = next.force;
        }
      }
      if (change <= 1e-13 * at.force.cwiseAbs().maxCoeff()) break;
    }
    at.place += eases.cwiseProduct(work_ - motions_.transpose() * at.force);
    best = evaluate(at, bounds);
    if (motions() == 0) break;
    // A persistent unbalanced force means that no equilibrium exists within the bounds.
    const double unbalanced = best.defect.norm();
    if (proximal > 20 && std::abs(unbalanced - last) < 1e-9 * unbalanced && best.error > 1e3) break;
    last = unbalanced;
  }
  return best;
}

}  // namespace suture
