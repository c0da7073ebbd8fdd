#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/simulation/accuracy/LevelError.hpp>

#include <algorithm>
#include <map>

namespace suture {

LevelError levelError(const Solution& solution) {
  if (solution.bound && solution.bound->exists) {
    const ErrorBound& bound = *solution.bound;
    return {bound.total, bound.solutionNorm, bound.strict, bound.ofElements};
  }
  if (!solution.discretisation) throw InternalError("the solution has no estimate of its error");
  const DiscretisationError& estimate = *solution.discretisation;
  return {estimate.energyNorm, estimate.solutionNorm, false, estimate.ofElements};
}

std::vector<double> valuesOnRoot(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& ofElements,
                                 int elements) {
  Packer packer;
  std::vector<GlobalId> numbers;
  std::vector<double> mine;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int e = 0; e < meshes[i].elements(); ++e) {
      numbers.push_back(meshes[i].globalElements[static_cast<std::size_t>(e)]);
      mine.push_back(ofElements[i][e]);
    }
  packer.put(numbers);
  packer.put(mine);
  std::vector<double> all(static_cast<std::size_t>(elements), 0.0);
  for (std::string& bytes : gatherOnRoot(comm, packer.bytes())) {
    Unpacker unpacker(std::move(bytes));
    const auto places = unpacker.get<std::vector<GlobalId>>();
    const auto values = unpacker.get<std::vector<double>>();
    for (std::size_t k = 0; k < places.size(); ++k)
      if (places[k] < elements) all[static_cast<std::size_t>(places[k])] = values[k];
  }
  return all;
}

std::vector<FacingNodes> facingNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Mesh& whole,
                                     const std::vector<PairResult>& results) {
  std::map<int, ContactPair> pairs;
  for (const SubdomainMesh& mesh : meshes)
    for (const ContactRow& row : mesh.contactRows) pairs.emplace(row.pair.id, row.pair);
  Packer packer;
  std::vector<ContactPair> mine;
  for (const auto& [id, pair] : pairs) mine.push_back(pair);
  packer.put(mine);
  std::vector<FacingNodes> all;
  std::vector<std::string> gathered = gatherOnRoot(comm, packer.bytes());
  if (comm.getRank() != 0) return all;
  const std::map<int, int> under = nodesUnderCoatings(whole);
  const auto inner = [&](int node) {
    const auto found = under.find(node);
    return found == under.end() ? node : found->second;
  };
  std::map<int, double> slides;
  for (const PairResult& result : results) slides[result.id] = norm(result.slip);
  pairs.clear();
  for (std::string& bytes : gathered)
    for (const ContactPair& pair : Unpacker(std::move(bytes)).get<std::vector<ContactPair>>()) pairs.emplace(pair.id, pair);
  for (const auto& [id, pair] : pairs)
    for (std::size_t k = 1; k < pair.ends.size(); ++k) {
      const int a = inner(pair.ends.front().node), b = inner(pair.ends[k].node);
      const Point jump = minus(whole.point(b), whole.point(a));
      all.push_back({a, b, norm(minus(jump, scaled(dot(jump, pair.normal), pair.normal))), slides[id]});
    }
  return all;
}

}  // namespace suture
