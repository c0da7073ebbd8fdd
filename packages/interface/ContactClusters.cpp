#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/interface/ContactClusters.hpp>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace suture {

namespace {

using Sparse = std::vector<std::pair<int, double>>;  // place, coefficient; places ascend

// Coefficients are those of unit normals. Rows whose largest one is below kDependent depend on others. Coefficients below kRounding are
// remainders of others that cancelled; a larger one would be missing from the forces.
constexpr double kDependent = 1e-10;
constexpr double kRounding = 1e-14;
constexpr std::size_t kTwoNodes = 6;  // unknowns in space

/// The entry at a place; the end if there is none.
Sparse::iterator entryOf(Sparse& row, int place) {
  const auto before = [](const std::pair<int, double>& entry, int at) { return entry.first < at; };
  const auto found = std::lower_bound(row.begin(), row.end(), place, before);
  return found != row.end() && found->first == place ? found : row.end();
}

/// row += factor other. \param space  work space
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
}

std::vector<int> ContactClusters::closedRows(const std::vector<int>& cluster, const std::vector<ContactState>& status) const {
  std::vector<int> closed;
  for (const int row : cluster)
    if (status[rows_[row].pair].holds(rows_[row].component)) closed.push_back(row);
  return closed;
}

std::vector<InterfaceRelation> ContactClusters::relations(const std::vector<ContactState>& status) const {
  std::vector<InterfaceRelation> all;
  for (const auto& cluster : clusters_) {
    std::map<int, Sparse> solved;  // expressed unknown -> what expresses it
    std::map<int, double> sizes;   // expressed unknown -> size of the row
    const std::vector<int> closed = closedRows(cluster, status);
    std::map<int, int> uses;  // unknown -> number of rows
    for (const int number : closed)
      for (const int place : rows_[number].places) ++uses[place];
    const auto smaller = [](const auto& a, const auto& b) {
      return std::abs(a.second) < std::abs(b.second) * (1.0 - 1e-9);  // of equal ones the first
    };
    for (const int number : closed) {
      Sparse row, space;
      for (std::size_t k = 0; k < rows_[number].places.size(); ++k) {
        const int place = rows_[number].places[k];
        const double value = rows_[number].coefficients[k];
        if (const auto known = solved.find(place); known != solved.end())
          addTo(row, known->second, value, space);
        else
          addTo(row, {{place, 1.0}}, value, space);
      }
      auto pivot = std::max_element(row.begin(), row.end(), smaller);
      // Better one that no other row has, as each row of a mortar: then rows do not fill each other in.
      auto own = row.end();
      for (auto entry = row.begin(); entry != row.end(); ++entry)
        if (uses[entry->first] == 1 && (own == row.end() || smaller(*own, *entry))) own = entry;
      // Rows of six- and eight-node sides name the nodes of others, but can be solved for their carrying nodes one after the other.
      if (own == row.end() && rows_[number].places.size() > kTwoNodes) own = entryOf(row, rows_[number].places.front());
      if (own != row.end() && std::abs(own->second) > 0.5 * std::abs(pivot->second)) pivot = own;
      if (pivot == row.end() || std::abs(pivot->second) < kDependent) continue;
      const int place = pivot->first;
      Sparse by;
      for (const auto& [other, value] : row)
        if (other != place && std::abs(value) > kRounding) by.emplace_back(other, -value / pivot->second);
      if (uses[place] > 1)
        for (auto& [earlier, expression] : solved)
          if (const auto used = entryOf(expression, place); used != expression.end()) {
            const double factor = used->second;
            expression.erase(used);
            addTo(expression, by, factor, space);
          }
      solved[place] = std::move(by);
      sizes[place] = rows_[number].size;
    }
    for (const auto& [place, by] : solved) {
      InterfaceRelation relation{place, {}, {}, sizes[place]};
      for (const auto& [other, value] : by)
        if (std::abs(value) > kRounding) {
          relation.others.push_back(other);
          relation.coefficients.push_back(value);
        }
      all.push_back(std::move(relation));
    }
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

// C K^-1 C^T is sparse along a line: a factorisation, unless rows depend on each other.
Vector ContactClusters::solve(const std::vector<int>& rows, const Vector& rhs) const {
  if (rows.size() == 1) return rhs * rowStiffness_(rows[0]);
  std::map<int, int> columns;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t a = 0; a < rows.size(); ++a)
    for (std::size_t k = 0; k < rows_[rows[a]].places.size(); ++k) {
      const int place = rows_[rows[a]].places[k];
      const int column = columns.emplace(place, static_cast<int>(columns.size())).first->second;
      entries.emplace_back(static_cast<int>(a), column, rows_[rows[a]].coefficients[k] / std::sqrt(stiffness_(place)));
    }
  Eigen::SparseMatrix<double> scaled(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  scaled.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> compliance = scaled * scaled.transpose();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(compliance);
  if (factor.info() == Eigen::Success && factor.vectorD().minCoeff() > kDependent * factor.vectorD().maxCoeff()) return factor.solve(rhs);
  return leastSquares(Matrix(compliance), rhs);
}

Vector ContactClusters::forces(const std::vector<ContactState>& status, const Vector& imbalance) const {
  Vector force = Vector::Zero(size());
  for (const auto& cluster : clusters_) {
    const std::vector<int> closed = closedRows(cluster, status);
    if (closed.empty()) continue;
    Vector rhs = Vector::Zero(static_cast<int>(closed.size()));
    for (std::size_t a = 0; a < closed.size(); ++a)
      for (std::size_t k = 0; k < rows_[closed[a]].places.size(); ++k) {
        const int place = rows_[closed[a]].places[k];
        rhs(static_cast<int>(a)) -= rows_[closed[a]].coefficients[k] * imbalance(place) / stiffness_(place);
      }
    const Vector own = solve(closed, rhs);
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
      // Rounding of the unknowns is no reason to move them.
      double scale = std::abs(rows_[closed[a]].gap);
      for (const int place : rows_[closed[a]].places) scale = std::max(scale, std::abs(trace(place)));
      any = any || std::abs(gap(closed[a])) > 1e-14 * scale;
    }
    if (!any) continue;
    const Vector push = solve(closed, rhs);
    for (std::size_t a = 0; a < closed.size(); ++a)
      for (std::size_t k = 0; k < rows_[closed[a]].places.size(); ++k) {
        const int place = rows_[closed[a]].places[k];
        change(place) += rows_[closed[a]].coefficients[k] * push(static_cast<int>(a)) / stiffness_(place);
      }
  }
  return change;
}

}  // namespace suture
