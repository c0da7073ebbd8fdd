#include <suture/precond/coarse/CoarseSpace.hpp>

namespace suture {

namespace {
template <typename T>
void addSpace(Registry<CoarseSpace>& registry, const char* name, const char* doc) {
  registry.add(name, Schema(doc), [](const Parameters&) { return std::make_unique<T>(); });
}
}  // namespace

void registerBuiltIns(Registry<CoarseSpace>& registry) {
  addSpace<NoCoarseSpace>(registry, "None", "No coarse problem.");
  addSpace<KernelCoarseSpace>(registry, "Kernels", "Kernels of the Schur complements of subdomains and bilateral groups, the paper's Z.");
  addSpace<RigidModeCoarseSpace>(registry, "Rigid Modes",
                                 "All rigid-body modes of every subdomain, floating or not, including members of groups.");
}

}  // namespace suture
