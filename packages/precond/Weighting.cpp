#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/precond/DeluxeWeighting.hpp>
#include <suture/precond/Weighting.hpp>

#include <Tpetra_Map.hpp>

#include <sstream>

namespace suture {

void Weighting::setup(const InterfaceSpace& space, const LocalProblems& locals) { doSetup(space, locals); }

void DiagonalWeighting::doSetup(const InterfaceSpace& space, const LocalProblems& locals) {
  weights_.assign(locals.size(), Vector());
  Matrix sum = Matrix::Zero(space.overlapSize(), 1);
  collectively(*space.comm(), "weighting the interface", [&] {
    for (std::size_t i = 0; i < locals.size(); ++i)
      if (locals[i]) {
        weights_[i] = density(*locals[i]);
        space.coupling(static_cast<int>(i)).addTransposed(weights_[i], sum);
      }
  });
  space.sumDensities(sum);
  // An unknown that is expressed by several others, or by none, has no weight; the expressing unknowns carry it.
  const auto weightless = [&](int place) { return space.relation(place) && space.relation(place)->others.size() != 1; };
  collectively(*space.comm(), "weighting the interface", [&] {
    for (int k = 0; k < space.overlapSize(); ++k)
      if (!(sum(k, 0) > 0.0) && !weightless(k)) {
        throw NumericalError("the interface unknown at " + placeText(space.point(k), space.dimension()) +
                             " has no positive weight: no local problem that takes part holds it");
      }
  });
  for (std::size_t i = 0; i < locals.size(); ++i)
    if (locals[i]) {
      const std::vector<int>& places = space.coupling(static_cast<int>(i)).columns();
      for (std::size_t k = 0; k < places.size(); ++k)
        weights_[i](static_cast<int>(k)) = weightless(places[k]) ? 0.0 : weights_[i](static_cast<int>(k)) / sum(places[k], 0);
    }
}

namespace {
template <typename T>
void addWeighting(Registry<Weighting>& registry, const char* name, const char* doc) {
  registry.add(name, Schema(doc), [](const Parameters&) { return std::make_unique<T>(); });
}
}  // namespace

void registerBuiltIns(Registry<Weighting>& registry) {
  addWeighting<DeluxeWeighting>(registry, "Deluxe",
                                "By the dense Schur complements on each edge and face; elsewhere by the diagonal of the stiffness.");
  addWeighting<MultiplicityWeighting>(registry, "Multiplicity", "One over the number of sharing subdomains; not robust for jumps.");
  addWeighting<YoungWeighting>(registry, "Young", "By Young's modulus, as in the paper; robust for jumps aligned with subdomains.");
  addWeighting<StiffnessDiagonalWeighting>(registry, "Stiffness Diagonal",
                                           "By the diagonal of the stiffness matrix; follows jumps and element sizes.");
}

}  // namespace suture
