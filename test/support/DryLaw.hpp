#pragma once
#include <suture/pairs/FrictionLaws.hpp>

#include <memory>

namespace suture::scenes {

/// Tresca's and Coulomb's laws in one: |t| <= cohesion + coefficient x pressure.
inline std::shared_ptr<const ContactLaw> dry(double cohesion, double coefficient) {
  return std::make_shared<DryFriction>(Expression([cohesion](const Point&) { return cohesion; }),
                                       Expression([coefficient](const Point&) { return coefficient; }));
}

}  // namespace suture::scenes
