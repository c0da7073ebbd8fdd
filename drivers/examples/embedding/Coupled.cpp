// Suture coupled to another program in a loop: gas is pumped into a chamber above a block and let out again. The gas presses on the block,
// which rests on springs; the block moves down, the chamber grows, the pressure falls. Above some pressure the block touches another one.
//
//        chamber of height 0.05, p = gas / height        the other program: GasChamber
//     ---------------------------------------------      forces down, displacements up
//     |  upper                                    |
//     ---------------------------------------------      on springs of 2e5 Pa/m; gap 0.01: contact closes and opens
//     |  lower, on the ground                     |      Suture
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/CoupledScene.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace suture;

namespace {

const double kYoung = 2e6, kSprings = 2e5, kGap = 0.01, kWidth = 1.0;

/// The other program: isothermal gas between a fixed lid and a surface that moves down; pressures are relative to the ambient pressure.
struct GasChamber {
  double height = 0.05, air = 1e5;
  double content = air * height;  ///< pressure times height of the enclosed gas [Pa m]
  double pressure(double down) const { return content / (height + down) - air; }
};

/// Position at equilibrium of gas and blocks, by bisection: the upper block is compressed, and its underside moves down on the springs and,
/// once the gap is closed, on the lower block.
double exactWay(const GasChamber& gas) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double way = 0.5 * (low + high), underside = way - gas.pressure(way) / kYoung;
    const double held = kSprings * underside + kYoung * std::max(0.0, underside - kGap);
    (gas.pressure(way) > held ? low : high) = way;
  }
  return low;
}

Scene blocks(int cells) {
  ElasticModel model;
  const auto rubber = std::make_shared<IsotropicLaw>(IsotropicModuli{kYoung, 0.0});
  model.addBody("upper", rubber);
  model.addBody("lower", rubber);
  model.supports = {{{"upper_bottom"}, kSprings, 0.0}};
  const auto mesh = [cells] {
    return boxes({{"upper", 0, kWidth, kGap, 1 + kGap, cells, cells}, {"lower", 0, kWidth, -1, 0, cells * 3 / 4, cells * 3 / 4}});
  };
  return makeScene(model, mesh, {Condition::displacement("upper_left", {0}, {0}), Condition::displacement("lower_bottom", {0, 0})},
                   {Contact::between("upper_bottom", "lower_top")});
}

}  // namespace

int main(int argc, char* argv[]) {
  const Tpetra::ScopeGuard mpi(&argc, &argv);
  const CommPtr comm = Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
  const bool prints = comm->getRank() == 0;
  try {
    const double begin = Timers::now();
    CoupledScene coupled(comm, blocks(argc > 1 ? std::atoi(argv[1]) : 16));
    const CouplingSurface surface = coupled.surface("upper_top");
    double first = 0.0, worst = 0.0;

    /// One exchange: applies the forces of the gas and returns the mean downward displacement of the surface.
    const auto wayAt = [&](double pressure) {
      std::vector<double> forces;
      for (const double normal : surface.normals) forces.push_back(-pressure * normal);
      coupled.setForces(surface, forces);
      coupled.solve(false);
      const std::vector<double> u = coupled.displacements(surface);
      double mine = 0.0, sum = 0.0;
      for (std::size_t i = 0; i < surface.nodes.size(); ++i) mine -= surface.areas[i] * u[2 * i + 1];
      Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(sum));
      return sum / kWidth;
    };

    if (prints) std::printf("step  gas    pressure  way       closed  solves  outer  PCG  solve / first\n");
    GasChamber gas;
    double pressure = 0.0;
    int step = 0;
    for (const double amount : {1.1, 1.3, 1.6, 2.0, 1.6, 1.3, 1.1}) {
      gas.content = amount * gas.air * gas.height;
      ++step;
      double relaxation = 0.1, before = 0.0, way = 0.0, seconds = 0.0;  // relaxation: Aitken's factor
      int solves = 0, outer = 0, pcg = 0;
      for (;;) {
        const double now = Timers::now();
        way = wayAt(pressure);
        if (first == 0.0)
          first = Timers::now() - begin;  // including setup
        else
          seconds += Timers::now() - now;
        ++solves;
        outer += coupled.solution().iterations;
        pcg += coupled.solution().pcgTotal + coupled.solution().auxiliary.pcg;
        const double misfit = gas.pressure(way) - pressure;
        if (std::abs(misfit) <= 1e-7 * gas.air || solves == 50) break;
        if (solves > 1) relaxation *= before / (before - misfit);
        before = misfit;
        pressure += relaxation * misfit;
      }
      coupled.verify();
      worst = std::max(worst, std::abs(way - exactWay(gas)) / exactWay(gas));
      int closed = 0;
      for (const PairResult& pair : coupled.solution().pairs) closed += pair.state.closed();
      if (prints)
        std::printf("%4d  %.2f  %8.1f  %.6f  %6d  %6d  %5d  %3d  %.3f\n", step, amount, pressure, way, closed, solves, outer, pcg,
                    seconds / (step == 1 ? solves - 1 : solves) / first);
      if (coupled.ending() != ExitCode::Done) {
        if (prints) std::fprintf(stderr, "%s\n", coupled.solution().failure.c_str());
        return static_cast<int>(coupled.ending());
      }
    }
    if (prints) std::printf("largest error of the way: %.1e\n", worst);
    return worst < 1e-5 ? 0 : static_cast<int>(ExitCode::Internal);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
