#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/pairs/Overclosure.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

bool finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

}  // namespace

ContactState ContactLaw::project(const ContactTrial& trial, const ContactState& now) const {
  if (!finite(trial.force) || !finite(trial.jump)) throw NumericalError("a contact law was given a force or a gap that is not finite");
  const ContactState next = doProject(trial, now);
  const double length = norm(next.direction);
  const bool slides = next.status == PairStatus::Slip;
  if (!(next.bound >= 0.0) || !(length == 0.0 || (slides && std::abs(length - 1.0) < 1e-12)))
    throw InternalError("a contact law returned a negative bound, or a direction that is not a unit vector of a slipping pair");
  return next;
}

ContactState ContactLaw::pressed() const {
  ContactTrial trial;
  trial.normalOnly = true;
  trial.force[0] = 1.0;
  return project(trial, {});
}

ContactState Frictionless::doProject(const ContactTrial& trial, const ContactState& now) const {
  const double normal = trial.force[0] + trial.jump[0];
  if (normal == 0.0) return now;
  return normal > 0.0 ? PairStatus::Slip : PairStatus::Open;
}

void registerBuiltIns(Registry<ContactLaw>& registry) {
  registry.add(Frictionless::kName, Schema("No tension, no penetration, free sliding."),
               [](const Constants&, const Parameters&) { return std::make_unique<Frictionless>(); });
  registry.add(Tresca::kName, Tresca::schema(),
               [](const Constants& constants, const Parameters& own) { return std::make_unique<Tresca>(constants, own); });
  registry.add(Coulomb::kName, Coulomb::schema(),
               [](const Constants& constants, const Parameters& own) { return std::make_unique<Coulomb>(constants, own); });
  registry.add(Tied::kName, Schema("Sides glued in their drawn position, also with non-matching meshes: no jump of displacements."),
               [](const Constants&, const Parameters&) { return std::make_unique<Tied>(); });
  registry.add(NoSeparation::kName, Schema("Free sliding of sides that never separate: no gap, tension allowed."),
               [](const Constants&, const Parameters&) { return std::make_unique<NoSeparation>(); });
}

namespace {

/// Law of a further spring of a softened contact: friction in proportion to its own pressure; stresses that do not depend on the pressure
/// belong to the first spring.
std::shared_ptr<const ContactLaw> lawOfFurtherSpring(const Parameters& entry, const Constants& constants) {
  if (entry.get<std::string>("Law") != Coulomb::kName) return std::make_shared<Frictionless>();
  Parameters own = entry.sublist(Coulomb::kName);
  own.set("Cohesion", std::string("0"));
  return std::make_shared<Coulomb>(constants, own);
}

}  // namespace

ContactLaws::ContactLaws(const Parameters& contact, const Constants& constants) {
  for (const ContactLine& line : contactLines(contact)) {
    const Parameters& own = contact.sublist(line.name);
    laws_.push_back(line.spring == 0 ? makeStrategy<ContactLaw>(own, "Law", constants) : lawOfFurtherSpring(own, constants));
  }
}

bool ContactLaws::restrictSliding() const {
  return std::any_of(laws_.begin(), laws_.end(), [](const auto& law) { return law->rows(2) > 1; });
}

const ContactLaw& ContactLaws::of(int line) const {
  static const Frictionless frictionless;
  return line >= 0 && line < size() ? *laws_[line] : frictionless;
}

}  // namespace suture
