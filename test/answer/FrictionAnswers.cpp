// Results of sliding pairs, and the verdict on them: it accepts answers known by hand, and names planted errors.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/RubbingBlocks.hpp>
#include <suture/answer/Doubts.hpp>
#include <suture/answer/values/Reactions.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>
#include <limits>

namespace suture {
namespace frictionanswers {

using solids::operator*;
using solids::RubbingBlocks;
using solids::Rubs;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const Eigen::Matrix3d kFrame = solids::rotation({1, 2, -0.5}, 0.9);

const Check* find(const Verification& verdict, const std::string& name) {
  const auto at = std::find_if(verdict.checks.begin(), verdict.checks.end(), [&](const Check& one) { return one.name == name; });
  return at == verdict.checks.end() ? nullptr : &*at;
}

std::size_t warningsOf(const Verification& verdict) {
  Doubts doubts;
  doubts.add(verdict);
  return doubts.warnings().size();
}

RubbingBlocks blocks(Rubs way, int dimension, bool onObstacle = false) {
  return {way, dimension, onObstacle, dimension == 3 ? kFrame : Eigen::Matrix3d::Identity().eval()};
}

TEUCHOS_UNIT_TEST(FrictionAnswers, HoldInPlaneAndSpaceOnBodiesAndObstacles) {
  for (const Rubs way : {Rubs::Slip, Rubs::TrescaSlip, Rubs::Stick, Rubs::Glued, Rubs::Guided})
    for (const int dimension : {2, 3})
      for (const bool onObstacle : {false, true}) {
        const RubbingBlocks answer = blocks(way, dimension, onObstacle);
        const Verification verdict = answer.verdict();
        out << int(way) << " " << dimension << " " << onObstacle << ": " << verdict.failure() << "\n";
        TEST_ASSERT(verdict.holds());
        TEST_COMPARE(verdict.balance.imbalance, <, 1e-11);
        const int offset = onObstacle ? 0 : 1;  // first of the laws that restrict sliding
        TEST_EQUALITY(verdict.checks.size(), way == Rubs::Guided ? 14 : 17 + offset);
      }
}

TEUCHOS_UNIT_TEST(FrictionAnswers, HaveForcesSlipsBoundsAndWorkOfAUniformStress) {
  for (const int dimension : {2, 3})
    for (const bool onObstacle : {false, true})
      for (const Rubs way : {Rubs::Slip, Rubs::TrescaSlip, Rubs::Stick, Rubs::Glued, Rubs::Guided}) {
        const RubbingBlocks answer = blocks(way, dimension, onObstacle);
        if (solids::world()->getRank() > 0) continue;
        const Point slip = answer.frame * scaled(answer.slides() ? (onObstacle ? 1 : -1) * RubbingBlocks::slid : 0.0, answer.along);
        double work = 0.0, bound = 0.0;
        for (const PairResult& pair : answer.pairs) {
          TEST_COMPARE(norm(minus(pair.slip, slip)), <, 1e-15);
          TEST_COMPARE(norm(minus(pair.tangential, scaled(pair.length, answer.tangential()))), <, 1e-15);
          TEST_EQUALITY(pair.kind.separates, way != Rubs::Glued && way != Rubs::Guided);
          TEST_EQUALITY(pair.kind.restrictsSliding, way != Rubs::Guided);
          work += pair.dissipated;
          bound += pair.bound;
        }
        const bool frictional = way == Rubs::Slip || way == Rubs::TrescaSlip;
        TEST_COMPARE(std::abs(work - (frictional ? answer.shear() * RubbingBlocks::slid : 0.0)), <, 1e-15);  // the joint has the size 1
        TEST_COMPARE(std::abs(bound - (frictional ? 1 : way == Rubs::Stick ? 2 : 0) * answer.shear()), <, 1e-13);
        const ContactResultant sum = contactResultants(answer.pairs, 1, false)[0];
        const Point normal = answer.pairs.front().normal;
        TEST_COMPARE(norm(minus(sum.onB.force, plus(scaled(answer.pressure(), normal), answer.tangential()))), <, 1e-13);
      }
}

TEUCHOS_UNIT_TEST(FrictionAnswers, SeeTheSlipOfAMotionThatWasTakenOut) {
  for (const int dimension : {2, 3}) {
    RubbingBlocks answer = blocks(Rubs::Slip, dimension);
    const std::vector<PairResult> before = answer.pairs;
    answer.lift();
    const Verification verdict = answer.verdict();
    out << verdict.failure() << "\n";
    TEST_ASSERT(verdict.holds());
    for (std::size_t i = 0; i < before.size(); ++i) TEST_COMPARE(norm(minus(before[i].slip, answer.pairs[i].slip)), <, 1e-15);
  }
}

/// Cells of the joint are a quarter long.
TEUCHOS_UNIT_TEST(FrictionAnswers, SlideBesideTheirPartners) {
  for (const bool isLifted : {false, true})
    for (const int dimension : {2, 3})
      for (const bool onObstacle : {false, true})
        for (const double shift : {0.1, 0.15, 0.25}) {
          RubbingBlocks answer = blocks(Rubs::Slip, dimension, onObstacle);
          answer.moveUpper([&](Point& u) { u = plus(u, scaled(shift, answer.along)); });
          if (isLifted) answer.lift();
          const Verification verdict = answer.verdict();
          const Check* slide = find(verdict, "slide");
          TEST_ASSERT(slide);
          if (!slide) continue;
          out << dimension << " " << onObstacle << " " << shift << " " << slide->value << " " << slide->where << "\n";
          const double slid = onObstacle ? 0.0 : (shift + RubbingBlocks::slid) / 0.25;  // the plane continues
          TEST_COMPARE(std::abs(slide->value - slid), <, 1e-10);
          TEST_EQUALITY(slide->holds(), onObstacle || shift < 0.25);
          TEST_EQUALITY(warningsOf(verdict), !onObstacle && shift == 0.15 ? 1 : 0);
          if (slide->holds()) continue;
          TEST_ASSERT(verdict.failure().find("slide 1.0e+00 exceeds 9.9e-01 (pair ") != std::string::npos);
          TEST_ASSERT(verdict.failure().find("bodies 'lower' and 'upper'") != std::string::npos);
        }
}

/// Glued blocks, the upper one pulled away: the force of half a square's shear at two places.
TEUCHOS_UNIT_TEST(FrictionAnswers, MissTheMomentAcrossAGap) {
  for (const double gap : {0.01, 0.1, 0.2}) {
    RubbingBlocks answer = blocks(Rubs::Glued, 2);
    for (SubdomainMesh& mesh : answer.meshes)
      for (int node = 0; mesh.body == answer.upper() && node < mesh.nodes(); ++node) mesh.coordinates[2 * std::size_t(node) + 1] += gap;
    const Verification verdict = answer.verdict();
    const Check* offset = find(verdict, "offset");
    TEST_ASSERT(offset);
    if (!offset) continue;
    // Half of the sum of magnitudes: shear on two sides, the stress vector on top and on the joint.
    const double stress = std::hypot(answer.pressure(), answer.shear()), force = 0.5 * (2 * answer.shear() + 2 * stress);
    TEST_FLOATING_EQUALITY(offset->value, gap * answer.shear() / (force * std::sqrt(0.5)), 1e-6);
    TEST_EQUALITY(offset->holds(), gap < 0.2);
    TEST_EQUALITY(warningsOf(verdict), gap == 0.1 ? 1 : 0);
  }
}

/// Normal forces that cancel up to the solver's error have no centre.
TEUCHOS_UNIT_TEST(FrictionAnswers, HaveACentreOnlyWhereTheyPress) {
  std::vector<PairResult> pairs(2);
  for (PairResult& pair : pairs) pair.line = 0, pair.tangential = {1.0, 0, 0};
  pairs[0].force = 0.5, pairs[1].force = -0.5 + 1e-12;
  pairs[1].position = {1, 0, 0};
  TEST_ASSERT(!contactResultants(pairs, 1, false)[0].presses());
  pairs[1].force = 1.5;
  const ContactResultant line = contactResultants(pairs, 1, false)[0];
  TEST_ASSERT(line.presses());
  TEST_FLOATING_EQUALITY(line.centre[0], 0.75, 1e-14);
}

TEUCHOS_UNIT_TEST(PairResult, OpensWithoutForceBoundOrWork) {
  RubbingBlocks answer = blocks(Rubs::Slip, 2);
  for (PairResult& pair : answer.pairs) {
    pair.open();
    TEST_ASSERT(!pair.state.closed() && !pair.isBounded());
    TEST_EQUALITY(norm(pair.onB()) + pair.pressure + pair.bound + pair.dissipated, 0.0);
  }
}

struct Plant {
  const char* name;
  Rubs way;
  std::function<void(RubbingBlocks&)> plant;
};

/// One pair in the middle of the list, on rank 0.
std::function<void(RubbingBlocks&)> inPair(const std::function<void(PairResult&)>& change) {
  return [change](RubbingBlocks& a) {
    if (!a.pairs.empty()) change(a.pairs[a.pairs.size() / 2]);
  };
}

std::function<void(RubbingBlocks&)> shifted(double along, double up) {
  return [=](RubbingBlocks& a) {
    a.moveUpper([&](Point& u) {
      u = plus(u, scaled(along, a.along));
      u[std::size_t(a.dimension - 1)] += up;
    });
  };
}

const std::vector<Plant> plants{
    {"friction", Rubs::Slip, inPair([](PairResult& pair) { pair.tangential = scaled(1.001, pair.tangential); })},
    {"friction", Rubs::Slip, inPair([](PairResult& pair) { pair.tangential = scaled(0.999, pair.tangential); })},
    {"friction", Rubs::Slip, inPair([](PairResult& pair) { pair.state.friction *= 0.999; })},
    {"friction", Rubs::Slip, inPair([](PairResult& pair) { pair.tangential = plus(pair.tangential, scaled(1e-4, pair.normal)); })},
    {"friction", Rubs::Slip, inPair([](PairResult& pair) { pair.tangential = scaled(kNaN, pair.tangential); })},
    {"dissipation", Rubs::Slip, inPair([](PairResult& pair) { pair.tangential = scaled(-1.0, pair.tangential); })},
    {"dissipation", Rubs::Slip, shifted(-2 * RubbingBlocks::slid, 0.0)},
    {"dissipation", Rubs::Slip, inPair([](PairResult& pair) { pair.tangential = scaled(kNaN, pair.tangential); })},
    {"slip", Rubs::Slip, inPair([](PairResult& pair) { pair.state.status = PairStatus::Stick; })},
    {"friction", Rubs::TrescaSlip, inPair([](PairResult& pair) { pair.state.bound *= 1.001; })},
    {"friction", Rubs::TrescaSlip, inPair([](PairResult& pair) { pair.state = PairStatus::Open; })},
    {"slip", Rubs::Stick, shifted(1e-7, 0.0)},
    {"status", Rubs::Stick, shifted(0.0, 1e-7)},
    {"friction", Rubs::Stick, inPair([](PairResult& pair) { pair.state.friction *= 0.499; })},
    {"friction", Rubs::Stick, inPair([](PairResult& pair) { pair.state.status = PairStatus::Slip; })},
    {"residual", Rubs::Stick, inPair([](PairResult& pair) { pair.tangential = scaled(1.001, pair.tangential); })},
    {"residual", Rubs::Glued, inPair([](PairResult& pair) { pair.tangential = scaled(1.001, pair.tangential); })},
    {"slip", Rubs::Glued, shifted(1e-7, 0.0)},
    {"status", Rubs::Glued, shifted(0.0, 1e-7)},
    {"status", Rubs::Glued, shifted(0.0, -1e-7)},
    {"status", Rubs::Glued, inPair([](PairResult& pair) { pair.state = PairStatus::Open; })},
    {"forces", Rubs::Glued, inPair([](PairResult& pair) { pair.force *= 1.01; })},
    {"status", Rubs::Guided, shifted(0.0, 1e-7)},
    {"friction", Rubs::Guided, inPair([](PairResult& pair) {
       pair.tangential = {1e-4, 0, 0};
     })},
};

TEUCHOS_UNIT_TEST(FrictionAnswers, FailByTheCheckThatSeesWhatIsPlanted) {
  for (const int dimension : {2, 3})
    for (const bool onObstacle : {false, true})
      for (std::size_t k = 0; k < plants.size(); ++k) {
        RubbingBlocks answer = blocks(plants[k].way, dimension, onObstacle);
        plants[k].plant(answer);
        const Verification verdict = answer.verdict();
        const Check* found = find(verdict, plants[k].name);
        TEST_ASSERT(found != nullptr);
        if (!found) continue;
        out << dimension << " " << k << ": " << found->name << " " << found->value << " of " << found->bound << " at " << found->where
            << "\n";
        TEST_ASSERT(!found->holds());
        TEST_ASSERT(!verdict.holds());
        TEST_ASSERT(verdict.failure().find(plants[k].name) != std::string::npos);
      }
}

/// A slip a thousand times smaller than the tolerance has no direction that could contradict that of the force.
TEUCHOS_UNIT_TEST(FrictionAnswers, TakeNoDirectionFromASlipThatIsRoundOff) {
  for (const int dimension : {2, 3}) {
    RubbingBlocks answer = blocks(Rubs::Slip, dimension);
    shifted(-RubbingBlocks::slid - 1e-12, 0.0)(answer);
    const Verification verdict = answer.verdict();
    for (const char* name : {"friction", "dissipation"}) {
      const Check* found = find(verdict, name);
      TEST_ASSERT(found && found->holds());
    }
  }
}

}  // namespace frictionanswers
}  // namespace suture
