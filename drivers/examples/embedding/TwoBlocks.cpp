// A contact problem set up and solved in C++: one block pressed onto another by a tenth of its height.
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cstdio>

using namespace suture;

int main(int argc, char* argv[]) {
  const Tpetra::ScopeGuard mpi(&argc, &argv);
  const CommPtr comm = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
  try {
    ElasticModel model;
    const auto rubber = std::make_shared<IsotropicLaw>(IsotropicModuli{2e6, 0.0});
    model.addBody("upper", rubber);
    model.addBody("lower", rubber);
    const auto mesh = [] { return boxes({{"upper", 0, 1, 0, 1, 16, 16}, {"lower", 0, 1, -1, 0, 12, 12}}); };
    const std::vector<Condition> held{Condition::displacement("upper_top", {0, -0.1}), Condition::displacement("lower_bottom", {0, 0})};
    const std::vector<Contact> contacts{Contact::between("upper_bottom", "lower_top")};

    Simulation simulation(comm, makeScene(model, mesh, held, contacts));
    const Solution& solution = simulation.solve();
    if (comm->getRank() == 0) {
      const auto less = [](const PairResult& a, const PairResult& b) { return a.pressure < b.pressure; };
      const auto [low, high] = std::minmax_element(solution.pairs.begin(), solution.pairs.end(), less);
      std::printf("%zu pairs, pressures from %.6g to %.6g Pa\n", solution.pairs.size(), low->pressure, high->pressure);
    }
    return static_cast<int>(simulation.ending());
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
