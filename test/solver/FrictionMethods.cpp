// Contact with friction on the interface against the reference, which shares only elements, rows and laws with it.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/FrictionBlocks.hpp>
#include <solver/ContactMethods.hpp>
#include <support/CheckSays.hpp>
#include <support/DryLaw.hpp>
#include <suture/base/Point.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/solver/SolveInterface.hpp>

namespace suture {
namespace {

using namespace blocks;
using scenes::dry;
using LawOfSides = std::shared_ptr<const ContactLaw>;

/// Largest distances from the reference, over all ranks, relative to the largest force and displacement.
struct FarFromReference {
  double force = 0.0, slip = 0.0, displacement = 0.0;
  int otherwise = 0, open = 0, slide = 0, stick = 0;
};

FarFromReference farFrom(const Scene& scene, const Blocks& all, const InterfaceProblem& problem, const OuterResult& result,
                         const MonolithicResult& reference) {
  const int dimension = scene.mesh.dimension;
  const InterfaceProblem::Recovered found = problem.recover(result.state);
  double mine[3] = {0, 0, 0}, most[3], size = 1e-300;
  int counts[4] = {0, 0, 0, 0}, sums[4];
  for (const PairForce& pair : reference.forces) size = std::max(size, std::hypot(pair.force, norm(pair.tangential)));
  for (const PairForce& pair : found.pairs) {
    const PairForce& other = reference.forces.at(pair.id);
    mine[0] = std::max({mine[0], std::abs(pair.force - other.force) / size, norm(minus(pair.tangential, other.tangential)) / size});
    counts[0] += pair.state.status != other.state.status;
    ++counts[1 + int(pair.state.status)];
  }
  const double moved = reference.displacement.lpNorm<Eigen::Infinity>();
  for (std::size_t s = 0; s < all.subdomains.size(); ++s) {
    const Vector u = all.subdomains[s]->cartesian(found.freeValues[s]);
    for (int node = 0; node < all.meshes[s].nodes(); ++node)
      for (int k = 0; k < dimension; ++k)
        mine[2] = std::max(mine[2], std::abs(u(dimension * node + k) -
                                             reference.displacement(dimension * Eigen::Index(all.meshes[s].globalNodes[node]) + k)) /
                                        moved);
  }
  if (const ContactProblem* contact = problem.contact()) {
    const PairValues values = contact->valuesOf(result.state);
    for (const ContactPair& pair : scene.constraints.pairs) {
      const std::vector<Point> frame = pairFrame(pair.normal, dimension);
      Point jump{0, 0, 0};
      for (const PairEnd& end : pair.ends)
        for (int k = 0; k < dimension; ++k) jump[k] += end.weight * reference.displacement(dimension * Eigen::Index(end.node) + k);
      for (int k = 1; k < dimension; ++k) mine[1] = std::max(mine[1], std::abs(values.jump(pair.id, k) - dot(jump, frame[k])) / moved);
    }
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, 3, mine, most);
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 4, counts, sums);
  return {most[0], most[1], most[2], sums[0], sums[1], sums[2], sums[3]};
}

std::unique_ptr<InterfaceProblem> problemOf(const Scene& scene, const Blocks& all, bool inGroups) {
  if (inGroups)
    return std::make_unique<CondensedProblem>(world(), all.partition, all.subdomains, localSolver(), schurOf(), scene.constraints.laws);
  return std::make_unique<ContactInterfaceProblem>(world(), all.partition, all.subdomains, localSolver(), schurOf(),
                                                   scene.constraints.laws);
}

MonolithicResult referenceOf(const Scene& scene) {
  Monitor quiet;
  return solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet);
}

FarFromReference compared(const Scene& scene, const std::string& name, bool& success, Teuchos::FancyOStream& out, bool inGroups = false) {
  const Blocks all(scene, world(), std::vector<double>(), inGroups);
  const std::unique_ptr<InterfaceProblem> problem = problemOf(scene, all, inGroups);
  const OuterResult result = solveWith(inGroups ? "Semismooth Newton" : "Active Set", *problem, 1e-10);
  const MonolithicResult reference = referenceOf(scene);
  if (!result.converged) out << name << ": " << result.failure << "\n";
  TEST_ASSERT(result.converged);
  TEST_ASSERT(reference.converged);
  const FarFromReference far = farFrom(scene, all, *problem, result, reference);
  out << name << ": forces " << far.force << ", slips " << far.slip << ", displacements " << far.displacement << ", open " << far.open
      << ", slip " << far.slide << ", stick " << far.stick << ", steps " << result.iterations << " + " << result.pcgTotal << "\n";
  TEST_COMPARE(far.force, <, 1e-6);
  TEST_COMPARE(far.slip, <, 1e-6);
  TEST_COMPARE(far.displacement, <, 1e-6);
  TEST_EQUALITY(far.otherwise, 0);
  return far;
}

const char* nameOf(Sides sides) { return sides == Sides::Matching ? "matching" : sides == Sides::Mortar ? "mortar" : "obstacle"; }

void comparesAllLaws(int dimension, bool& success, Teuchos::FancyOStream& out, bool inGroups = false) {
  const std::pair<const char*, LawOfSides> laws[] = {
      {"Coulomb .05", dry(0.0, 0.05)},    {"Coulomb .3", dry(0.0, 0.3)},
      {"Coulomb 1", dry(0.0, 1.0)},       {"Tresca", dry(0.004, 0.0)},
      {"cohesion", dry(0.002, 0.2)},      {"none", dry(0.0, 0.0)},
      {"Tied", std::make_shared<Tied>()}, {"No Separation", std::make_shared<NoSeparation>()}};
  int slide = 0, stick = 0, open = 0;
  for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle})
    for (const auto& [law, of] : laws)
      for (const bool opens : {false, true}) {
        const FarFromReference far = compared(rubbedBlocks(dimension, sides, of, dimension == 2 ? 4 : 2, opens),
                                              std::string(nameOf(sides)) + ", " + law + (opens ? ", opens" : ""), success, out, inGroups);
        slide += far.slide, stick += far.stick, open += far.open;
      }
  TEST_COMPARE(std::min({slide, stick, open}), >, 30);
}

TEUCHOS_UNIT_TEST(FrictionMethods, AgreeWithTheReferenceInThePlane) { comparesAllLaws(2, success, out); }
TEUCHOS_UNIT_TEST(FrictionMethods, AgreeWithTheReferenceIn3D) { comparesAllLaws(3, success, out); }

// Condensed Groups: Tresca's law directly, Coulomb's as a fixed point of it.
TEUCHOS_UNIT_TEST(FrictionMethods, AgreeWithTheReferenceInGroupsInThePlane) { comparesAllLaws(2, success, out, true); }
TEUCHOS_UNIT_TEST(FrictionMethods, AgreeWithTheReferenceInGroupsIn3D) { comparesAllLaws(3, success, out, true); }

/// The upper block under a pressure and a traction along the contact instead of a held top: only friction holds it.
Scene heldByFriction(int dimension, Sides sides, const LawOfSides& law, double along) {
  Scene scene = rubbedBlocks(dimension, sides, law);
  for (const int node : scene.nodesOf("upper_top")) scene.ruleOf(node).fixed = {false, false, false};
  Point traction{along, 0, 0};
  if (dimension == 3) traction = {0.8 * along, -0.6 * along, 0};
  traction[dimension - 1] = -0.02;
  scene.traction("upper_top", traction);
  return scene;
}

TEUCHOS_UNIT_TEST(FrictionMethods, HoldABodyByFrictionAlone) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle})
      for (const LawOfSides& law : {dry(0.0, 0.3), dry(0.001, 0.25), dry(0.006, 0.0)})
        for (const bool inGroups : {false, true})
          compared(heldByFriction(dimension, sides, law, 0.005),
                   std::string(nameOf(sides)) + " in " + std::to_string(dimension) + (inGroups ? ", in groups" : ""), success, out,
                   inGroups);
}

// Tresca problems in sequence, each with bounds from the last one's forces, contract at the reported rate.
TEUCHOS_UNIT_TEST(FrictionMethods, ReportHowTheFixedPointOfTrescaProblemsContracts) {
  const auto contraction = [](const LawOfSides& law) {
    const Scene scene = rubbedBlocks(2, Sides::Matching, law, 4);
    const Blocks all(scene, world(), std::vector<double>(), true);
    const OuterResult result = solveWith("Semismooth Newton", *problemOf(scene, all, true), 1e-10);
    const auto found = result.estimates.find("contraction");
    return found == result.estimates.end() ? -1.0 : found->second;
  };
  const double little = contraction(dry(0.0, 0.1)), more = contraction(dry(0.0, 0.3));
  out << "contraction " << little << ", " << more << "\n";
  TEST_COMPARE(little, >, 0.0);
  TEST_COMPARE(little, <, 0.2);  // about .55 mu on blocks (independent program, V19)
  TEST_COMPARE(more, >, 1.5 * little);
  TEST_COMPARE(more, <, 0.5);
}

// Nearly all pairs slip: only the stiffness across their slip prevents the block from rotating.
TEUCHOS_UNIT_TEST(FrictionMethods, HoldABodyThatOnlySlidingPairsHold) {
  int slide = 0, stick = 0;
  for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle}) {
    const FarFromReference far = compared(heldByFriction(3, sides, dry(0.0, 0.3), 0.0058), nameOf(sides), success, out);
    slide += far.slide, stick += far.stick;
  }
  TEST_COMPARE(slide, >, 3 * stick);
}

TEUCHOS_UNIT_TEST(FrictionMethods, SayThatABodySlidesAway) {
  const LawOfSides coulomb = dry(0.0, 0.3), bounded = dry(0.006, 0.0);
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Obstacle})
      for (const LawOfSides& law : {coulomb, bounded}) {
        const OnInterface one(heldByFriction(dimension, sides, law, 0.007), world());
        const OuterResult result = solveWith("Active Set", one.problem, 1e-10);
        TEST_ASSERT(!result.converged);
        out << result.failure << " after " << result.iterations << " steps\n";
        TEST_ASSERT(result.slides.size() > 0);
        if (result.slides.size() == 0) continue;
        const std::string said = slidesAway(one.problem.contact()->bodies(), result.slides, {"first", "second"}, true);
        out << said << "\n";
        SUTURE_CHECK_SAYS(said, "no equilibrium was found: friction does not hold body '");
        SUTURE_CHECK_SAYS(said, "', which can move ");
      }
}

// Nodes of a mortar keep Cartesian axes: along an inclined contact each row names all components of its nodes.
TEUCHOS_UNIT_TEST(FrictionMethods, AgreeWithTheReferenceOnAnIncline) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar})
      for (const double angle : {0.78, 2.2})
        compared(rubbedBlocks(dimension, sides, dry(0.0, 0.3), 2, true, angle), std::string(nameOf(sides)) + " on an incline", success,
                 out);
}

TEUCHOS_UNIT_TEST(FrictionMethods, WithMuchFrictionAreTied) {
  for (const Sides sides : {Sides::Matching, Sides::Mortar}) {
    const Scene rough = rubbedBlocks(2, sides, dry(0.0, 1e6), 4), tied = rubbedBlocks(2, sides, std::make_shared<Tied>(), 4);
    const OnInterface one(rough, world());
    const OuterResult result = solveWith("Active Set", one.problem, 1e-10);
    TEST_ASSERT(result.converged);
    const FarFromReference far = farFrom(rough, one.all, one.problem, result, referenceOf(tied));
    TEST_COMPARE(far.displacement, <, 1e-8);
    TEST_COMPARE(far.force, <, 1e-7);
  }
}

TEUCHOS_UNIT_TEST(FrictionMethods, GoOnFromASolution) {
  for (const int dimension : {2, 3}) {
    const Scene scene = rubbedBlocks(dimension, Sides::Matching, dry(0.001, 0.3), 2, true);
    const OnInterface one(scene, world());
    const OuterResult first = solveWith("Active Set", one.problem, 1e-10);
    TEST_ASSERT(first.converged);
    std::map<int, ContactState> kept;
    const PairStates states = one.problem.contact()->statesOf(first.state.status);
    for (std::size_t p = 0; p < states.size(); ++p) kept[int(p)] = states[p];
    const InterfaceState start = one.problem.stateOf(one.problem.interiors(first.state), kept);
    const OuterResult again = solveWith("Active Set", one.problem, 1e-8, "BDDC", &start);
    TEST_ASSERT(again.converged);
    TEST_COMPARE(again.iterations, <=, dimension);             // in 3D slip directions are settled at an intermediate accuracy
    TEST_COMPARE(3 * again.pcgTotal, <=, 2 * first.pcgTotal);  // with the same states: the cost of the search itself is saved
    TEST_ASSERT(one.problem.differing(again.state.status, first.state.status).empty());
  }
}

// Any partition, any number of ranks: the same steps to the same states.
TEUCHOS_UNIT_TEST(FrictionMethods, DoNotDependOnTheCut) {
  const Scene scene = rubbedBlocks(2, Sides::Mortar, dry(0.0, 0.3), 6, true);
  const MonolithicResult reference = referenceOf(scene);
  for (const int parts : {2, 5, 9}) {
    const Blocks all(scene, world(), parts, 1, false);
    const ContactInterfaceProblem problem(world(), all.partition, all.subdomains, localSolver(), schurOf(), scene.constraints.laws);
    const OuterResult result = solveWith("Active Set", problem, 1e-10);
    TEST_ASSERT(result.converged);
    int otherwise = 0;
    double far = 0.0, size = 0.0;
    for (const PairForce& pair : reference.forces) size = std::max(size, pair.force);
    for (const PairForce& pair : problem.recover(result.state).pairs) {
      otherwise += pair.state.status != reference.forces[pair.id].state.status;
      far = std::max(far, std::abs(pair.force - reference.forces[pair.id].force));
    }
    TEST_EQUALITY(otherwise, 0);
    TEST_COMPARE(far, <, 1e-6 * size);
  }
}

}  // namespace
}  // namespace suture
