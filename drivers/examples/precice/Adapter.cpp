// A Suture scene as a participant of preCICE: reads forces on a side group, writes the displacements of its nodes.
//
//   suture_precice SCENE.xml PRECICE-CONFIG.xml PARTICIPANT MESH GROUP ["Path/To/Parameter=value"]...
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <precice/precice.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/CoupledScene.hpp>

#include <cstdio>

using namespace suture;

int main(int argc, char* argv[]) {
  const Tpetra::ScopeGuard mpi(&argc, &argv);
  const CommPtr comm = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
  if (argc < 6) {
    std::fprintf(stderr, "usage: %s SCENE.xml PRECICE-CONFIG.xml PARTICIPANT MESH GROUP [SETTING]...\n", argv[0]);
    return static_cast<int>(ExitCode::CommandLine);
  }
  const std::string mesh = argv[4];
  try {
    CoupledScene coupled(comm, sceneOf(readScene(*comm, argv[1], sceneSchema(), {argv + 6, argv + argc})));
    precice::Participant participant(argv[3], argv[2], comm->getRank(), comm->getSize());

    const CouplingSurface surface = coupled.surface(argv[5]);
    std::vector<precice::VertexID> ids(surface.nodes.size());
    participant.setMeshVertices(mesh, surface.coordinates, ids);
    if (participant.requiresInitialData()) participant.writeData(mesh, "Displacement", ids, coupled.displacements(surface));
    participant.initialize();

    std::vector<double> forces(surface.coordinates.size());
    while (participant.isCouplingOngoing()) {
      participant.requiresWritingCheckpoint();  // no state to save: an iteration only leaves the initial guess of the next one
      const double step = participant.getMaxTimeStepSize();
      participant.readData(mesh, "Force", ids, step, forces);
      coupled.setForces(surface, forces);
      coupled.solve();
      if (coupled.ending() != ExitCode::Done) throw NumericalError(coupled.solution().failure);
      participant.writeData(mesh, "Displacement", ids, coupled.displacements(surface));
      participant.advance(step);
      if (!participant.requiresReadingCheckpoint()) coupled.advance();  // the time window is complete: keep the slip of friction
    }
    participant.finalize();
    return static_cast<int>(coupled.ending());
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
