#include <suture/interface/Directory.hpp>
#include <suture/precond/coarse/BddcCoarse.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
// Error of a coarse solve in the energy of the diagonal: round-off times the scaled condition number, which stays below 1e8 for jumps of
// 1e8.
constexpr double kRegular = 1e-6;
}  // namespace

BddcCoarse::BddcCoarse(const CommPtr& comm, int dimension, const std::vector<int>& ids, const Inverses& inverses,
                       std::vector<PrimalRows> constraints, int locals, CoarseOptions levels)
    : comm_(comm) {
  CoarseElements coarse;
  coarse.dimension = dimension;
  const int mine = number(ids, inverses, std::move(constraints), coarse);
  int any = 0;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(any));
  // Rows of several terms name unknowns that other local problems determine. A cluster without those local problems has motions that its
  // constraints to other clusters hardly restrain: the condition number grows to 1e3 and beyond.
  exactInstead_ = any && levels.goesOn(locals, coarse.dimension);
  if (exactInstead_) levels.above = locals;
  solver_ = makeCoarseSolve(comm_, std::move(coarse), locals, levels);
}

/// Numbers the primal unknowns over all ranks and makes the coarse elements. True if a local problem names more unknowns than it has rows.
/// Frees the terms and unknowns of the constraints in passing; only A_i remains.
bool BddcCoarse::number(const std::vector<int>& ids, const Inverses& inverses, std::vector<PrimalRows> constraints,
                        CoarseElements& coarse) {
  std::vector<GlobalId> keys;
  std::size_t entries = 0, problems = 0;
  for (std::size_t i = 0; i < inverses.size(); ++i)
    if (inverses[i]) {
      ++problems;
      for (const auto& row : constraints[i].terms) {
        entries += row.size();
        for (const auto& term : row) keys.push_back(term.key);
      }
      for (const auto& unknown : constraints[i].unknowns) keys.push_back(unknown.id);
    }
  const std::vector<int> numbers = numberKeys(comm_, keys, coarse.size);
  names_ = numbers;
  std::sort(names_.begin(), names_.end());
  names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
  names_.shrink_to_fit();
  const std::vector<int> places = placesAmong(names_, numbers);
  values_.clear();
  values_.reserve(entries);
  valuesFrom_.assign(1, 0);
  valuesFrom_.reserve(inverses.size() + 1);
  coarse.elements.reserve(problems);
  std::vector<char> known(names_.size(), 0);
  std::size_t next = 0;
  bool named = false;
  for (std::size_t i = 0; i < inverses.size(); ++i) {
    if (inverses[i])
      for (std::size_t row = 0; row < constraints[i].terms.size(); ++row)
        for (const auto& term : constraints[i].terms[row]) values_.push_back({static_cast<int>(row), places[next++], term.coefficient});
    valuesFrom_.push_back(values_.size());
    if (!inverses[i]) continue;
    for (InterfaceLayout::Unknown unknown : constraints[i].unknowns) {
      const int place = places[next];
      unknown.id = numbers[next++];
      if (!known[place]) coarse.unknowns.push_back(unknown);
      known[place] = 1;
    }
    coarse.elements.push_back(element(i, inverses[i]->energy()));
    coarse.elements.back().id = ids[i];
    named = named || static_cast<int>(coarse.elements.back().unknowns.size()) > inverses[i]->energy().rows();
    constraints[i] = PrimalRows();
  }
  std::sort(coarse.unknowns.begin(), coarse.unknowns.end(),
            [](const InterfaceLayout::Unknown& a, const InterfaceLayout::Unknown& b) { return a.id < b.id; });
  coarse.unknowns.shrink_to_fit();
  return named;
}

/// A_i^T Phi_i^T S_i Phi_i A_i
CoarseElement BddcCoarse::element(std::size_t i, const Matrix& energy) const {
  CoarseElement made;
  std::vector<int> places;
  for (const Value& value : valuesOf(i)) places.push_back(value.place);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  made.unknowns.reserve(places.size());
  for (const int place : places) made.unknowns.push_back(names_[place]);
  // Most rows have one unknown: sparse product, column by column.
  const auto size = static_cast<Eigen::Index>(places.size());
  const auto times = [&](const Matrix& columns) {
    Matrix product = Matrix::Zero(columns.rows(), size);
    for (const Value& value : valuesOf(i)) {
      const auto at = std::lower_bound(places.begin(), places.end(), value.place) - places.begin();
      product.col(at) += value.coefficient * columns.col(value.row);
    }
    return product;
  };
  made.matrix = times(times(energy).transpose());
  return made;
}

bool BddcCoarse::isRegular(const Inverses& inverses) const {
  if (solver_->clusters() > 0 || solver_->size() == 0) return true;
  Vector given(static_cast<int>(names_.size())), image = Vector::Zero(given.size()), diagonal = image;
  for (int k = 0; k < given.size(); ++k) given(k) = 1.0 + 0.5 * std::sin(1.0 + 7.0 * names_[k]);
  for (std::size_t i = 0; i < inverses.size(); ++i) {
    if (!inverses[i]) continue;
    const CoarseElement own = element(i, inverses[i]->energy());
    const std::vector<int> places = placesAmong(names_, own.unknowns);
    image(places) += own.matrix * given(places);
    diagonal(places) += own.matrix.diagonal();
  }
  const Vector error = solver_->solve(image) - given;
  const double mine[2] = {diagonal.dot(error.cwiseAbs2()), diagonal.dot(given.cwiseAbs2())};
  double all[2];
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, 2, mine, all);
  return all[0] < kRegular * kRegular * all[1];
}

}  // namespace suture
