#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/solver/Decomposition.hpp>
#include <suture/solver/MemoryEstimate.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/SolverSchema.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

double Method::megabytes(const Comm&, const std::vector<SubdomainMesh>& meshes, GlobalId) const { return estimatedMegabytes(meshes); }

namespace {

// Methods without friction cannot decide which pairs stick.
void checkLaws(const Method& method, const CutScene& scene) {
  Problems problems;
  for (int line = 0; line < scene.laws.size(); ++line) {
    const ContactLaw& law = scene.laws.of(line);
    if ((law.rows(2) == 1 && law.separates()) || method.knowsFriction(scene.settings)) continue;
    problems.add(
        "Contact/" + scene.contacts.at(line) + "/Law",
        std::string(law.separates() ? "restricts sliding" : "never opens") +
            ", which the outer solver or the formulation of this scene does not support; expected Formulation = Contact On The Interface "
            "with Outer Solver/Type = Active Set, Condensed Groups with Semismooth Newton, Outer Solver/Type = Monolithic, or the law " +
            Frictionless::kName);
  }
  problems.throwIfAny();
}

}  // namespace

void Method::prepare(const CutScene& scene, Timers& timers) {
  if (scene_) throw InternalError("prepare() of a method is called twice");
  if (needsWholeMesh())
    collectivelyOnRoot(*scene.comm, "preparing a method", [&] {
      if (scene.mesh.elements() == 0) throw InternalError("a method needs the whole mesh, but rank 0 does not have it");
    });
  checkLaws(*this, scene);
  scene_.emplace(scene);
  timed(timers, "assemble",
        [&] { doAssemble(makeSubdomains(*scene.comm, scene.meshes, scene.model, scene.kinds, scene.needsLaw || needsLaw())); });
  timed(timers, "factor", [&] { doFactor(); });
  isPrepared_ = true;
}

Solution Method::solve(Monitor& monitor, Timers& timers, const Start* start, const Keep& keep) {
  if (!isPrepared_) throw InternalError("solve() of a method before prepare()");
  return timed(timers, "solve", [&] { return doSolve(monitor, start, keep); });
}

void Method::reload(Timers& timers) {
  if (!isPrepared_ || !reloads()) throw InternalError("reload() of a method that does not support new loads");
  timed(timers, "load", [&] { doReload(); });
}

bool Method::rearrange(Timers& timers) {
  if (!isPrepared_) throw InternalError("rearrange() of a method before prepare()");
  return timed(timers, "load", [&] { return doRearrange(); });
}

const Subdomains& Method::subdomains() const {
  static const Subdomains none;
  return none;
}

std::unique_ptr<Method> makeMethod(const Parameters& settings, bool contact) {
  const Parameters& outer = settings.sublist("Outer Solver");
  if (Registry<Method>::instance().has(outer.get<std::string>("Type"))) return makeStrategy<Method>(outer, "Type", settings);
  if (contact) checkCombination(settings);
  return std::make_unique<Decomposition>();
}

}  // namespace suture
