#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/interface/ContactClusters.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace suture {

namespace {

using Sparse = std::vector<std::pair<int, double>>;

// Coefficients are those of unit normals. Rows whose largest coefficient is below kDependent are linearly dependent. Coefficients below
// kRounding are remainders of cancellation; a larger threshold would lose forces.
constexpr double kDependent = 1e-10;
constexpr double kRounding = 1e-14;
constexpr double kDragged =
    0.1;  // least coefficient, relative to the largest of a row with friction, of the unknown for which the row is solved
constexpr double kShift = 1e-12;      // shift, relative to the largest compliance of a row
constexpr std::size_t kTwoNodes = 6;  // number of unknowns in 3D

/// The entry at a place, or end().
Sparse::iterator entryOf(Sparse& row, int place) {
  const auto before = [](const std::pair<int, double>& entry, int at) { return entry.first < at; };
  const auto found = std::lower_bound(row.begin(), row.end(), place, before);
  return found != row.end() && found->first == place ? found : row.end();
}

/// row += factor * other. \param space  work space
void addTo(Sparse& row, const Sparse& other, double factor, Sparse& space) {
  space.clear();
  auto own = row.cbegin();
  for (const auto& [place, value] : other) {
    while (own != row.cend() && own->first < place) space.push_back(*own++);
    const bool both = own != row.cend() && own->first == place;
    space.emplace_back(place, both ? own->second + factor * value : factor * value);
    own += both;
  }
  space.insert(space.end(), own, row.cend());
  row.swap(space);
}

}  // namespace

ContactClusters::ContactClusters(std::vector<Row> rows, Vector stiffness) : rows_(std::move(rows)), stiffness_(std::move(stiffness)) {
  std::map<int, std::vector<int>> byNumber;
  rowStiffness_ = Vector::Zero(size());
  for (int i = 0; i < size(); ++i) {
    if (rows_[i].pair < 0) rows_[i].pair = i;
    if (rows_[i].places.empty()) continue;
    byNumber[rows_[i].cluster].push_back(i);
    double compliance = 0.0;
    for (std::size_t k = 0; k < rows_[i].places.size(); ++k)
      compliance += rows_[i].coefficients[k] * rows_[i].coefficients[k] / stiffness_(rows_[i].places[k]);
    rowStiffness_(i) = 1.0 / compliance;
  }
  for (auto& [number, members] : byNumber) clusters_.push_back(std::move(members));
  for (int i = 0; i < size(); ++i) {
    if (rows_[i].component == 0) continue;
    const auto pair = static_cast<std::size_t>(rows_[i].pair);
    if (tangentsOf_.size() <= pair) tangentsOf_.resize(pair + 1, {{-1, -1}});
    tangentsOf_[pair][rows_[i].component - 1] = i;
  }
}

int ContactClusters::rowOf(int pair, int component) const {
  if (component == 0) return pair;
  return pair < static_cast<int>(tangentsOf_.size()) ? tangentsOf_[pair][component - 1] : -1;
}

ContactClusters::Row ContactClusters::withFriction(int row, const std::vector<ContactState>& status) const {
  Row result = rows_[row];
  const ContactState& state = status[result.pair];
  if (result.component != 0 || !state.couplesToNormal()) return result;
  for (int component = 1; component <= 2; ++component) {
    const int tangent = rowOf(result.pair, component);
    if (tangent < 0 || state.direction[component] == 0.0) continue;
    const Row& along = rows_[tangent];
    for (std::size_t k = 0; k < along.places.size(); ++k) {
      const auto at = std::find(result.places.begin(), result.places.end(), along.places[k]);
      const double value = state.friction * state.direction[component] * along.coefficients[k];
      if (at == result.places.end()) {
        result.places.push_back(along.places[k]);
        result.coefficients.push_back(value);
      } else {
        result.coefficients[static_cast<std::size_t>(at - result.places.begin())] += value;
      }
    }
  }
  return result;
}

/// Rows of a cluster, each solved for one unknown in turn.
class ContactClusters::Elimination {
 public:
  /// The row after substitution of the solved unknowns.
  Sparse reduced(const Row& row) {
    Sparse result;
    for (std::size_t k = 0; k < row.places.size(); ++k) {
      const int place = row.places[k];
      if (const auto known = solved_.find(place); known != solved_.end())
        addTo(result, known->second, row.coefficients[k], space_);
      else
        addTo(result, {{place, 1.0}}, row.coefficients[k], space_);
    }
    return result;
  }

  /// Solves a reduced row for an unknown. \param elsewhere  true if earlier rows may contain the unknown
  void solve(const Sparse& row, int place, double value, double size, bool elsewhere) {
    Sparse by;
    for (const auto& [other, coefficient] : row)
      if (other != place && std::abs(coefficient) > kRounding) by.emplace_back(other, -coefficient / value);
    if (elsewhere)
      for (auto& [earlier, expression] : solved_)
        if (const auto used = entryOf(expression, place); used != expression.end()) {
          const double factor = used->second;
          expression.erase(used);
          addTo(expression, by, factor, space_);
        }
    solved_[place] = std::move(by);
    sizes_[place] = size;
  }

  void appendTo(std::vector<InterfaceRelation>& all) const {
    for (const auto& [place, by] : solved_) {
      InterfaceRelation relation{place, {}, {}, sizes_.at(place)};
      for (const auto& [other, value] : by)
        if (std::abs(value) > kRounding) {
          relation.others.push_back(other);
          relation.coefficients.push_back(value);
        }
      all.push_back(std::move(relation));
    }
  }

 private:
  std::map<int, Sparse> solved_;  // expressed unknown -> its expression
  std::map<int, double> sizes_;   // expressed unknown -> size of the row
  Sparse space_;
};

std::vector<int> ContactClusters::closedRows(const std::vector<int>& cluster, const std::vector<ContactState>& status) const {
  std::vector<int> closed;
  for (const int row : cluster)
    if (status[rows_[row].pair].holds(rows_[row].component)) closed.push_back(row);
  return closed;
}

std::vector<InterfaceRelation> ContactClusters::relations(const std::vector<ContactState>& status,
                                                          std::vector<InterfaceRelation>* test) const {
  std::vector<InterfaceRelation> all;
  const bool couples = test && std::any_of(status.begin(), status.end(), [](const ContactState& state) { return state.couplesToNormal(); });
  if (test) test->clear();
  for (const auto& cluster : clusters_) {
    Elimination trial, tested;
    const std::vector<int> closed = closedRows(cluster, status);
    std::map<int, int> uses;  // unknown -> number of rows that contain it
    for (const int number : closed)
      for (const int place : rows_[number].places) ++uses[place];
    const auto smaller = [](const auto& a, const auto& b) {
      return std::abs(a.second) < std::abs(b.second) * (1.0 - 1e-9);  // the first among equal ones
    };
    for (const int number : closed) {
      Sparse row = trial.reduced(rows_[number]), dragged;
      const auto chosen = [&](Sparse& rank) {
        auto pivot = std::max_element(rank.begin(), rank.end(), smaller);
        // Prefer an unknown that no other row contains, as in each row of a mortar: this avoids fill-in.
        auto own = rank.end();
        for (auto entry = rank.begin(); entry != rank.end(); ++entry)
          if (uses[entry->first] == 1 && (own == rank.end() || smaller(*own, *entry))) own = entry;
        // Rows of six- and eight-node sides contain nodes of other rows, but can be solved for their carrying nodes one after the other.
        if (own == rank.end() && rows_[number].places.size() > kTwoNodes) own = entryOf(rank, rows_[number].places.front());
        return own != rank.end() && std::abs(own->second) > 0.5 * std::abs(pivot->second) ? own : pivot;
      };
      auto pivot = chosen(row);
      if (couples) {  // both rows are solved for the same unknown: the pivot of the row without friction, unless it nearly vanishes in the
                      // row with friction
        dragged = tested.reduced(withFriction(number, status));
        const auto entry = pivot == row.end() ? dragged.end() : entryOf(dragged, pivot->first);
        const auto largest = std::max_element(dragged.begin(), dragged.end(), smaller);
        if (pivot != row.end() && (entry == dragged.end() || std::abs(entry->second) < kDragged * std::abs(largest->second))) {
          Sparse both = row;
          for (auto& [place, value] : both) {
            const auto other = entryOf(dragged, place);
            value = other == dragged.end() ? 0.0 : std::sqrt(std::abs(value * other->second));
          }
          pivot = entryOf(row, chosen(both)->first);
        }
      }
      if (pivot == row.end() || std::abs(pivot->second) < kDependent) continue;
      const int place = pivot->first;
      if (couples && (entryOf(dragged, place) == dragged.end() || std::abs(entryOf(dragged, place)->second) < kDependent)) continue;
      trial.solve(row, place, entryOf(row, place)->second, rows_[number].size, uses[place] > 1);
      if (couples) tested.solve(dragged, place, entryOf(dragged, place)->second, rows_[number].size, true);
    }
    trial.appendTo(all);
    if (couples) tested.appendTo(*test);
  }
  return all;
}

Vector ContactClusters::gaps(const Vector& trace, const Vector& moved) const {
  Vector gap(size());
  for (int i = 0; i < size(); ++i) {
    gap(i) = moved.size() > 0 ? rows_[i].gap - moved(i) : rows_[i].gap;
    for (std::size_t k = 0; k < rows_[i].places.size(); ++k) gap(i) -= rows_[i].coefficients[k] * trace(rows_[i].places[k]);
  }
  return gap;
}

// C K^-1 C^T is sparse along a line: use a factorisation, unless rows are linearly dependent.
Vector ContactClusters::solve(const std::vector<const Row*>& rows, const Vector& rhs) const {
  std::map<int, int> columns;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t k = 0; k < rows[a]->places.size(); ++k) {
      const int place = rows[a]->places[k];
      const int column = columns.emplace(place, static_cast<int>(columns.size())).first->second;
      entries.emplace_back(static_cast<int>(a), column, rows[a]->coefficients[k] / std::sqrt(stiffness_(place)));
    }
  Eigen::SparseMatrix<double> scaled(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  scaled.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> compliance = scaled * scaled.transpose();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(compliance);
  if (factor.info() == Eigen::Success && factor.vectorD().minCoeff() > kDependent * factor.vectorD().maxCoeff()) return factor.solve(rhs);
  // Linearly dependent rows: the least forces, by a shift whose effect iterative refinement removes where the rows determine the forces.
  Eigen::SparseMatrix<double> shifted = compliance;
  shifted.diagonal().array() += kShift * shifted.diagonal().maxCoeff();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> regular(shifted);
  if (regular.info() != Eigen::Success) return leastSquares(Matrix(compliance), rhs);
  Vector x = regular.solve(rhs);
  for (int pass = 0; pass < 2; ++pass) x += regular.solve(rhs - compliance * x);
  return x;
}

Vector ContactClusters::forces(const std::vector<ContactState>& status, const Vector& imbalance) const {
  Vector force = Vector::Zero(size());
  for (const auto& cluster : clusters_) {
    const std::vector<int> closed = closedRows(cluster, status);
    if (closed.empty()) continue;
    const bool couples = std::any_of(closed.begin(), closed.end(), [&](int row) { return status[rows_[row].pair].couplesToNormal(); });
    std::vector<Row> dragged;
    std::vector<const Row*> rows;
    if (couples) {
      dragged.reserve(closed.size());
      for (const int row : closed) dragged.push_back(withFriction(row, status));
    }
    for (std::size_t a = 0; a < closed.size(); ++a) rows.push_back(couples ? &dragged[a] : &rows_[closed[a]]);
    Vector rhs = Vector::Zero(static_cast<int>(closed.size()));
    for (std::size_t a = 0; a < closed.size(); ++a)
      for (std::size_t k = 0; k < rows[a]->places.size(); ++k) {
        const int place = rows[a]->places[k];
        rhs(static_cast<int>(a)) -= rows[a]->coefficients[k] * imbalance(place) / stiffness_(place);
      }
    if (closed.size() == 1 && !couples) {
      force(closed[0]) = rhs(0) * rowStiffness_(closed[0]);
      continue;
    }
    const Vector own = solve(rows, rhs);
    for (std::size_t a = 0; a < closed.size(); ++a) force(closed[a]) = own(static_cast<int>(a));
  }
  return force;
}

Vector ContactClusters::correction(const std::vector<ContactState>& status, const Vector& trace, const Vector& moved) const {
  Vector change = Vector::Zero(trace.size());
  const Vector gap = gaps(trace, moved);
  for (const auto& cluster : clusters_) {
    const std::vector<int> closed = closedRows(cluster, status);
    Vector rhs(static_cast<int>(closed.size()));
    bool any = false;
    for (std::size_t a = 0; a < closed.size(); ++a) {
      rhs(static_cast<int>(a)) = gap(closed[a]);
      // Do not move unknowns by their round-off.
      double scale = std::abs(rows_[closed[a]].gap);
      for (const int place : rows_[closed[a]].places) scale = std::max(scale, std::abs(trace(place)));
      any = any || std::abs(gap(closed[a])) > 1e-14 * scale;
    }
    if (!any) continue;
    std::vector<const Row*> rows;
    for (const int row : closed) rows.push_back(&rows_[row]);
    const Vector push = closed.size() == 1 ? Vector(rhs * rowStiffness_(closed[0])) : solve(rows, rhs);
    for (std::size_t a = 0; a < closed.size(); ++a)
      for (std::size_t k = 0; k < rows_[closed[a]].places.size(); ++k) {
        const int place = rows_[closed[a]].places[k];
        change(place) += rows_[closed[a]].coefficients[k] * push(static_cast<int>(a)) / stiffness_(place);
      }
  }
  return change;
}

}  // namespace suture
