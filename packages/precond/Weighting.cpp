#include <suture/base/Collective.hpp>
#include <suture/precond/Weighting.hpp>

#include <Tpetra_Map.hpp>

#include <sstream>

namespace suture {

void Weighting::setup(const InterfaceSpace& space, const LocalProblems& locals) { doSetup(space, locals); }

void DiagonalWeighting::doSetup(const InterfaceSpace& space, const LocalProblems& locals) {
  weights_.assign(locals.size(), Vector());
  Matrix sum = Matrix::Zero(static_cast<int>(space.overlap()->getNodeNumElements()), 1);
  for (std::size_t i = 0; i < locals.size(); ++i)
    if (locals[i]) {
      weights_[i] = density(*locals[i]);
      space.coupling(static_cast<int>(i)).addTransposed(weights_[i], sum);
    }
  space.sum(sum);
  collectively(*space.comm(), "weighting the interface", [&] {
    for (Eigen::Index k = 0; k < sum.rows(); ++k)
      if (!(sum(k, 0) > 0.0)) {
        const Point& p = space.point(static_cast<int>(k));
        std::ostringstream text;
        text << "the interface unknown at (" << p[0] << ", " << p[1]
             << ") has no positive weight: no local problem that takes part holds it";
        throw NumericalError(text.str());
      }
  });
  for (std::size_t i = 0; i < locals.size(); ++i)
    if (locals[i]) {
      Matrix total(weights_[i].size(), 1);
      space.coupling(static_cast<int>(i)).restrictTo(sum, total);
      weights_[i] = weights_[i].cwiseQuotient(total.col(0));
    }
}

namespace {
template <typename T>
void addWeighting(Registry<Weighting>& registry, const char* name, const char* doc) {
  registry.add(name, Schema(doc), [](const Parameters&) { return std::make_unique<T>(); });
}
}  // namespace

void registerBuiltIns(Registry<Weighting>& registry) {
  addWeighting<MultiplicityWeighting>(registry, "Multiplicity", "One over the number of subdomains that meet; not robust for jumps.");
  addWeighting<YoungWeighting>(registry, "Young", "By Young's modulus, as in the paper; robust for jumps aligned with subdomains.");
  addWeighting<StiffnessDiagonalWeighting>(registry, "Stiffness Diagonal",
                                           "By the diagonal of the stiffness matrix; follows jumps and element sizes.");
}

}  // namespace suture
