#pragma once
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <support/SmallScenes.hpp>
#include <suture/algebra/LocalSolver.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/subdomain/ElasticSubdomain.hpp>
#include <suture/subdomain/SchurComplement.hpp>

#include <support/DenseAlgebra.hpp>

#include <map>
#include <memory>

/// Distributed subdomains of small generated scenes, and the same scenes whole and dense: shared by the tests from `subdomain` to
/// `precond`.
namespace suture::blocks {

using namespace dense;
using scenes::Scene;

inline CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }
inline CommPtr alone() { return Teuchos::rcp(new Teuchos::SerialComm<int>()); }

/// Resolved parameters of one list of a scene.
Parameters resolved(const std::string& list, const Schema& schema, std::vector<std::string> settings = {});

LocalSolverMaker localSolver(const std::string& name = "CHOLMOD");
/// A strategy with its defaults.
std::unique_ptr<SchurComplement> schurComplement(const std::string& name);

/// The named blocks of a scene's boxes (Box::blocksX, blocksY) as subdomains, assembled and distributed over a communicator.
struct Blocks {
  ElasticModel model;
  Partition partition;
  std::vector<SubdomainMesh> meshes;
  std::vector<std::unique_ptr<Subdomain>> subdomains;

  /// \param youngOf          Young modulus of each subdomain, in the order of their names, instead of the body's: a body of several
  /// materials \param keepGroupsWhole  false: for Contact On The Interface
  Blocks(const Scene& scene, const CommPtr& comm, const std::vector<double>& youngOf = {}, bool keepGroupsWhole = true);
  /// \param subdomains  by METIS; as many as bodies: each body whole
  Blocks(const Scene& scene, const CommPtr& comm, int count, int seed = 1, bool keepGroupsWhole = true);
  Blocks(const Blocks&) = delete;

  /// Place of each subdomain in the order of the names: of square blocks, column by column.
  std::vector<int> placesByName() const;

 private:
  void build(const Scene& scene, const CommPtr& comm, const Parameters& cut, const std::vector<double>& youngOf, bool keepGroupsWhole);
};

/// A whole scene as one dense system in the free unknowns, ascending by global number.
struct Dense {
  std::map<GlobalId, int> place;
  Matrix stiffness;
  Vector load;
  double constantEnergy = 0.0;

  explicit Dense(const Blocks& all);
  std::vector<int> places(const std::vector<GlobalId>& dofs) const;
};

/// The unit square cut into blocks x blocks subdomains of cells x cells cells each.
Scene square(int blocks, int cells, double young = 1.0, double poisson = 0.3);
Scene clampedSquare(int blocks, int cells, double young = 1.0, double poisson = 0.3);

/// Boxes "lower" and "upper" on each other, [-1, 1] x [-1, 0] and [-1, 1] x [0, 1], each with the given number of cells and blocks.
std::vector<Box> twoBoxes(int nx, int ny, int blocksX, int blocksY);

/// Two blocks in contact along y = 0 under their weight. The gap is a wave: some pairs interfere, some are open. Nothing is held. With 2 x
/// 2 subdomains each (the default) the contact group has four members with seams inside.
Scene wavyBlocks(const std::vector<Box>& boxes, double youngLower = 100.0, double youngUpper = 40.0);
Scene wavyBlocks(double youngLower = 100.0, double youngUpper = 40.0, int refinement = 1);

/// Positions of a subdomain's free unknowns at nodes shared with other subdomains.
std::vector<int> sharedDofs(const Subdomain& subdomain);

}  // namespace suture::blocks
