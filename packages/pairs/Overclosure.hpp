#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Types.hpp>
#include <suture/base/scene/Schema.hpp>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Pressure of a softened contact as a convex, piecewise linear function of its overclosure c: the sum over springs in parallel of
/// stiffness <c - begin>+. An overclosure is a negative gap, a clearance a negative overclosure.
class Overclosure {
 public:
  static constexpr const char* kParameter = "Pressure Overclosure";

  /// A spring that acts from an overclosure on.
  struct Spring {
    double stiffness = 0.0;  ///< [stress / length]
    double begin = 0.0;      ///< overclosure at which it begins [length]
  };

  /// p = stiffness <c>+
  static Overclosure linear(double stiffness);
  /// p = p0 / (e - 1) [(c / c0 + 1) (exp(c / c0 + 1) - 1)] for c > -c0, replaced by straight lines that differ from it by at most
  /// `accuracy` times the larger of p and p0, up to a largest pressure. \param pressure  p0 at zero clearance \param clearance  c0 at zero
  /// pressure
  static Overclosure exponential(double pressure, double clearance, double accuracy, double largestPressure);
  /// Straight lines through rows. \throws InputError  without path: fewer than two rows, a first pressure that is not zero, overclosures
  /// that do not increase, pressures that decrease or that soften
  static Overclosure table(const std::vector<double>& pressures, const std::vector<double>& overclosures);

  /// Values of the parameter `Pressure Overclosure` of a contact: Hard, Linear, Exponential, Table.
  static std::map<std::string, Schema> choices();
  /// The law of an entry of `Contact`; nothing: hard contact. \param problems  receives invalid values
  static std::optional<Overclosure> read(const Parameters& contact, Problems& problems);

  /// The springs, in the order in which they begin; at least one.
  const std::vector<Spring>& springs() const { return springs_; }
  double pressure(double overclosure) const;
  /// Pressure up to which the law is given; beyond it the last slope continues. [stress]
  double largestPressure() const { return largestPressure_; }
  /// Tangential stiffness as a fraction of the normal one.
  double tangentialRatio() const { return tangentialRatio_; }
  /// A sentence about the approximation, or nothing.
  const std::string& note() const { return note_; }

 private:
  std::vector<Spring> springs_;
  double largestPressure_ = std::numeric_limits<double>::infinity();
  double tangentialRatio_ = 1.0;
  std::string note_;
};

/// An entry of the scene's list `Contact` as its solvers see it: the rigid contact of one spring of the entry's Overclosure, or the entry
/// itself. The lines are first all entries with their first springs, in the order of the scene, then the other springs.
struct ContactLine {
  std::string name;                  ///< name of the entry
  int entry = -1;                    ///< place of the entry in the list
  int spring = 0;                    ///< index in Overclosure::springs()
  std::optional<Overclosure> law{};  ///< law of the entry; nothing: hard

  double begin() const { return law ? law->springs()[std::size_t(spring)].begin : 0.0; }
};

/// Lines of a list `Contact`. Local, the same on all ranks. \throws InputError  invalid laws of overclosure
std::vector<ContactLine> contactLines(const Parameters& contact);
/// Lines of entries with these names and laws of overclosure.
std::vector<ContactLine> contactLines(const std::vector<std::string>& names, const std::vector<std::optional<Overclosure>>& laws);

}  // namespace suture
