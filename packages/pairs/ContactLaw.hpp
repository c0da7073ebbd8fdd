#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/Registry.hpp>
#include <suture/pairs/ContactState.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace suture {

/// Trial forces of a pair and its deviation from the constraints, in the pair's frame: component 0 along the normal, the others along the
/// tangents (PairFrame). The law projects the trial onto the allowed forces.
struct ContactTrial {
  Point force{0, 0, 0};     ///< force on side B; > 0 compressive along the normal [force]
  Point jump{0, 0, 0};      ///< penetration and slip u_A - u_B, times a stiffness of the pair [force]
  Point place{0, 0, 0};     ///< position of the node that carries the pair
  double size = 0.0;        ///< tributary length or area of the pair: converts stress to force
  bool normalOnly = false;  ///< only the normal components are known: the law decides whether the pair is closed
  bool slipped = false;     ///< the pair has slid in an earlier load step
};

/// Contact law for a single pair: the forces that it allows, and the corresponding state. Made by name, `Contact/<name>/Law`; users add
/// laws through Registry<ContactLaw>. With the trial force t = force + jump, the state is that of the projection of t onto the allowed
/// forces: the optimality conditions of contact as one equation (Alart and Curnier 1991). The tangential force of a pair that slips is
/// (bound + friction normal force) direction: for a law that is not linear in the normal force, the tangent of the law.
///
/// To write a law: derive, and implement the do... functions. Local.
class ContactLaw {
 public:
  /// Arguments: the constants and functions of the scene, then the law's own parameters.
  using Maker = std::function<std::unique_ptr<ContactLaw>(const Constants&, const Parameters&)>;
  static const char* kind() { return "contact law"; }
  virtual ~ContactLaw() = default;

  /// Number of rows of a pair's frame that the law restricts: 1, the normal one, or `dimension`.
  int rows(int dimension) const { return doRestrictsSliding() ? dimension : 1; }
  /// False for a law that never opens a pair: its rows are equalities.
  bool separates() const { return doSeparates(); }
  /// True for a law that ignores the initial distance of the sides: the gap is zero.
  bool ignoresGap() const { return doIgnoresGap(); }

  /// State of a pair at a trial. \param now  current state, kept if the trial does not decide
  /// \throws NumericalError  the trial is not finite; InternalError  the law returns an invalid direction or bound
  ContactState project(const ContactTrial& trial, const ContactState& now) const;

  /// State of a pair that is pressed together and has not slid: the state of the pairs in a set of closed pairs.
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

/// Laws of a scene's contacts, by ContactPair::line; contacts beyond the list are frictionless. The same on all ranks.
class ContactLaws {
 public:
  ContactLaws() = default;
  explicit ContactLaws(std::vector<std::shared_ptr<const ContactLaw>> laws) : laws_(std::move(laws)) {}
  /// Laws named in the scene's list `Contact`, by contactLines(). \throws InputError  the parameters of a law
  explicit ContactLaws(const Parameters& contact, const Constants& constants = {});

  const ContactLaw& of(int line) const;
  int size() const { return static_cast<int>(laws_.size()); }
  /// True if any contact restricts sliding.
  bool restrictSliding() const;

 private:
  std::vector<std::shared_ptr<const ContactLaw>> laws_;
};

}  // namespace suture
