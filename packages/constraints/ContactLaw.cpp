#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/ContactLaw.hpp>

#include <Teuchos_ParameterList.hpp>

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
    throw InternalError("a contact law answers with a bound below zero, or with a direction that is no unit vector of a pair that slips");
  return next;
}

ContactState ContactLaw::pressed() const {
  ContactTrial trial;
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
               [](const Parameters&) { return std::make_unique<Frictionless>(); });
}

ContactLaws::ContactLaws(const Parameters& contact) {
  for (const std::string& name : sublistNames(contact)) laws_.push_back(makeStrategy<ContactLaw>(contact.sublist(name), "Law"));
}

const ContactLaw& ContactLaws::of(int line) const {
  static const Frictionless frictionless;
  return line >= 0 && line < size() ? *laws_[line] : frictionless;
}

}  // namespace suture
