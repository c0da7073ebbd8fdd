#pragma once
#include <string>
#include <vector>

namespace suture {

/// How forces of parts that are removed at one time fall to zero: fractions of them are released by the ends of the load steps that follow,
/// linear between. Local.
class Release {
 public:
  /// \param begin  time of the removal \param ends  of the steps that follow, ascending, at least one \param fractions  released by then,
  /// ascending, the last one 1
  Release(double begin, std::vector<double> ends, std::vector<double> fractions);

  /// Time of the removal.
  double begin() const { return begin_; }
  /// Fraction of the forces that still acts at a time.
  double remaining(double time) const;
  /// "forces released to 40, 100 % at t = 2, 3".
  std::string text() const;

 private:
  double begin_;
  std::vector<double> ends_, fractions_;
};

}  // namespace suture
