#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/partition/NodalValues.hpp>

#include <Teuchos_Comm.hpp>

#include <array>

namespace suture {

namespace {

struct NodeValue {
  GlobalId node;
  std::array<double, 3> value;
};

}  // namespace

Vector gatherNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& values, int nodes,
                   int dimension) {
  std::vector<NodeValue> mine;
  for (std::size_t s = 0; s < meshes.size(); ++s)
    for (int node = 0; node < meshes[s].nodes(); ++node) {
      if (!counts(meshes[s], node)) continue;
      NodeValue& one = mine.emplace_back(NodeValue{meshes[s].globalNodes[static_cast<std::size_t>(node)], {0, 0, 0}});
      for (int k = 0; k < dimension; ++k) one.value[static_cast<std::size_t>(k)] = values[s][Eigen::Index(node) * dimension + k];
    }
  const std::vector<NodeValue> all = joinOnRoot(comm, mine);
  if (comm.getRank() != 0) return {};
  Vector whole = Vector::Zero(Eigen::Index(nodes) * dimension);
  for (const NodeValue& one : all)
    for (int k = 0; k < dimension; ++k) whole[Eigen::Index(one.node) * dimension + k] = one.value[static_cast<std::size_t>(k)];
  return whole;
}

std::vector<Vector> scatterNodes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Vector& whole, int dimension) {
  Packer asked;
  for (const SubdomainMesh& mesh : meshes) asked.put(mesh.globalNodes);
  std::vector<std::string> answers(static_cast<std::size_t>(comm.getSize()));
  const std::vector<std::string> questions = gatherOnRoot(comm, asked.bytes());
  collectivelyOnRoot(comm, "distributing values of nodes", [&] {
    for (std::size_t rank = 0; rank < questions.size(); ++rank) {
      Packer answer;
      Unpacker question(questions[rank]);
      while (!question.done()) {
        std::vector<double> values;
        for (const GlobalId node : question.get<std::vector<GlobalId>>())
          for (int k = 0; k < dimension; ++k) values.push_back(whole[Eigen::Index(node) * dimension + k]);
        answer.put(values);
      }
      answers[rank] = answer.bytes();
    }
  });
  Unpacker mine(scatterFromRoot(comm, answers));
  std::vector<Vector> all;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto values = mine.get<std::vector<double>>();
    all.emplace_back(Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size())));
  }
  return all;
}

}  // namespace suture
