#include <support/Blocks.hpp>

#include <algorithm>

namespace suture::blocks {

Parameters resolved(const std::string& list, const Schema& schema, std::vector<std::string> settings) {
  for (std::string& setting : settings) setting = list + "/" + setting;
  return parseScene("<ParameterList name=\"Suture\"/>", "test.xml", Schema().list(list, schema), settings).parameters->sublist(list);
}

LocalSolverMaker localSolver(const std::string& name) {
  return localSolverMaker(resolved("Subdomain", subdomainSchema(), {"Local Solver=" + name}));
}

std::unique_ptr<SchurComplement> schurComplement(const std::string& name) {
  const auto& registry = Registry<SchurComplement>::instance();
  return registry.make(name, resolved("Schur", registry.schemas().at(name)));
}

Blocks::Blocks(const Scene& scene, const CommPtr& comm, const std::vector<double>& youngOf, bool keepGroupsWhole) : model(scene.model) {
  const Parameters cut = resolved("Partition", partitionSchema(), {"Type=Named Groups", "Named Groups/Pattern=subdomain_*"});
  build(scene, comm, cut, youngOf, keepGroupsWhole);
}

Blocks::Blocks(const Scene& scene, const CommPtr& comm, int count, int seed, bool keepGroupsWhole) : model(scene.model) {
  build(scene, comm,
        resolved("Partition", partitionSchema(),
                 {"Type=METIS", "METIS/Subdomains=" + std::to_string(count), "METIS/Seed=" + std::to_string(seed)}),
        {}, keepGroupsWhole);
}

void Blocks::build(const Scene& scene, const CommPtr& comm, const Parameters& cut, const std::vector<double>& youngOf,
                   bool keepGroupsWhole) {
  const bool root = comm->getRank() == 0;
  const Mesh mesh = root ? scene.mesh : Mesh();
  const Constraints constraints = root ? scene.constraints : Constraints();
  partition = makePartition(*comm, mesh, constraints, cut, keepGroupsWhole);
  meshes = distribute(*comm, mesh, constraints, partition);
  if (!youngOf.empty()) {
    const Material like = model.materialOfBody.front();
    model.materialOfBody.clear();
    for (double value : youngOf) model.materialOfBody.push_back(like), model.materialOfBody.back().young = value;
    const std::vector<int> places = placesByName();
    for (SubdomainMesh& mesh : meshes) mesh.body = places[mesh.id];
  }
  for (const SubdomainMesh& mesh : meshes) {
    subdomains.push_back(std::make_unique<ElasticSubdomain>(mesh, model));
    subdomains.back()->assemble();
  }
}

std::vector<int> Blocks::placesByName() const {
  std::vector<std::string> sorted = partition.names;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> places;
  for (const std::string& name : partition.names)
    places.push_back(static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), name) - sorted.begin()));
  return places;
}

Dense::Dense(const Blocks& all) {
  for (const auto& subdomain : all.subdomains)
    for (int i = 0; i < subdomain->dofs(); ++i) place[subdomain->globalDof(i)] = 0;
  int n = 0;
  for (auto& entry : place) entry.second = n++;
  stiffness = Matrix::Zero(n, n);
  load = Vector::Zero(n);
  for (const auto& subdomain : all.subdomains) {
    const Matrix k = subdomain->stiffness().dense();
    for (int i = 0; i < subdomain->dofs(); ++i) {
      const int a = place.at(subdomain->globalDof(i));
      load(a) += subdomain->load()(i);
      for (int j = 0; j < subdomain->dofs(); ++j) stiffness(a, place.at(subdomain->globalDof(j))) += k(i, j);
    }
    constantEnergy += subdomain->constantEnergy();
  }
}

std::vector<int> Dense::places(const std::vector<GlobalId>& dofs) const {
  std::vector<int> all;
  for (GlobalId dof : dofs) all.push_back(place.at(dof));
  return all;
}

Scene square(int blocks, int cells, double young, double poisson) {
  Box box;
  box.nx = box.ny = blocks * cells;
  box.blocksX = box.blocksY = blocks;
  return scenes::fromBoxes({box}, young, poisson);
}

Scene clampedSquare(int blocks, int cells, double young, double poisson) {
  Scene scene = square(blocks, cells, young, poisson);
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  return scene;
}

std::vector<Box> twoBoxes(int nx, int ny, int blocksX, int blocksY) {
  std::vector<Box> all(2);
  for (int k = 0; k < 2; ++k) {
    all[k].name = k == 0 ? "lower" : "upper";
    all[k].x0 = -1;
    all[k].y0 = k - 1;
    all[k].y1 = k;
    all[k].nx = nx;
    all[k].ny = ny;
    all[k].blocksX = blocksX;
    all[k].blocksY = blocksY;
  }
  return all;
}

Scene wavyBlocks(const std::vector<Box>& boxes, double youngLower, double youngUpper) {
  Scene scene = scenes::fromBoxes(boxes, youngLower, 0.3);
  scene.model.materialOfBody[1].young = youngUpper;
  scene.pairUp();
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 0.02 * std::cos(3.0 * pair.position[0] + 0.5);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.2, -0.7, 0}});
  return scene;
}

Scene wavyBlocks(double youngLower, double youngUpper, int refinement) {
  return wavyBlocks(twoBoxes(6 * refinement, 4 * refinement, 2, 2), youngLower, youngUpper);
}

std::vector<int> sharedDofs(const Subdomain& subdomain) {
  std::vector<int> dofs;
  for (int i = 0; i < subdomain.dofs(); ++i)
    if (!subdomain.mesh().others(subdomain.nodeOf(i)).empty()) dofs.push_back(i);
  return dofs;
}

}  // namespace suture::blocks
