// BDDC on contact lines whose meshes do not match, against the same lines with matching meshes.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <suture/constraints/BuildConstraints.hpp>

namespace suture {
namespace {

using namespace blocks;

/// Two bodies of two rows of square subdomains each, with so many cells along a subdomain, one upon the other, both held at their far ends.
struct Line {
  int length = 4, below = 8, above = 8;
  double youngBelow = 1.0, youngAbove = 1.0;
  bool carriedBelow = true;
  double shift = 0.0;  // of the subdomains above

  Scene scene() const {
    Box lower{"lower", 0.0, double(length), -2.0, 0.0, length * below, 2 * below, Cell::Quadrilateral4};
    Box upper{"upper", 0.0, double(length), 0.0, 2.0, length * above, 2 * above, Cell::Quadrilateral4};
    lower.blocksX = length, upper.blocksX = shift > 0.0 ? length / 2 : length;
    lower.blocksY = upper.blocksY = 2;
    Scene scene = scenes::fromBoxes({lower, upper}, 1.0, 0.3);
    scene.model.materialOfBody[0].young = youngBelow;
    scene.model.materialOfBody[1].young = youngAbove;
    Contact contact = Contact::between("lower_top", "upper_bottom");
    contact.coupling = Contact::Coupling::Mortar;
    contact.carrier = carriedBelow ? Contact::Carrier::SideA : Contact::Carrier::SideB;
    scene.constraints = buildConstraints(
        scene.mesh, {Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_top", {0, 0})}, {contact});
    return scene;
  }
  Line matching() const {
    Line line = *this;
    line.below = line.above = std::min(below, above);
    return line;
  }
};

struct Found {
  int iterations, coarse;
  double condition;
};

Found found(const Line& line, int openEvery = 0) {
  const Scene scene = line.scene();
  const OnInterface one(scene, world());
  const auto matrix = one.matrix(scene, openEvery);
  const auto m = bddc(matrix);
  const auto& space = *matrix->space();
  const MultiVectorPtr rhs = space.vector();
  Matrix values = Matrix::Zero(space.overlapSize(), 1);
  for (int place = 0; place < space.overlapSize(); ++place)
    if (space.ownedRow(place) >= 0) values(place, 0) = std::sin(double(space.id(place)));  // the same on any number of ranks
  space.scatterAdd(values, *rhs);
  const Lanczos lanczos = conjugateGradients(*matrix, *m, space, *rhs);
  return {lanczos.iterations, m->coarseSize(), lanczos.condition};
}

TEUCHOS_UNIT_TEST(MortarRows, KeepBddcSymmetricWithNoEigenvalueBelowOne) {
  Line line;
  line.length = 2;
  for (const auto& [below, above] : {std::pair(2, 3), std::pair(3, 2), std::pair(4, 4), std::pair(2, 5)})
    for (const bool carriedBelow : {true, false})
      for (const int open : {0, 2, 3}) {
        line.below = below, line.above = above, line.carriedBelow = carriedBelow;
        const Scene scene = line.scene();
        const OnInterface one(scene, world());
        const auto matrix = one.matrix(scene, open);
        for (const char* edges : {"Averages", "Rigid Modes"}) {
          const DensePair pair(*matrix, *bddc(matrix, edges));
          TEST_COMPARE(difference(pair.m, pair.m.transpose()), <, 1e-10);
          const Vector values = pair.eigenvalues();
          out << below << ":" << above << ", every " << open << " open, " << edges << ": " << values(0) << " .. "
              << values(values.size() - 1) << "\n";
          TEST_COMPARE(std::abs(values(0) - 1.0), <, 1e-8);
          TEST_COMPARE(values(values.size() - 1), <, 4.0);
        }
      }
}

// Condition within 1.6 times, coarse size within 1.1 times of the matching line with the same subdomains. Steps are to 1e-10: four more of
// them are three to 1e-8.
TEUCHOS_UNIT_TEST(MortarRows, AreAsGoodAsMatchingNodes) {
  for (const int cells : {4, 8}) {
    Line matching;
    matching.below = matching.above = cells;
    const Found reference = found(matching);
    out << "matching, " << cells << " cells: " << reference.condition << ", " << reference.iterations << ", " << reference.coarse << "\n";
    for (const auto& [below, above] : {std::pair(2, 3), std::pair(3, 2), std::pair(1, 3), std::pair(3, 1)})
      for (const bool carriedBelow : {true, false}) {
        Line line;
        line.below = cells * below / std::min(below, above), line.above = cells * above / std::min(below, above);
        line.carriedBelow = carriedBelow;
        const Found mortar = found(line);
        out << line.below << ":" << line.above << (carriedBelow ? " below" : " above") << ": " << mortar.condition << ", "
            << mortar.iterations << ", " << mortar.coarse << "\n";
        TEST_COMPARE(mortar.condition, <, 1.6 * reference.condition);
        TEST_COMPARE(mortar.iterations, <=, reference.iterations + 4);
        TEST_COMPARE(mortar.coarse, <, 1.1 * reference.coarse);
      }
  }
}

TEUCHOS_UNIT_TEST(MortarRows, DoNotFeelTheLengthOfTheLine) {
  Line line;
  line.below = 4, line.above = 6;
  const double shortLine = found(line).condition;
  line.length = 12;
  const double longLine = found(line).condition;
  out << shortLine << ", " << longLine << "\n";
  TEST_COMPARE(longLine, <, 1.05 * shortLine);
}

TEUCHOS_UNIT_TEST(MortarRows, DoNotFeelJumpsEitherWay) {
  for (const bool carriedBelow : {true, false})
    for (const double jump : {1e-3, 1e3}) {
      Line line;
      line.below = 6, line.above = 4;
      line.carriedBelow = carriedBelow;
      line.youngAbove = jump;
      const Found mortar = found(line), matching = found(line.matching());
      out << jump << (carriedBelow ? " below: " : " above: ") << mortar.condition << " (" << mortar.iterations << "), matching "
          << matching.condition << " (" << matching.iterations << ")\n";
      TEST_COMPARE(mortar.condition, <, 1.6 * matching.condition);
      TEST_COMPARE(mortar.iterations, <=, matching.iterations + 3);
      TEST_COMPARE(mortar.coarse, <, 1.1 * matching.coarse);
    }
}

TEUCHOS_UNIT_TEST(MortarRows, WorkWhereSomePairsAreOpenAndSubdomainsDoNotFaceEachOther) {
  for (const double shift : {0.0, 0.5})
    for (const int open : {0, 2, 4}) {
      Line line;
      line.below = 4, line.above = 6;
      line.shift = shift;
      const Found mortar = found(line, open);
      out << "every " << open << " open" << (shift > 0.0 ? ", shifted" : "") << ": " << mortar.condition << ", " << mortar.iterations
          << ", " << mortar.coarse << "\n";
      TEST_COMPARE(mortar.condition, <, 2.5);
    }
}

TEUCHOS_UNIT_TEST(MortarRows, AreUpdatedWherePairsOpenAndClose) {
  Line line;
  line.length = 2;
  line.below = 6, line.above = 9;
  const Scene scene = line.scene();
  const OnInterface one(scene, world());
  const auto withOpen = [&](std::map<int, ContactState> status) {
    return one.problem.linearise(one.problem.stateOf(zeros(one.all), status)).matrix;
  };
  const auto closed = withOpen({}), partly = withOpen({{1, PairStatus::Open}, {4, PairStatus::Open}});
  const auto again = bddc(closed), fresh = bddc(partly);
  for (const auto& matrix : {partly, closed, partly}) {
    again->initialize(matrix->space());
    again->compute(matrix);
  }
  TEST_COMPARE(difference(DensePair(*partly, *again).m, DensePair(*partly, *fresh).m), <, 1e-8);
}

}  // namespace
}  // namespace suture
