#include <corpus/CorpusRun.hpp>
#include <suture/base/Errors.hpp>
#include <suture/simulation/Stages.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <chrono>

namespace suture::corpus {

namespace {

/// Displacement of the whole mesh on all ranks; `seam` gets the largest difference at shared nodes.
Vector gathered(const Comm& comm, const Mesh& mesh, int nodes, const std::vector<SubdomainMesh>& meshes, const Solution& solution,
                double& seam) {
  const int size = 2 * nodes;
  const double none = -std::numeric_limits<double>::max();
  Vector high = Vector::Constant(size, none), low = high, highest(size), lowest(size);
  for (std::size_t s = 0; s < meshes.size(); ++s)
    for (int node = 0; node < meshes[s].nodes(); ++node)
      for (int k = 0; k < 2; ++k) {
        const double value = meshes[s].total(solution.displacement[s], 2 * node + k);
        const GlobalId at = 2 * meshes[s].globalNodes[node] + k;
        high[at] = std::max(high[at], value);
        low[at] = std::max(low[at], -value);
      }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, size, high.data(), highest.data());
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, size, low.data(), lowest.data());
  if (comm.getRank() == 0) {
    Vector largest = Vector::Zero(mesh.bodies.size());
    for (int i = 0; i < size; ++i) {
      double& own = largest[mesh.bodyOfNode[i / 2]];
      own = std::max(own, std::abs(highest[i]));
    }
    for (int i = 0; i < size; ++i) {
      const double apart = highest[i] + lowest[i], of = largest[mesh.bodyOfNode[i / 2]];
      if (!(apart <= 1e-300)) seam = std::max(seam, of > 0 ? apart / of : 1.0);
    }
  }
  return (highest - lowest) / 2;
}

void solve(const CommPtr& comm, const CorpusScene& corpusScene, const Way& way, Whole& whole, Outcome& outcome) {
  Scene scene = sceneOf(resolve(corpusScene, way.overrides()));
  scene.mesh = [&](const Comm& ranks) { return ranks.getRank() == 0 ? corpusScene.mesh : Mesh(); };
  MeshedScene meshed = read(RunContext(comm), scene);
  whole = {meshed.mesh(), meshed.constraints(), scene.model};
  const JudgedScene judged = judge(suture::solve(prepare(check(cut(std::move(meshed))))));
  const Solution& solution = judged.solution();
  outcome.ending = solution.converged ? Ending::Solved : Ending::Lost;
  outcome.reason = solution.failure;
  outcome.iterations = solution.iterations;
  outcome.pcg = solution.pcgTotal + solution.auxiliary.pcg;
  outcome.displacement = gathered(*comm, whole.mesh, corpusScene.mesh.nodes(), judged.meshes(), solution, outcome.seam);
  for (const PairResult& pair : solution.pairs) outcome.forces.push_back(pair.force);
}

}  // namespace

const std::vector<Way>& ways() {
  static const std::vector<Way> all{{"monolithic", "Contact On The Interface", "Monolithic"},
                                    {"interface", "Contact On The Interface", "Active Set"},
                                    {"groups", "Condensed Groups", "Semismooth Newton"}};
  return all;
}

Outcome run(const CommPtr& comm, const CorpusScene& scene, const Way& way, Whole& whole) {
  Outcome outcome;
  const auto start = std::chrono::steady_clock::now();
  try {
    solve(comm, scene, way, whole, outcome);
  } catch (const InputError& error) {
    outcome.ending = Ending::Refused;
    outcome.reason = error.what();
  } catch (const std::exception& error) {
    outcome.ending = Ending::Lost;
    outcome.reason = std::string("exception: ") + error.what();
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

}  // namespace suture::corpus
