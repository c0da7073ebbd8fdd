#pragma once
#include <suture/contact/FrictionSearch.hpp>

namespace suture {

/// Forces of all pairs that can change as a function of their jumps:  f = stuck - stiffness j,  with the force f on side B, the jump j =
/// u_A - u_B along the tangents and the penetration along the normal. Measured by opening and sliding one pair after the other while all
/// others stick, with one solve per row. The same on all ranks.
class PairResponse {
 public:
  struct Row {
    std::size_t pair;
    int component;  ///< 0: normal; 1, 2: tangents, for pairs that can stick
  };

  /// Collective if the oracle is. \param stuck  states in which no pair has a jump;  \param most  maximum number of rows
  /// \return false: there are more rows, a pair holds a body alone, a solve failed, or there are no forces
  bool measure(const RigidContact& rigid, FrictionOracle& oracle, const PairStates& stuck, std::size_t most);

  /// Rows of a pair are consecutive, the normal one first.
  const std::vector<Row>& rows() const { return rows_; }
  /// Forces without a jump. [force]
  const Vector& stuck() const { return force_; }
  /// Symmetric, positive semidefinite; its null space consists of the jumps of rigid motions. [force / length]
  const Matrix& stiffness() const { return stiffness_; }
  int solves() const { return solves_; }

  /// gather: values of all pairs (pairs x 3), row by row; spread: the inverse.
  Vector gather(const Matrix& values) const;
  Matrix spread(const Vector& values, Eigen::Index pairs) const;

 private:
  bool solve(FrictionOracle& oracle, const PairStates& states, Vector& force, Vector& jump);
  ContactState sliding(Eigen::Index row, double force) const;
  bool slide(const RigidContact& rigid, FrictionOracle& oracle, const PairStates& stuck);
  bool open(const RigidContact& rigid, FrictionOracle& oracle, const PairStates& stuck);
  Eigen::Index press(const RigidContact& rigid, Eigen::Index row, const PairStates& stuck) const;

  std::vector<Row> rows_;
  Vector force_;
  Matrix stiffness_;
  Matrix changes_;        // change of all forces (rows) when the pair of a row (column) slides along that row
  double scale_ = 0.0;    // largest force
  double softest_ = 0.0;  // order of the largest jump per force [length / force]
  int solves_ = 0;
};

}  // namespace suture
