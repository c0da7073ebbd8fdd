// BDDC on contact lines with non-matching meshes, against the same lines with matching meshes.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <support/Cases.hpp>
#include <suture/constraints/BuildConstraints.hpp>

#include <Tpetra_MultiVector.hpp>

#include <algorithm>

namespace suture {
namespace {

using namespace blocks;

/// Two stacked bodies of two rows of square subdomains each, with the given number of cells along a subdomain, both held at their far ends.
struct Line {
  int length = 4, below = 8, above = 8;
  double youngBelow = 1.0, youngAbove = 1.0;
  bool carriedBelow = true;
  bool wideAbove = false;       // subdomains above are twice as long
  bool restsOnContact = false;  // the upper body is held along x only

  Scene scene() const {
    Box lower{"lower", 0.0, double(length), -2.0, 0.0, length * below, 2 * below, Cell::Quadrilateral4};
    Box upper{"upper", 0.0, double(length), 0.0, 2.0, length * above, 2 * above, Cell::Quadrilateral4};
    lower.blocksX = length, upper.blocksX = wideAbove ? length / 2 : length;
    lower.blocksY = upper.blocksY = 2;
    Scene scene = scenes::fromBoxes({lower, upper}, 1.0, 0.3);
    scene.model.materialOfBody[0].young = youngBelow;
    scene.model.materialOfBody[1].young = youngAbove;
    Contact contact = Contact::between("lower_top", "upper_bottom");
    contact.coupling = Contact::Coupling::Mortar;
    contact.carrier = carriedBelow ? Contact::Carrier::SideA : Contact::Carrier::SideB;
    const Condition top = restsOnContact ? Condition::displacement("upper_top", {0}, {0}) : Condition::displacement("upper_top", {0, 0});
    scene.constraints = buildConstraints(scene.mesh, {Condition::displacement("lower_bottom", {0, 0}), top}, {contact});
    return scene;
  }
  Line matching() const {
    Line line = *this;
    line.below = line.above = std::min(below, above);
    return line;
  }
};

struct Found {
  int iterations;  // to 1e-8
  int coarse;
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
  const auto reached = std::find_if(lanczos.residuals.begin(), lanczos.residuals.end(), [](double r) { return r < 1e-8; });
  return {int(reached - lanczos.residuals.begin()) + 1, m->coarseSize(), lanczos.condition};
}

TEUCHOS_UNIT_TEST(MortarRows, KeepBddcSymmetricWithNoEigenvalueBelowOne) {
  Line line;
  line.length = 2;
  for (const auto& [below, above] : casesOf({std::pair(2, 3), std::pair(3, 2), std::pair(4, 4), std::pair(2, 5)}))
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

// Local problems name rows' unknowns that others determine; clusters of a further level would be loose in them.
TEUCHOS_UNIT_TEST(MortarRows, LeaveOutAFurtherLevel) {
  Line line;
  line.below = 2, line.above = 3;
  const Scene scene = line.scene();
  const OnInterface one(scene, world());
  const auto matrix = one.matrix(scene);
  const auto exact = bddcWith(matrix, {"Coarse Level Above=1000"}), level = bddcWith(matrix, {"Coarse Level Above=4"});
  TEST_EQUALITY(exact->remark(), "");
  TEST_INEQUALITY(level->remark().find("solved exactly"), std::string::npos);
  TEST_COMPARE(difference(DensePair(*matrix, *level).m, DensePair(*matrix, *exact).m), <, 1e-9);
}

// Condition within 1.6 times, steps within three, coarse size within 1.1 times of the matching line with the same subdomains.
TEUCHOS_UNIT_TEST(MortarRows, AreAsGoodAsMatchingNodes) {
  for (const int cells : casesOf({4, 8})) {
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
        TEST_COMPARE(mortar.iterations, <=, reference.iterations + 3);
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
  for (const bool wide : {false, true})
    for (const int open : {0, 2, 4}) {
      Line line;
      line.below = 4, line.above = 6;
      line.wideAbove = wide;
      const Found mortar = found(line, open);
      out << "every " << open << " open" << (wide ? ", wide" : "") << ": " << mortar.condition << ", " << mortar.iterations << ", "
          << mortar.coarse << "\n";
      TEST_COMPARE(mortar.condition, <, 2.5);
    }
}

/// The operator with some pairs open, the others closed.
Teuchos::RCP<InterfaceOperator> withOpen(const OnInterface& one, const std::function<bool(int)>& opens) {
  std::map<int, ContactState> status;
  for (int pair = 0; pair < one.problem.pairs(); ++pair)
    if (opens(pair)) status[pair] = PairStatus::Open;
  return one.problem.linearise(one.problem.stateOf(zeros(one.all), status)).matrix;
}

// Closed pairs whose rows leave the body loose where they straddle subdomains: any two pairs hold the body.
TEUCHOS_UNIT_TEST(MortarRows, HoldABodyThatRestsOnTwoPairs) {
  Line line;
  line.length = 2;
  line.restsOnContact = true;
  for (const auto& [below, above] : casesOf({std::pair(2, 3), std::pair(3, 2)})) {
    line.below = below, line.above = above;
    const Scene scene = line.scene();
    const OnInterface one(scene, world());
    const int last = one.problem.pairs() - 1;
    for (int first = 0; first < last; ++first)
      for (const int second : {first + 1, last}) {
        const auto matrix = withOpen(one, [&](int pair) { return pair != first && pair != second; });
        const DensePair pair(*matrix, *bddc(matrix));
        const Vector values = pair.eigenvalues();
        out << below << ":" << above << ", " << first << " and " << second << ": " << values(0) << " .. " << values(values.size() - 1)
            << "\n";
        TEST_COMPARE(std::abs(values(0) - 1.0), <, 1e-7);
        TEST_COMPARE(values(values.size() - 1), <, 10.0);
      }
  }
}

TEUCHOS_UNIT_TEST(MortarRows, AreUpdatedWherePairsOpenAndClose) {
  Line line;
  line.length = 2;
  line.below = 40, line.above = 60;
  const Scene scene = line.scene();
  const OnInterface one(scene, world());
  const auto closed = withOpen(one, [](int) { return false; }), partly = withOpen(one, [](int pair) { return pair == 1 || pair == 2; });
  const auto again = bddc(closed), fresh = bddc(partly);
  const double before = again->bytesRead();
  for (const auto& matrix : {partly, closed, partly}) {
    again->initialize(matrix->space());
    again->compute(matrix);
  }
  double mine[2] = {again->bytesRead() - fresh->bytesRead(), before}, all[2];
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 2, mine, all);
  TEST_COMPARE(all[0], >, 0.0);  // inverses are updated: an application also reads the updates
  TEST_COMPARE(all[0], <, 0.2 * all[1]);
  const MultiVectorPtr flux = closed->space()->vector(), updated = closed->space()->vector(), other = closed->space()->vector();
  Matrix values = Matrix::Zero(partly->space()->overlapSize(), 1);
  for (int place = 0; place < values.rows(); ++place)
    if (partly->space()->ownedRow(place) >= 0) values(place, 0) = std::sin(double(partly->space()->id(place)));
  partly->space()->scatterAdd(values, *flux);
  again->apply(*flux, *updated);
  fresh->apply(*flux, *other);
  const double size = std::sqrt(dot(*other, *other));
  updated->update(-1.0, *other, 1.0);
  TEST_COMPARE(std::sqrt(dot(*updated, *updated)), <, 1e-5 * size);  // inverses are in single precision
}

}  // namespace
}  // namespace suture
