#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/condensed/GroupMemory.hpp>
#include <suture/interface/Formulation.hpp>

#include <Teuchos_ParameterList.hpp>

#include <iomanip>
#include <map>
#include <sstream>

namespace suture {

namespace {

constexpr const char* kMemoryLimit = "Memory Limit";
constexpr const char* kGroup = "Contact Group";

class CondensedGroups : public Formulation {
 public:
  static Schema schema() {
    return Schema("Formulation of the paper: contact is condensed in groups of subdomains, each group on one rank.")
        .real(
            kMemoryLimit, 4096.0,
            "Memory for the factors of one group, which are on one rank. A group with a larger estimate is refused before it is factored.",
            Range::positive(), "MB")
        .choice(kGroup, "Exact", Registry<ContactGroup>::instance().schemas(), "How a group finds its closed pairs for a given trace.");
  }
  explicit CondensedGroups(const Parameters& own) : own_(own), limit_(own.get<double>(kMemoryLimit)), path_(pathOf(own, kMemoryLimit)) {}
  bool keepsGroupsWhole() const override { return true; }
  bool hidesContact() const override { return true; }
  bool knowsFriction() const override { return true; }
  std::string outerSolver() const override { return "Semismooth Newton"; }

 protected:
  std::unique_ptr<InterfaceProblem> doMake(const CommPtr& comm, const Partition& partition,
                                           const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalAlgebra& algebra,
                                           const ContactLaws& laws) const override {
    checkMemory(*comm, partition, subdomains);
    const auto make = [&](const ContactGroup::Parts& parts) { return makeStrategy<ContactGroup>(own_, kGroup, parts); };
    return std::make_unique<CondensedProblem>(comm, partition, subdomains, algebra.solver, algebra.schur, laws, make);
  }

 private:
  /// Groups are not distributed over ranks: one that does not fit is refused before time is lost or the machine runs out of memory.
  void checkMemory(const Comm& comm, const Partition& partition, const std::vector<std::unique_ptr<Subdomain>>& subdomains) const {
    collectively(comm, "estimating the memory of the contact groups", [&] {
      std::map<int, std::vector<const Subdomain*>> membersOf;
      for (const auto& subdomain : subdomains)
        if (const int group = partition.groupOf[subdomain->mesh().id]; group >= 0) membersOf[group].push_back(subdomain.get());
      Problems problems;
      for (const auto& [group, members] : membersOf) {
        const GroupMemory memory = groupMemory(members);
        if (memory.megabytes() <= limit_) continue;
        std::ostringstream text;
        text << "contact group " << group + 1 << " of " << members.size() << " subdomains ('" << members.front()->mesh().name
             << "', ...) has " << memory.unknowns << " unknowns and " << memory.pairs
             << " pairs; factoring it, on one rank, is estimated to take " << std::fixed
             << std::setprecision(memory.megabytes() < 10 ? 2 : 0) << memory.megabytes() << " MB, more than the limit of "
             << std::defaultfloat << std::setprecision(6) << limit_
             << " MB. Raise the limit if the rank has the memory, or choose Formulation '" << Formulation::kOnTheInterface
             << "', which needs no group on one rank";
        problems.add(path_, text.str());
      }
      problems.throwIfAny();
    });
  }

  Parameters own_;
  double limit_;  // megabytes
  std::string path_;
};

const Registration<Formulation> registration("Condensed Groups", CondensedGroups::schema,
                                             [](const Parameters& own) { return std::make_unique<CondensedGroups>(own); });

}  // namespace

}  // namespace suture
