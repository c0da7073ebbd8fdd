#include <solver/ContactMethods.hpp>

namespace suture::blocks {

std::function<Teuchos::RCP<Preconditioner>()> preconditioner(const std::string& name) {
  return [list = resolved("Preconditioner", preconditionerSchema(), {"Type=" + name})] { return makePreconditioner(list); };
}

OuterResult solveWith(const std::string& method, const InterfaceProblem& problem, double tolerance,
                      const std::function<Teuchos::RCP<Preconditioner>()>& makePreconditioner, const InterfaceState* start) {
  OuterSettings settings;
  settings.tolerance = tolerance;
  settings.preconditioner = makePreconditioner;
  Monitor silent;
  Parameters own;
  own.set("Inner Tolerance", method == "Active Set" ? 1e-3 : 1e-2);
  return Registry<OuterSolver>::instance().make(method, own)->solve(problem, settings, silent, start);
}

OuterResult solveWith(const std::string& method, const InterfaceProblem& problem, double tolerance, const std::string& preconditionerName,
                      const InterfaceState* start) {
  return solveWith(method, problem, tolerance, preconditioner(preconditionerName), start);
}

Distance distance(const Blocks& all, const InterfaceProblem::Recovered& found, const MonolithicResult& reference) {
  double mine[3] = {0.0, 0.0, 0.0}, result[3], largestForce = 1e-300;
  for (std::size_t s = 0; s < all.subdomains.size(); ++s) {
    const Vector u = all.subdomains[s]->cartesian(found.freeValues[s]);
    for (int node = 0; node < all.meshes[s].nodes(); ++node)
      for (int k = 0; k < 2; ++k)
        mine[0] = std::max(mine[0], std::abs(u(2 * node + k) - reference.displacement(2 * all.meshes[s].globalNodes[node] + k)));
  }
  for (const PairResult& pair : reference.pairs) largestForce = std::max(largestForce, std::abs(pair.force));
  for (const PairForce& pair : found.pairs) {
    mine[1] = std::max(mine[1], std::abs(pair.force - reference.pairs[pair.id].force));
    mine[2] += pair.state != reference.pairs[pair.id].state;
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, 2, mine, result);
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 1, mine + 2, result + 2);
  return {result[0] / reference.displacement.lpNorm<Eigen::Infinity>(), result[1] / largestForce, int(result[2])};
}

}  // namespace suture::blocks
