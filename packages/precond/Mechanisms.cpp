#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/Mechanisms.hpp>
#include <suture/precond/PrimalRows.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace suture {

Matrix rigidMotionsOf(const InterfaceSpace& space, const std::vector<int>& unknowns, bool withRotation) {
  const int d = space.dimension();
  Point centre{0, 0, 0};
  for (const int place : unknowns)
    for (int k = 0; k < 3; ++k) centre[k] += space.point(place)[k] / static_cast<double>(unknowns.size());
  double size = 0.0;
  for (const int place : unknowns)
    for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(space.point(place)[k] - centre[k]), std::abs(space.moment(place)[k])});
  Matrix modes = Matrix::Zero(static_cast<int>(unknowns.size()), withRotation ? rigidMotions(d) : d);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const std::array<double, 6> values =
        rigidValues(d, minus(space.point(unknowns[i]), centre), space.direction(unknowns[i]), space.moment(unknowns[i]));
    const int row = static_cast<int>(i);
    for (int k = 0; k < d; ++k) modes(row, k) = values[k];
    for (int k = d; k < modes.cols() && size > 0.0; ++k) modes(row, k) = values[k] / size;
  }
  return modes;
}

namespace {

constexpr double kFelt = 1e-3;   // least trace of a motion on the seams of two subdomains, relative to the largest
constexpr double kTold = 1e-6;   // least value of constraints for a motion of length one; a mechanism leaves round-off
constexpr double kAlone = 1e-8;  // the same for a single local problem, whose points may be close together

class Mechanisms {
 public:
  Mechanisms(const InterfaceSpace& space, const LocalProblems& locals, PrimalChoice& choice)
      : space_(space), locals_(locals), choice_(choice), entitiesOf_(space.locals()) {
    std::map<int, int> localOf;
    for (int i = 0; i < space.locals(); ++i)
      if (locals[i]) localOf[space.localId(i)] = i;
    for (std::size_t e = 0; e < space.entities().size(); ++e)
      for (const int sharer : space.entities()[e].sharers)
        if (const auto here = localOf.find(sharer); here != localOf.end()) entitiesOf_[here->second].push_back(static_cast<int>(e));
  }

  /// Finds the few local problems and pairs of neighbours whose primal points do not determine all motions. Local.
  bool look() {
    loose_.clear();
    pairs_.clear();
    for (int i = 0; i < space_.locals(); ++i) {
      if (!locals_[i]) continue;
      if (!pointsTellAll(entitiesOf_[i]) && locals_[i]->kernel().cols() > 0) loose_.push_back(i);
      std::map<int, Pair> shared;  // by the other local problem
      for (const int e : entitiesOf_[i]) {
        const InterfaceEntity& entity = space_.entities()[e];
        const bool vertex = entity.kind == EntityKind::Vertex;
        if (entity.contact && !vertex) continue;  // may slide
        for (const int other : entity.sharers) {
          if (other == space_.localId(i)) continue;
          Pair& pair = shared.emplace(other, Pair{space_.localId(i), other, {}, false}).first->second;
          pair.entities.push_back(e);
          // In 3D neighbours are connected by faces; along edges and at vertices other subdomains hold them.
          pair.seam = pair.seam || (space_.dimension() == 2 ? !vertex : entity.kind == EntityKind::Face);
        }
      }
      for (auto& [other, pair] : shared)
        // Kernels last: those of contact groups are computed on demand.
        if (pair.seam && !pointsTellAll(pair.entities) && !rowsTellAll(pair.entities) && locals_[i]->kernel().cols() > 0)
          pairs_.push_back(std::move(pair));
    }
    return !loose_.empty() || !pairs_.empty();
  }

  /// Marks points where loose_ and pairs_ have motions left. Collective.
  bool mark() {
    if (!motionsMade_) findMotions();  // collective: also on ranks without entities
    added_ = Matrix::Zero(space_.overlapSize(), 1);
    rows_.clear();
    for (const int i : loose_) holdAlone(i);
    for (const Pair& pair : pairs_) holdTogether(pair);
    return added_.size() > 0 && added_.maxCoeff() > 0.0;
  }

  /// Makes the marked points of all ranks primal alone and restricts the rows of their entities to the rest. Collective.
  void add() {
    const std::vector<InterfaceEntity> before = withoutAlone(space_, choice_.alone);
    space_.sum(added_);
    for (int place = 0; place < space_.overlapSize(); ++place)
      if (added_(place, 0) > 0.0 && !space_.relation(place)) choice_.alone[place] = 1;
    for (std::size_t e = 0; e < before.size(); ++e) {
      std::vector<int> kept;
      for (std::size_t k = 0; k < before[e].unknowns.size(); ++k)
        if (!choice_.alone[before[e].unknowns[k]]) kept.push_back(static_cast<int>(k));
      if (kept.size() == before[e].unknowns.size()) continue;
      choice_.rows[e] =
          kept.empty() ? Matrix(0, 0) : Matrix(orthonormalBasis(rowsAt(choice_.rows[e].transpose(), kept), 1e-10).transpose());
    }
  }

 private:
  struct Pair {
    int one, other;             // ids; the first is on this rank and floats
    std::vector<int> entities;  // shared entities
    bool seam;                  // they share more than vertices
  };

  /// Kernels of all sharers on each entity, in the unknowns of the entity.
  void findMotions() {
    motionsMade_ = true;
    const std::vector<EntitySide> sides = entitySides(space_, space_.entities());
    motions_ = exchangeSides(space_, space_.entities(), sides, [&](std::size_t k) {
      const EntitySide& side = sides[k];
      if (!locals_[side.local]) return Matrix();
      const Matrix& kernel = locals_[side.local]->kernel();
      Matrix motion = Matrix::Zero(static_cast<int>(side.rows.size()), kernel.cols());
      for (int row = 0; row < motion.rows(); ++row)
        if (side.rows[row] >= 0) motion.row(row) = kernel.row(side.rows[row]) / side.coefficients(row);
      return motion;
    });
  }

  /// True if the unknowns that are primal alone determine all rigid motions: nearly always the case, and cheap to test.
  bool pointsTellAll(const std::vector<int>& entities) const {
    const int motions = rigidMotions(space_.dimension());
    std::vector<int> alone;
    for (const int e : entities)
      for (const int place : space_.entities()[e].unknowns)
        if (choice_.alone[place]) alone.push_back(place);
    if (static_cast<int>(alone.size()) < motions) return false;
    const Matrix modes = rigidMotionsOf(space_, alone, true);
    const Matrix gram = modes.transpose() * modes;
    Matrix lower;
    if (!choleskyFactor(gram, lower)) return false;
    for (int k = 0; k < motions; ++k)
      if (!(lower(k, k) * lower(k, k) > kTold * gram(k, k))) return false;
    return true;
  }

  /// True if the rows of one entity determine all its rigid motions: nearly always the case for faces.
  bool rowsTellAll(const std::vector<int>& entities) const {
    for (const int e : entities) {
      const Matrix& rows = choice_.rows[e];
      if (rows.rows() < rigidMotions(space_.dimension())) continue;
      std::vector<int> rest;
      for (const int place : space_.entities()[e].unknowns)
        if (!choice_.alone[place]) rest.push_back(place);
      const Matrix modes = orthonormalBasis(rigidMotionsOf(space_, rest, true), kFelt);
      if (modes.cols() == rigidMotions(space_.dimension()) && (modes - rows.transpose() * (rows * modes)).norm() < kFelt) return true;
    }
    return false;
  }

  /// Marks the point whose unknowns move most. \param unknowns  candidates; \param motions  their values, one row per unknown
  void markLargest(const std::vector<int>& unknowns, const Matrix& motions) {
    std::map<Point, double> moved;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      if (!choice_.alone[unknowns[k]]) moved[space_.point(unknowns[k])] += motions.row(static_cast<int>(k)).squaredNorm();
    const auto least = [](const auto& a, const auto& b) { return a.second < b.second; };
    const auto best = std::max_element(moved.begin(), moved.end(), least);
    if (best == moved.end() || !(best->second > 0.0)) return;  // the factorisation reports it
    for (const int place : unknowns)
      if (space_.point(place) == best->first && !choice_.alone[place]) added_(place, 0) = 1.0;
  }

  /// First rule of stopMechanisms().
  void holdAlone(int i) {
    const Matrix modes = orthonormalBasis(locals_[i]->kernel(), kAlone);
    if (rows_.empty()) rows_ = primalRows(space_, choice_, false);
    const Matrix left = nullSpace(Matrix(rows_[i].rows * modes), kAlone);
    if (left.cols() == 0) return;
    std::vector<int> unknowns, rows;
    for (const EntitySide& side : entitySides(space_, space_.entities()))
      if (side.local == i)
        for (std::size_t k = 0; k < side.rows.size(); ++k)
          if (side.rows[k] >= 0) {
            unknowns.push_back(space_.entities()[side.entity].unknowns[k]);
            rows.push_back(side.rows[k]);
          }
    markLargest(unknowns, rowsAt(Matrix(modes * left), rows));
  }

  /// Stacked motions of a sharer on some entities, scaled to one; false if the sharer does not take part.
  bool motionsOf(int sharer, const std::vector<int>& entities, Matrix& motions) const {
    motions.resize(0, 0);
    for (const int e : entities) {
      const std::vector<int>& sharers = space_.entities()[e].sharers;
      const Matrix& own = motions_[e][std::lower_bound(sharers.begin(), sharers.end(), sharer) - sharers.begin()];
      if (own.rows() == 0) return false;
      const auto before = motions.rows();
      motions.conservativeResize(before + own.rows(), own.cols());
      motions.bottomRows(own.rows()) = own;
    }
    if (const double size = motions.size() > 0 ? motions.cwiseAbs().maxCoeff() : 0.0; size > 0.0) motions /= size;
    return true;
  }

  /// Second rule of stopMechanisms().
  void holdTogether(const Pair& pair) {
    Matrix one, other;
    if (!motionsOf(pair.one, pair.entities, one) || !motionsOf(pair.other, pair.entities, other)) return;
    Matrix both(one.rows(), one.cols() + other.cols());
    both << one, other;
    const Matrix modes = orthonormalBasis(both, kFelt);
    std::vector<int> felt;
    std::vector<Matrix> told;
    int count = 0;
    for (const int e : pair.entities) {
      std::vector<int> rest;
      for (const int place : space_.entities()[e].unknowns) {
        const int row = static_cast<int>(felt.size());
        felt.push_back(place);
        if (choice_.alone[place])
          told.push_back(modes.row(row));
        else
          rest.push_back(row);
      }
      if (choice_.rows[e].rows() > 0) told.push_back(choice_.rows[e] * rowsAt(modes, rest));
    }
    for (const Matrix& some : told) count += static_cast<int>(some.rows());
    Matrix all(count, modes.cols());
    count = 0;
    for (const Matrix& some : told) {
      all.middleRows(count, some.rows()) = some;
      count += static_cast<int>(some.rows());
    }
    const Matrix left = nullSpace(all, kTold);
    if (left.cols() > 0) markLargest(felt, modes * left);
  }

  const InterfaceSpace& space_;
  const LocalProblems& locals_;
  PrimalChoice& choice_;
  std::vector<std::vector<int>> entitiesOf_;  // entities of each local problem that takes part
  std::vector<int> loose_;                    // local problems to check
  std::vector<Pair> pairs_;
  std::vector<std::vector<Matrix>> motions_;  // motions of each sharer of each entity; made on demand, like rows_
  bool motionsMade_ = false;
  std::vector<PrimalRows> rows_;
  Matrix added_;  // unknowns to add, by place
};

}  // namespace

void stopMechanisms(const InterfaceSpace& space, const LocalProblems& locals, PrimalChoice& choice) {
  const auto anywhere = [&](bool here) {
    const int mine = here;
    int any = 0;
    Teuchos::reduceAll(*space.comm(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
    return any > 0;
  };
  Mechanisms mechanisms(space, locals, choice);
  const auto look = [&] {
    bool found = false;
    collectively(*space.comm(), "looking for mechanisms of local problems", [&] { found = mechanisms.look(); });
    return anywhere(found);
  };
  while (look() && anywhere(mechanisms.mark())) mechanisms.add();
}

}  // namespace suture
