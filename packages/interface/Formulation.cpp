#include <suture/base/Errors.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>
#include <suture/interface/Formulation.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

std::unique_ptr<InterfaceProblem> Formulation::make(const CommPtr& comm, const Partition& partition,
                                                    const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalAlgebra& algebra,
                                                    const ContactLaws& laws) const {
  if (keepsGroupsWhole())
    for (const std::vector<int>& group : partition.groups)
      for (const int subdomain : group)
        if (partition.rankOf[subdomain] != partition.rankOf[group.front()])
          throw InternalError("the formulation needs each contact group on one rank, but the partition spreads one over several");
  return doMake(comm, partition, subdomains, algebra, laws);
}

namespace {

class ContactOnTheInterface : public Formulation {
 public:
  static Schema schema() {
    return Schema("Closed pairs identify interface unknowns. Works for any partition and any size of contact, on any number of ranks.");
  }
  bool keepsGroupsWhole() const override { return false; }
  bool hidesContact() const override { return false; }
  bool knowsFriction() const override { return true; }
  std::string outerSolver() const override { return "Active Set"; }

 protected:
  std::unique_ptr<InterfaceProblem> doMake(const CommPtr& comm, const Partition& partition,
                                           const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalAlgebra& algebra,
                                           const ContactLaws& laws) const override {
    return std::make_unique<ContactInterfaceProblem>(comm, partition, subdomains, algebra.solver, algebra.schur, laws);
  }
};

}  // namespace

void registerBuiltIns(Registry<Formulation>& registry) {
  registry.add(Formulation::kOnTheInterface, ContactOnTheInterface::schema(),
               [](const Parameters&) { return std::make_unique<ContactOnTheInterface>(); });
}

std::unique_ptr<Formulation> formulationOf(const Parameters& settings) { return makeStrategy<Formulation>(settings, "Formulation"); }

}  // namespace suture
