#include <suture/base/AgreedDimension.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/monolithic/Reference.hpp>
#include <suture/partition/NodalValues.hpp>
#include <suture/solver/BalanceForces.hpp>
#include <suture/solver/MemoryEstimate.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

namespace suture {

namespace {

/// Figures of the result on rank 0 that all ranks need.
struct Figures {
  bool converged;
  int iterations;
  double residual, energy;
};

constexpr const char* kName = "Monolithic";

}  // namespace

Schema Reference::schema() {
  return Schema(
             "The whole system on one rank, by one factorisation with the contact unknowns last, and the same search for contact states as "
             "the other methods; for small scenes and for comparison.")
      .oneOf("Ordering", "Automatic", {"AMD", "Automatic", "METIS"},
             "Order of the unknowns that are not in contact: METIS gives less fill than AMD but takes longer. Automatic: METIS in 3D.");
}

Reference::Reference(const Parameters& settings, const Parameters& own) {
  options_.maximumIterations = settings.sublist("Outer Solver").get<int>("Maximum Iterations");
  options_.ordering = CholmodOptions::orderingNamed(own.get<std::string>("Ordering"));
  options_.balances = wantsErrorBound(settings);
}

double Reference::megabytes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, GlobalId unknowns) const {
  const int dimension = agreedDimensionOf(comm, meshes);
  return comm.getRank() == 0 ? estimatedMonolithicMegabytes(unknowns, dimension) : programMegabytes();
}

void Reference::doAssemble(Subdomains) {
  collectivelyOnRoot(*scene().comm, "assembling the monolithic system",
                     [&] { system_ = std::make_unique<const MonolithicSystem>(scene().mesh, scene().constraints, scene().model); });
}

/// States of all pairs of the whole mesh; pressed where the start has none. On rank 0.
std::vector<ContactState> Reference::statesOf(const Start& start) const {
  std::vector<ContactState> states;
  for (const ContactPair& pair : scene().constraints.pairs) {
    const auto found = start.status.find(pair.id);
    states.push_back(found == start.status.end() ? ContactState(scene().laws.of(pair.line).pressed()) : found->second);
  }
  return states;
}

Solution Reference::doSolve(Monitor& monitor, const Start* start, const Keep&) {
  const Comm& comm = *scene().comm;
  MonolithicResult result;
  collectivelyOnRoot(comm, "the monolithic solver", [&] {
    Monitor later;  // the rows are reported on all ranks below
    MonolithicOptions options = options_;
    if (start && takesStart()) options.start = statesOf(*start);
    result = solveMonolithic(scene().mesh, scene().constraints, *system_, options, later);
  });
  Packer packer;
  packer.put(Figures{result.converged, result.iterations, result.residual, result.energy});
  packer.put(result.rows);
  packer.put(result.failure);
  packer.put(scene().constraints.pairs.size());
  Unpacker unpacker(broadcast(comm, packer.bytes()));
  const auto figures = unpacker.get<Figures>();
  for (const OuterRow& row : unpacker.get<std::vector<OuterRow>>()) monitor.outer(row);

  Solution solution;
  solution.converged = figures.converged;
  solution.failure = unpacker.get<std::string>();
  if (unpacker.get<std::size_t>() > 0) solution.outerSolver = kName;
  solution.auxiliary.contact = !solution.outerSolver.empty();
  solution.iterations = figures.iterations;
  solution.residual = figures.residual;
  solution.energy = figures.energy;
  solution.displacement = scatterNodes(comm, scene().meshes, result.displacement, scene().mesh.dimension);
  std::vector<const SubdomainMesh*> pointers;
  for (const SubdomainMesh& mesh : scene().meshes) pointers.push_back(&mesh);
  solution.pairs = pairResults(comm, pointers, solution.displacement, result.forces);
  if (options_.balances) addBalancing(std::move(result.forces), solution);
  return solution;
}

/// The forces of a refined solution balance: there is nothing to correct. \param forces  on rank 0
void Reference::addBalancing(std::vector<PairForce> forces, Solution& solution) const {
  if (!solution.converged) {
    solution.notBalanced = "the run did not converge";
    return;
  }
  broadcast(*scene().comm, forces);
  std::map<int, PairForce> all;
  for (const PairForce& pair : forces) all[pair.id] = pair;
  Balancing& balancing = solution.balancing.emplace();
  balancing.correction.resize(scene().meshes.size());
  for (const SubdomainMesh& mesh : scene().meshes)
    for (const ContactRow& row : mesh.contactRows) balancing.forces[row.pair.id] = all.at(row.pair.id);
}

namespace {
const Registration<Method> registration(kName, Reference::schema(), [](const Parameters& settings, const Parameters& own) {
  return std::make_unique<Reference>(settings, own);
});
}  // namespace

}  // namespace suture
