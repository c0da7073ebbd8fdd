#pragma once
#include <array>
#include <optional>
#include <string>

namespace suture {

/// Numbers between which an exact value lies.
struct Interval {
  double low = 0.0, high = 0.0;

  double middle() const { return low + (high - low) / 2; }
  /// The values of both.
  Interval common(const Interval& other) const { return {low > other.low ? low : other.low, high < other.high ? high : other.high}; }
};

/// Strict bounds of the force of a support or contact, or of the displacement that is conjugate to a load. The same on all ranks.
struct ForceInterval {
  std::string name;
  bool isContact = false;  ///< name of a contact, else of a condition
  /// Components of the force as reported (contact: on side B); nothing: not bounded. [force]
  std::array<std::optional<Interval>, 3> force{};
  /// Mean displacement along a load: work of the load divided by the norm of its resultant. That is the mean displacement of its sides
  /// in the direction of a uniform traction. [length]
  std::optional<double> displacement{};
  std::optional<Interval> ofDisplacement{};
  std::string reason{};  ///< why bounds are missing; empty: all are there
};

}  // namespace suture
