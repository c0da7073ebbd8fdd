// Suture inside another program with its own communicator (each rank solves separately), a scene in memory and no console output. The
// patch test: one block pressed on another with u_y = -0.1; the pressure is 1e5 everywhere.
#include <suture/base/Errors.hpp>
#include <suture/base/Version.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/solver/SolveInterface.hpp>
#include <suture/solver/SolverSchema.hpp>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>

#include <cmath>
#include <cstdio>

namespace {

const char* const scene = R"xml(<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="Generator" type="string" value="Boxes"/><ParameterList name="Boxes">
    <ParameterList name="upper"><Parameter name="Y" type="Array(double)" value="{0, 1}"/></ParameterList>
    <ParameterList name="lower"><Parameter name="Y" type="Array(double)" value="{-1, 0}"/></ParameterList>
  </ParameterList></ParameterList>
  <ParameterList name="Bodies">
    <ParameterList name="upper"><Parameter name="Material" type="string" value="rubber"/></ParameterList>
    <ParameterList name="lower"><Parameter name="Material" type="string" value="rubber"/></ParameterList>
  </ParameterList>
  <ParameterList name="Materials"><ParameterList name="rubber">
    <Parameter name="Young Modulus" type="double" value="2e6"/><Parameter name="Poisson Ratio" type="double" value="0"/>
  </ParameterList></ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="press"><Parameter name="Group" type="string" value="upper_top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0.0, -0.1}"/></ParameterList>
    <ParameterList name="ground"><Parameter name="Group" type="string" value="lower_bottom"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0.0, 0.0}"/></ParameterList>
  </ParameterList>
  <ParameterList name="Contact"><ParameterList name="joint">
    <Parameter name="Side A" type="string" value="upper_bottom"/><Parameter name="Side B" type="string" value="lower_top"/>
  </ParameterList></ParameterList>
  <ParameterList name="Partition"><ParameterList name="METIS"><Parameter name="Subdomains" type="string" value="6"/></ParameterList></ParameterList>
  <ParameterList name="Outer Solver"><Parameter name="Tolerance" type="double" value="1e-12"/></ParameterList>
</ParameterList>)xml";

// Only the scene parameters that this program needs: no output, no title.
suture::Schema schema() {
  suture::Schema scene("a contact problem");
  scene.list("Mesh", suture::meshSchema(), true);
  scene.list("Bodies", suture::Schema("bodies").each("body", suture::bodySchema(), 1), true);
  scene.list("Materials", suture::Schema("materials").each("material", suture::materialSchema(), 1), true);
  scene.list("Boundary Conditions", suture::Schema("conditions").each("condition", suture::boundaryConditionSchema()));
  scene.list("Contact", suture::Schema("contact").each("line", suture::contactSchema()));
  scene.list("Partition", suture::partitionSchema());
  suture::addModelParameters(scene);
  suture::addSolverParameters(scene);
  return scene;
}

double worstPressureError(const suture::CommPtr& comm) {
  const suture::SceneFile file = suture::parseScene(scene, "a scene in memory", schema());
  const suture::Parameters& all = *file.parameters;
  suture::Mesh mesh = suture::readMesh(*comm, all.sublist("Mesh"), ".");
  suture::assignBodies(mesh, suture::sublistNames(all.sublist("Bodies")));
  const suture::Constraints constraints = suture::buildConstraints(mesh, all.sublist("Boundary Conditions"), all.sublist("Contact"));
  const suture::Partition partition = suture::makePartition(*comm, mesh, constraints, all.sublist("Partition"));
  const std::vector<suture::SubdomainMesh> meshes = suture::distribute(*comm, mesh, constraints, partition);
  const suture::ElasticModel model = suture::makeElasticModel(all);
  const suture::Subdomains subdomains = suture::makeSubdomains(*comm, meshes, model);
  const auto problem = suture::makeInterfaceProblem(comm, partition, subdomains, all);
  suture::Monitor silent;
  const suture::OuterResult result = suture::solveInterface(*problem, all, silent);
  const suture::Solution solution = suture::recover(*comm, *problem, result, subdomains, all);
  if (!solution.converged || solution.pairs.empty()) return INFINITY;
  double worst = 0.0;
  for (const suture::PairResult& pair : solution.pairs) worst = std::max(worst, std::abs(pair.pressure / 1e5 - 1.0));
  return worst;
}

}  // namespace

int main(int argc, char* argv[]) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    // A library that used MPI_COMM_WORLD would hang here, or count the other rank's subdomains.
    const double error = worstPressureError(Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)));
    std::printf("Suture %s: largest relative error of the contact pressure %.1e\n", suture::version().c_str(), error);
    return error < 1e-9 ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
