#pragma once
#include <suture/answer/values/ForceInterval.hpp>
#include <suture/simulation/accuracy/ChangedAmount.hpp>

#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Names of conditions and contacts whose forces are to have strict bounds (`Output/Strict Error Bars`). Local.
std::vector<std::string> strictBarsOf(const Parameters& settings);

/// Refuses names among them that the scene does not have. Local. \throws InputError  all of them, with the nearest names
void checkStrictBars(const Parameters& settings, const std::vector<std::string>& conditions, const std::vector<std::string>& contacts);

/// Strict bounds of forces and displacements, each from two more solutions on the same mesh with changed amounts.
///
/// The potential energy J of the solution is a convex function of a prescribed displacement d, and the force is F = dJ / dd. Hence
///     (J(d) - J(d - e)) / e <= F <= (J(d + e) - J(d)) / e   for each e > 0,
/// and the error bounds give numbers below and above J: for F, those below J(d) and above J(d + e) and J(d - e). The same holds for the
/// approach of the sides of a contact. In the factor of a load J is concave, and dJ / d(factor) is minus the work of the load: the numbers
/// below J are required at the changed factors.
///
/// With the gap g between both numbers, e = sqrt(2 g / J'') gives the shortest interval, about F +- sqrt(2 g J''): its relative length is
/// that of the error bound. J'' is found from the solutions; if it was guessed badly, e is changed, up to twice.
class ForceIntervals {
 public:
  /// All must outlive it. \param method  of the scene, prepared for changes; may be replaced \param solution  judged, with its bound
  ForceIntervals(SceneParts& parts, std::unique_ptr<Method>& method, const Solution& solution);

  /// Bounds for the requested names. Phases "load", "solve", "bound". Collective. The same on all ranks.
  std::vector<ForceInterval> find(const std::vector<std::string>& names);

 private:
  /// Contact: normal from side A to side B, sum of the pair forces.
  struct Pressed {
    Point normal{0, 0, 0};
    double force = 0.0;
  };
  std::string whyNone() const;
  void addCondition(int condition, ForceInterval& all);
  void addSupport(int condition, ForceInterval& all);
  void addLoad(int load, ForceInterval& all);
  void addContact(int line, ForceInterval& all);
  std::string intervalOf(const Amount& amount, double conjugate, Interval& found);
  std::string energiesAt(const Amount& amount, double by, Interval& energies);
  Interval energiesOf(const ErrorBound& bound) const;
  double forceScale() const;

  SceneParts& parts_;
  std::unique_ptr<Method>& method_;
  const Solution& solution_;
  std::vector<std::string> conditions_;
  std::vector<Pressed> contacts_;
};

}  // namespace suture
