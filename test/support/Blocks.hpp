#pragma once
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <solver/MonolithicScenes.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>
#include <suture/subdomain/LocalSolver.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <memory>
#include <random>

/// Distributed subdomains of small generated scenes, and the same scenes whole and dense: what tests from `subdomain` to `precond` share.
namespace suture::blocks {

using scenes::Scene;

inline CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }
inline CommPtr alone() { return Teuchos::rcp(new Teuchos::SerialComm<int>()); }

/// Resolved parameters of one list of a scene.
inline Parameters resolved(const std::string& list, const Schema& schema, std::vector<std::string> settings = {}) {
  for (std::string& setting : settings) setting = list + "/" + setting;
  return parseScene("<ParameterList name=\"Suture\"/>", "test.xml", Schema().list(list, schema), settings).parameters->sublist(list);
}

inline LocalSolverMaker localSolver(const std::string& name = "CHOLMOD") {
  return localSolverMaker(resolved("Subdomain", subdomainSchema(), {"Local Solver=" + name}));
}

/// The named blocks of a scene's boxes (Box::blocksX, blocksY) as subdomains, assembled and spread over a communicator.
struct Blocks {
  ElasticModel model;
  Partition partition;
  std::vector<SubdomainMesh> meshes;
  std::vector<std::unique_ptr<Subdomain>> subdomains;

  /// \param youngOf          of each subdomain, in place of the body's: a body of several materials
  /// \param keepGroupsWhole  false: for Contact On The Interface
  Blocks(const Scene& scene, const CommPtr& comm, const std::vector<double>& youngOf = {}, bool keepGroupsWhole = true)
      : model(scene.model) {
    const Parameters cut = resolved("Partition", partitionSchema(), {"Type=Named Groups", "Named Groups/Pattern=subdomain_*"});
    build(scene, comm, cut, youngOf, keepGroupsWhole);
  }
  /// \param subdomains  by METIS; as many as bodies: each body whole
  Blocks(const Scene& scene, const CommPtr& comm, int count, int seed = 1, bool keepGroupsWhole = true) : model(scene.model) {
    build(scene, comm,
          resolved("Partition", partitionSchema(),
                   {"Type=METIS", "METIS/Subdomains=" + std::to_string(count), "METIS/Seed=" + std::to_string(seed)}),
          {}, keepGroupsWhole);
  }
  Blocks(const Blocks&) = delete;

 private:
  void build(const Scene& scene, const CommPtr& comm, const Parameters& cut, const std::vector<double>& youngOf, bool keepGroupsWhole) {
    const bool root = comm->getRank() == 0;
    const Mesh mesh = root ? scene.mesh : Mesh();
    const Constraints constraints = root ? scene.constraints : Constraints();
    partition = makePartition(*comm, mesh, constraints, cut, keepGroupsWhole);
    meshes = distribute(*comm, mesh, constraints, partition);
    if (!youngOf.empty()) {
      const Material like = model.materialOfBody.front();
      model.materialOfBody.clear();
      for (double value : youngOf) model.materialOfBody.push_back(like), model.materialOfBody.back().young = value;
      for (SubdomainMesh& mesh : meshes) mesh.body = mesh.id;
    }
    for (const SubdomainMesh& mesh : meshes) {
      subdomains.push_back(std::make_unique<ElasticSubdomain>(mesh, model));
      subdomains.back()->assemble();
    }
  }
};

/// All of a scene as one dense system in the free unknowns, ascending by global number.
struct Dense {
  std::map<GlobalId, int> place;
  Matrix stiffness;
  Vector load;
  double constantEnergy = 0.0;

  explicit Dense(const Blocks& all) {
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
  std::vector<int> places(const std::vector<GlobalId>& dofs) const {
    std::vector<int> all;
    for (GlobalId dof : dofs) all.push_back(place.at(dof));
    return all;
  }
};

/// K_BB - K_BI K_II^-1 K_IB, and optionally the load that goes with it.
inline Matrix denseSchur(const Matrix& k, const std::vector<int>& boundary, const Vector& load = {}, Vector* condensed = nullptr) {
  const std::vector<int> interior = complement(int(k.rows()), boundary);
  const Matrix rowsI = rowsAt(k, interior), rowsB = rowsAt(k, boundary);
  const Matrix ii = rowsAt(rowsI.transpose(), interior).transpose(), ib = rowsAt(rowsI.transpose(), boundary).transpose();
  const Matrix bb = rowsAt(rowsB.transpose(), boundary).transpose();
  if (condensed) *condensed = rowsAt(load, boundary);
  if (interior.empty()) return bb;
  const Eigen::LDLT<Matrix> ldlt(ii);
  if (condensed) *condensed -= ib.transpose() * ldlt.solve(rowsAt(load, interior));
  return bb - ib.transpose() * ldlt.solve(ib);
}

/// The unit square cut into blocks x blocks subdomains of cells x cells cells each.
inline Scene square(int blocks, int cells, double young = 1.0, double poisson = 0.3) {
  Box box;
  box.nx = box.ny = blocks * cells;
  box.blocksX = box.blocksY = blocks;
  return scenes::fromBoxes({box}, young, poisson);
}
inline Scene clampedSquare(int blocks, int cells, double young = 1.0, double poisson = 0.3) {
  Scene scene = square(blocks, cells, young, poisson);
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  return scene;
}

/// Boxes "lower" and "upper" on each other, [-1, 1] x [-1, 0] and [-1, 1] x [0, 1], each of so many cells and blocks.
inline std::vector<Box> twoBoxes(int nx, int ny, int blocksX, int blocksY) {
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

/// Two blocks in contact along y = 0 under their weight. The gap is a wave: some pairs interfere, some are open. Nothing is held. With 2 x
/// 2 subdomains each (the default) the contact group has four members with seams inside.
inline Scene wavyBlocks(const std::vector<Box>& boxes, double youngLower = 100.0, double youngUpper = 40.0) {
  Scene scene = scenes::fromBoxes(boxes, youngLower, 0.3);
  scene.model.materialOfBody[1].young = youngUpper;
  scene.pairUp();
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 0.02 * std::cos(3.0 * pair.position[0] + 0.5);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.2, -0.7, 0}});
  return scene;
}
inline Scene wavyBlocks(double youngLower = 100.0, double youngUpper = 40.0, int refinement = 1) {
  return wavyBlocks(twoBoxes(6 * refinement, 4 * refinement, 2, 2), youngLower, youngUpper);
}

/// Numbers in [-1, 1], the same in every run and on every machine.
inline Matrix random(int rows, int columns, unsigned seed = 1) {
  std::mt19937 generator(seed);
  Matrix values(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) values(i, j) = generator() / 2147483647.5 - 1.0;
  return values;
}

inline double difference(const Matrix& a, const Matrix& b) { return (a - b).norm() / std::max(b.norm(), 1e-300); }

inline std::vector<int> range(int count, int first = 0) {
  std::vector<int> all(count);
  for (int i = 0; i < count; ++i) all[i] = first + i;
  return all;
}

/// Positions of a subdomain's free unknowns at nodes that other subdomains hold, too.
inline std::vector<int> sharedDofs(const Subdomain& subdomain) {
  std::vector<int> dofs;
  for (int i = 0; i < subdomain.dofs(); ++i)
    if (!subdomain.mesh().others(subdomain.nodeOf(i)).empty()) dofs.push_back(i);
  return dofs;
}

}  // namespace suture::blocks
