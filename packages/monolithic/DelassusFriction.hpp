#pragma once
#include <suture/monolithic/Delassus.hpp>
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// Linear problems of given pair states on the Delassus matrix H of all rows. With forces f of the rows and amplitudes a of the rigid
/// motions, and jumps w = h - H f + G a:
///     w = 0 in the rows that a state holds,    f_t = (bound + friction f_n) direction + transverse spring where a pair slips,
///     G^T f = work.
/// Dense, by elimination. Rows that repeat each other share their force. Local.
class DelassusFriction : public LinearContactSolver {
 public:
  /// Both must outlive it. \param step  called after each solve
  DelassusFriction(const CondensedContact& problem, const Delassus& delassus, std::function<void(const ActiveSetStep&)> step);

  ContactAnswer solve(const PairStates& states, double tolerance) override;
  void move(const Vector& motion) override { amplitude_ += free_ * motion; }
  Vector motion() const override { return free_.transpose() * amplitude_; }

  /// Pairs as a rigid-body model, their laws by RigidBodyModel::Pairs::line, and their sites.
  const RigidBodyModel& rigid() const { return *rigid_; }
  const ContactLaws& laws() const { return laws_; }
  const std::vector<FrictionSite>& sites() const { return sites_; }

  /// Amplitudes a of a motion of rigid().
  Vector amplitudesOf(const Vector& motion) const { return free_ * motion; }

  const Vector& force() const { return force_; }          ///< forces of all rows in the last solution
  const Vector& amplitude() const { return amplitude_; }  ///< a in the last solution

 private:
  struct System {
    Matrix forces, tests;  // rows x unknowns: forces of unit unknowns, and the combinations of jumps that vanish
    Vector given;          // forces that do not depend on unknowns
    Vector compliance;     // compliance of springs; zero for rows that are held
    std::vector<int> row;  // row of an unknown that is the force of this row alone; -1: none
  };
  System systemOf(const PairStates& states) const;
  void shareRepeated(const System& system, const Vector& scale, Matrix& scaled) const;
  ContactAnswer answerOf(const PairStates& states) const;
  void report(const PairStates& states, const ContactAnswer& answer);

  const CondensedContact& problem_;
  const Delassus& delassus_;
  const std::function<void(const ActiveSetStep&)> step_;
  ContactLaws laws_;
  std::vector<FrictionSite> sites_;
  Vector local_;  // compliance of each row's own elements, which is independent of soft springs under a body [length / force]
  Matrix free_;   // motions that pairs that never open leave free
  std::unique_ptr<RigidBodyModel> rigid_;
  Vector force_, amplitude_;
  PairStates last_;
};

}  // namespace suture
