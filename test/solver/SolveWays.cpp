#include <solver/SolveWays.hpp>

#include <Eigen/Dense>

namespace suture::blocks {

const std::vector<std::string>& ways() {
  static const std::vector<std::string> all{"Active Set", "Semismooth Newton", "Monolithic"};
  return all;
}

Parameters defaultsOf(const Scene& scene, const std::string& way, std::vector<std::string> settings) {
  Schema schema;
  addSolverParameters(schema);
  schema.list("Bodies", Schema("bodies").each("<body>", Schema("body")));
  schema.list("Contact", Schema("lines").each("<line>", Schema("line")));
  std::string text = "<ParameterList name=\"Suture\"><ParameterList name=\"Bodies\">";
  for (const std::string& body : scene.model.bodies) text += "<ParameterList name=\"" + body + "\"/>";
  text += "</ParameterList></ParameterList>";
  settings.push_back("Outer Solver/Type=" + way);
  settings.push_back(std::string("Formulation=") + (way == "Semismooth Newton" ? "Condensed Groups" : "Contact On The Interface"));
  return *parseScene(text, "test.xml", schema, settings).parameters;
}

Solved solveAs(const std::string& way, const Scene& given, std::vector<std::string> settings, int subdomains) {
  const CommPtr comm = world();
  const Parameters scene = defaultsOf(given, way, std::move(settings));
  const bool root = comm->getRank() == 0;
  const Mesh mesh = root ? given.mesh : Mesh();
  Constraints constraints = root ? given.constraints : Constraints();
  const Partition partition = makePartition(
      *comm, mesh, constraints,
      subdomains > 0 ? resolved("Partition", partitionSchema(), {"Type=METIS", "METIS/Subdomains=" + std::to_string(subdomains)})
                     : resolved("Partition", partitionSchema(), {"Type=Named Groups", "Named Groups/Pattern=subdomain_*"}),
      formulationOf(scene)->keepsGroupsWhole());
  std::vector<SubdomainMesh> meshes = distribute(*comm, mesh, constraints, partition);
  takeOutLift(*comm, given.model, meshes, constraints);
  Solved result;
  Notes notes;
  Timers timers;
  const auto method = makeMethod(scene, true);
  method->prepare({comm, mesh, constraints, partition, meshes, given.model, scene}, timers);
  const Solution solution = method->solve(notes, timers);
  result.verdict = verify(*comm, {meshes, given.model, solution.displacement, solution.pairs, given.constraints.pieces, 1e-8});
  result.converged = solution.converged;
  result.failure = solution.failure;
  result.notes = notes.said;
  result.pcg = solution.pcgTotal + solution.auxiliary.pcg;
  result.pairs = solution.pairs;
  broadcast(*comm, result.pairs);
  const int size = 2 * given.mesh.nodes();
  Matrix mine = Matrix::Zero(size, 2), all(size, 2);
  for (std::size_t s = 0; s < meshes.size(); ++s)
    for (int node = 0; node < meshes[s].nodes(); ++node) {
      if (!counts(meshes[s], node)) continue;
      for (int k = 0; k < 2; ++k) {
        mine(2 * meshes[s].globalNodes[node] + k, 0) = solution.displacement[s](2 * node + k);
        if (meshes[s].lift.motion.size() > 0) mine(2 * meshes[s].globalNodes[node] + k, 1) = meshes[s].lift.motion(2 * node + k);
      }
    }
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), all.data());
  result.deformation = all.col(0);
  result.motion = all.col(1);
  return result;
}

Eigen::Matrix<long double, Eigen::Dynamic, 1> lessRigid(const Mesh& mesh, Eigen::Matrix<long double, Eigen::Dynamic, 1> field) {
  using Dense = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  for (int body = 0; body < int(mesh.bodies.size()); ++body) {
    std::vector<int> nodes;
    for (int node = 0; node < mesh.nodes(); ++node)
      if (mesh.bodyOfNode[node] == body) nodes.push_back(node);
    Dense modes(2 * nodes.size(), 3), own(2 * nodes.size(), 1);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Point x = mesh.point(nodes[i]);
      modes.row(2 * i) << 1, 0, -x[1];
      modes.row(2 * i + 1) << 0, 1, x[0];
      for (int k = 0; k < 2; ++k) own(2 * i + k, 0) = field[2 * nodes[i] + k];
    }
    for (int pass = 0; pass < 2; ++pass) own -= modes * (modes.transpose() * modes).ldlt().solve(modes.transpose() * own).eval();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int k = 0; k < 2; ++k) field[2 * nodes[i] + k] = own(2 * i + k, 0);
  }
  return field;
}

BodyByBody compareOnRoot(const Scene& scene, const Solved& found, const scenes::ExtendedReference& reference) {
  const Mesh& mesh = scene.mesh;
  const auto exact = lessRigid(mesh, reference.displacement);
  const auto own = lessRigid(mesh, found.deformation.cast<long double>());
  std::vector<long double> size(mesh.bodies.size(), 0), force(mesh.bodies.size(), 0);
  for (int i = 0; i < exact.size(); ++i) size[mesh.bodyOfNode[i / 2]] = std::max(size[mesh.bodyOfNode[i / 2]], std::abs(exact[i]));
  const auto forceOf = [&](int id) { return reference.force[id]; };
  for (const ContactPair& pair : scene.constraints.pairs)
    for (const PairEnd& end : pair.ends) {
      long double& largest = force[mesh.bodyOfNode[end.node]];
      largest = std::max(largest, std::abs(forceOf(pair.id)));
    }
  BodyByBody worst;
  for (int i = 0; i < exact.size(); ++i)
    if (size[mesh.bodyOfNode[i / 2]] > 0)
      worst.displacement = std::max(worst.displacement, double(std::abs(own[i] - exact[i]) / size[mesh.bodyOfNode[i / 2]]));
  for (const ContactPair& pair : scene.constraints.pairs) {
    long double least = force[mesh.bodyOfNode[pair.ends[0].node]];
    for (const PairEnd& end : pair.ends) least = std::min(least, force[mesh.bodyOfNode[end.node]]);
    if (least > 0) worst.force = std::max(worst.force, double(std::abs(found.pairs.at(pair.id).force - forceOf(pair.id)) / least));
    worst.otherwise += (found.pairs.at(pair.id).state.closed()) != bool(reference.closed[pair.id]);
  }
  return worst;
}

BodyByBody compare(const Scene& scene, const Solved& found, const scenes::ExtendedReference& reference) {
  double values[3] = {0, 0, 0};
  if (world()->getRank() == 0) {
    const BodyByBody worst = compareOnRoot(scene, found, reference);
    values[0] = worst.force, values[1] = worst.displacement, values[2] = worst.otherwise;
  }
  Teuchos::broadcast(*world(), 0, 3, values);
  return {values[0], values[1], int(values[2])};
}

}  // namespace suture::blocks
