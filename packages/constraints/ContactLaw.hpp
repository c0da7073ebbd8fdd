#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/Registry.hpp>
#include <suture/constraints/ContactState.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// Forces of a pair and how far it is from where it should be, both in the pair's frame: component 0 along the normal, the others along
/// the tangents (PairFrame). A solver's guess of what its law allows.
struct ContactTrial {
  Point force{0, 0, 0};     ///< that side B feels; > 0 compressive along the normal [force]
  Point jump{0, 0, 0};      ///< penetration and slip u_A - u_B, times a stiffness of the pair [force]
  Point place{0, 0, 0};     ///< position of the node that carries the pair
  double size = 0.0;        ///< tributary length or area of the pair: a stress times it is a force
  bool normalOnly = false;  ///< nothing but the normal components is known: the law is asked whether the pair is closed
  bool slipped = false;     ///< the pair has slid in an earlier load step
};

/// The law of a contact, of one pair at a time: which forces it allows, and the state that goes with them. Made by name,
/// `Contact/<name>/Law`; a user adds his own through Registry<ContactLaw>. With the trial force t = force + jump, the state is that of the
/// projection of t onto the allowed forces: the optimality conditions of contact as one equation (Alart and Curnier 1991). The tangential
/// force of a pair that slips is (bound + friction normal force) direction: where a law is not linear in the normal force, its tangent.
///
/// A law of a user's own: derive, and write the do... functions. Local.
class ContactLaw {
 public:
  /// Takes the constants and functions of the scene before the law's own parameters.
  using Maker = std::function<std::unique_ptr<ContactLaw>(const Constants&, const Parameters&)>;
  static const char* kind() { return "contact law"; }
  virtual ~ContactLaw() = default;

  /// Rows of a pair's frame that the law restricts: 1, the normal one, or `dimension`.
  int rows(int dimension) const { return doRestrictsSliding() ? dimension : 1; }
  /// False for a law that never opens a pair: its rows are equations.
  bool separates() const { return doSeparates(); }
  /// True for a law that takes the sides as they stand: what lies between them is no gap.
  bool ignoresGap() const { return doIgnoresGap(); }

  /// State of a pair at a trial. \param now  the state that it has: kept where the trial decides nothing
  /// \throws NumericalError  the trial is not finite; InternalError  the law answers with a direction or a bound that no state has
  ContactState project(const ContactTrial& trial, const ContactState& now) const;

  /// State of a pair that is pressed together and has not slid: what a set of closed pairs means.
  ContactState pressed() const;

 protected:
  virtual bool doRestrictsSliding() const = 0;
  virtual bool doSeparates() const { return true; }
  virtual bool doIgnoresGap() const { return false; }
  virtual ContactState doProject(const ContactTrial& trial, const ContactState& now) const = 0;
};

/// Signorini's law without friction: no tension, no penetration, free sliding. XML `Law` = `Frictionless` (default).
class Frictionless : public ContactLaw {
 public:
  static constexpr const char* kName = "Frictionless";

 protected:
  bool doRestrictsSliding() const override { return false; }
  ContactState doProject(const ContactTrial& trial, const ContactState& now) const override;
};

void registerBuiltIns(Registry<ContactLaw>& registry);

/// The laws of a scene's contacts, by ContactPair::line; contacts beyond the list are frictionless. The same on all ranks.
class ContactLaws {
 public:
  ContactLaws() = default;
  explicit ContactLaws(std::vector<std::shared_ptr<const ContactLaw>> laws) : laws_(std::move(laws)) {}
  /// Those that the scene's list `Contact` names. \throws InputError  the parameters of a law
  explicit ContactLaws(const Parameters& contact, const Constants& constants = {});

  const ContactLaw& of(int line) const;
  int size() const { return static_cast<int>(laws_.size()); }
  /// True if some contact restricts sliding.
  bool restrictSliding() const;

 private:
  std::vector<std::shared_ptr<const ContactLaw>> laws_;
};

}  // namespace suture
