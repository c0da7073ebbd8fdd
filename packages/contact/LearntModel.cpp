#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/contact/ContactSearch.hpp>
#include <suture/contact/DelassusProblem.hpp>
#include <suture/contact/LearntModel.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

LearntModel::LearntModel(const RigidContact& rigid, const std::vector<std::pair<Vector, Vector>>& history) : rigid_(rigid) {
  const auto& [force, penetration] = history.back();
  const Eigen::Index n = force.size(), steps = static_cast<Eigen::Index>(history.size()) - 1;
  Vector diagonal = rigid.compliance();
  compliance_ = diagonal.asDiagonal();
  // Changes of gaps contain rigid motions: these are removed from the directions by least squares on the rows.
  Matrix change(n, steps), answer(n, steps);
  Eigen::Index kept = 0;
  const Matrix& rows = rigid.data().rows;
  const Matrix basis = rows.cols() > 0 ? orthonormalBasis(rows, 1e-9) : Matrix(n, 0);
  for (Eigen::Index k = 0; k < steps; ++k) {
    const Vector s = history[static_cast<std::size_t>(k)].first - force;
    Vector y = penetration - history[static_cast<std::size_t>(k)].second;
    y -= basis * (basis.transpose() * y);
    const double curvature = s.dot(y);
    if (!(curvature > 0.0) || s.isZero(0.0)) continue;
    change.col(kept) = s / std::sqrt(curvature);
    answer.col(kept++) = y / std::sqrt(curvature);
  }
  if (kept > 0) {
    Matrix s = change.leftCols(kept), y = answer.leftCols(kept);
    const Matrix product = s.transpose() * y;
    const Eigenpairs eigen = symmetricEigenpairs(0.5 * (product + product.transpose()));
    std::vector<int> strong;
    for (Eigen::Index k = 0; k < kept; ++k)
      if (eigen.values(k) > 1e-10 * eigen.values(kept - 1)) strong.push_back(static_cast<int>(k));
    if (!strong.empty() && eigen.values(kept - 1) > 0.0) {
      const Matrix mix = eigen.vectors(Eigen::all, strong) * Vector(eigen.values(strong)).cwiseSqrt().cwiseInverse().asDiagonal();
      s = (s * mix).eval();
      y = (y * mix).eval();
      std::vector<double> ratios;  // Barzilai-Borwein scale of the diagonal
      for (Eigen::Index k = 0; k < s.cols(); ++k) ratios.push_back(1.0 / std::max(s.col(k).dot(diagonal.cwiseProduct(s.col(k))), 1e-300));
      std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
      diagonal *= std::max(1.0, ratios[ratios.size() / 2]);
      const Matrix cs = diagonal.asDiagonal() * s;
      Matrix middle = s.transpose() * cs;
      middle.diagonal().array() += 1e-14 * middle.trace();
      compliance_ = diagonal.asDiagonal();
      compliance_ -= cs * solvePositive(middle, cs.transpose());
      compliance_ += y * y.transpose();
      compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
    }
  }
  compliance_.diagonal() += 1e-10 * rigid.compliance();
  open_ = penetration + compliance_ * force;
}

ClosedSet LearntModel::closedSet() const {
  RigidContact::Pairs pairs = rigid_.data();
  pairs.stiffness = compliance_.diagonal().cwiseInverse();
  RigidContact pads(std::move(pairs));
  DelassusProblem problem(pads, compliance_, open_, {});
  const RigidContact::Equilibrium from = pads.project(open_);
  if (!from.found) return {};
  ClosedSet start(open_.size(), 0);
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = from.force(static_cast<Eigen::Index>(i)) > 0.0;
  ContactSearch search(pads, problem, 60);
  search.withoutModel();
  const ContactSearch::Result result = search.run(start);
  if (result.force.size() == 0) return {};
  const double least = 1e-11 * result.force.maxCoeff();
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = result.force(static_cast<Eigen::Index>(i)) > least;
  return start;
}

}  // namespace suture
