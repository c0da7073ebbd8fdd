// The reference within a distributed run: rank 0 solves, the others listen and get their part.
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/reference/Monolithic.hpp>
#include <suture/reference/MonolithicScene.hpp>
#include <suture/solver/Decomposition.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

namespace suture {

namespace {

/// Nodal values of this rank's subdomains, asked of rank 0 by the mesh's numbers.
std::vector<Vector> scatterToSubdomains(const Comm& comm, const Vector& whole, int dimension, const std::vector<SubdomainMesh>& meshes) {
  Packer asked;
  for (const SubdomainMesh& mesh : meshes) asked.put(mesh.globalNodes);
  std::vector<std::string> answers(comm.getSize());
  const std::vector<std::string> questions = gatherOnRoot(comm, asked.bytes());
  collectivelyOnRoot(comm, "distributing the displacements", [&] {
    for (std::size_t rank = 0; rank < questions.size(); ++rank) {
      Packer answer;
      Unpacker question(questions[rank]);
      while (!question.done()) {
        std::vector<double> values;
        for (GlobalId node : question.get<std::vector<GlobalId>>())
          for (int k = 0; k < dimension; ++k) values.push_back(whole(node * dimension + k));
        answer.put(values);
      }
      answers[rank] = answer.bytes();
    }
  });
  Unpacker mine(scatterFromRoot(comm, answers));
  std::vector<Vector> displacement;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto values = mine.get<std::vector<double>>();
    displacement.emplace_back(Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size())));
  }
  return displacement;
}

/// What all ranks must know of rank 0's answer.
struct Figures {
  bool converged;
  int iterations;
  double residual, energy;
};

}  // namespace

std::shared_ptr<const MonolithicSystem> assembleMonolithic(const Comm& comm, const Mesh& mesh, const Constraints& constraints,
                                                           const ElasticModel& model) {
  std::shared_ptr<const MonolithicSystem> system;
  collectivelyOnRoot(comm, "assembling the monolithic system",
                     [&] { system = std::make_shared<MonolithicSystem>(mesh, constraints, model); });
  return system;
}

Solution solveMonolithicScene(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const MonolithicSystem* system,
                              const std::vector<SubdomainMesh>& meshes, const Parameters& scene, Monitor& monitor) {
  MonolithicResult result;
  collectivelyOnRoot(comm, "the monolithic solver", [&] {
    const Parameters& own = scene.sublist("Outer Solver");
    MonolithicOptions options;
    options.maximumIterations = own.get<int>("Maximum Iterations");
    if (own.sublist(kMonolithic).get<std::string>("Ordering") == "METIS") options.ordering = CholmodOptions::Ordering::Metis;
    Monitor later;  // the rows are told on all ranks below
    result = solveMonolithic(mesh, constraints, *system, options, later);
  });
  Packer packer;
  packer.put(Figures{result.converged, result.iterations, result.residual, result.energy});
  packer.put(result.rows);
  packer.put(result.failure);
  packer.put(constraints.pairs.size());
  packer.put(mesh.dimension);
  Unpacker unpacker(broadcast(comm, packer.bytes()));
  const auto figures = unpacker.get<Figures>();
  for (const OuterRow& row : unpacker.get<std::vector<OuterRow>>()) monitor.outer(row);

  Solution solution;
  solution.converged = figures.converged;
  solution.failure = unpacker.get<std::string>();
  if (unpacker.get<std::size_t>() > 0) solution.outerSolver = kMonolithic;
  solution.auxiliary.contact = !solution.outerSolver.empty();
  solution.outerIterations = figures.iterations;
  solution.residual = figures.residual;
  solution.energy = figures.energy;
  solution.displacement = scatterToSubdomains(comm, result.displacement, unpacker.get<int>(), meshes);
  std::vector<PairForce> forces;
  for (const PairResult& pair : result.pairs) forces.push_back({pair.id, pair.state, pair.force});
  std::vector<const SubdomainMesh*> pointers;
  for (const SubdomainMesh& mesh : meshes) pointers.push_back(&mesh);
  solution.pairs = pairResults(comm, pointers, solution.displacement, forces);
  return solution;
}

}  // namespace suture
