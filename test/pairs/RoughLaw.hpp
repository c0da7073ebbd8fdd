#pragma once
#include <suture/pairs/ContactLaw.hpp>

/// A law with rows along the tangents, for tests: pressed pairs stick.
class RoughLaw : public suture::ContactLaw {
 protected:
  bool doRestrictsSliding() const override { return true; }
  suture::ContactState doProject(const suture::ContactTrial& trial, const suture::ContactState& now) const override {
    const double normal = trial.force[0] + trial.jump[0];
    if (normal == 0.0) return now;
    return normal > 0.0 ? suture::PairStatus::Stick : suture::PairStatus::Open;
  }
};
