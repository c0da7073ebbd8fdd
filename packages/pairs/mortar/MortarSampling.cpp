#include <suture/pairs/mortar/FaceSampling.hpp>
#include <suture/pairs/mortar/LineSampling.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>

namespace suture {

std::unique_ptr<MortarSampling> samplingOf(const Mesh& mesh, const ContactSurface& contact, bool onA) {
  if (mesh.dimension == 2) return std::make_unique<LineSampling>(mesh, contact, onA);
  return std::make_unique<FaceSampling>(mesh, contact, onA);
}

}  // namespace suture
