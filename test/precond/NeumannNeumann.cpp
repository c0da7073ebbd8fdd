#include <Teuchos_UnitTestHarness.hpp>
#include <precond/Preconditioners.hpp>
#include <suture/precond/Weighting.hpp>
#include <suture/precond/coarse/CoarseSpace.hpp>

namespace suture {
namespace {

using namespace blocks;

Matrix schur(const Twins& t) { return t.toDense(static_cast<const Operator&>(t.spread.matrix())); }

TEUCHOS_UNIT_TEST(NeumannNeumann, IsSymmetricAndPositive) {
  for (const Scene& scene : {clampedSquare(3, 3), pressedBlocks(), stackedBlocks(3)}) {
    const Twins t(scene);
    std::vector<Teuchos::RCP<const InterfaceOperator>> operators{t.spread.linearised.matrix};
    // S_0; not for the stacked blocks, whose middle one is held by contact alone, so that S_0 is singular
    if (t.spread.problem.pieces() == 1) operators.push_back(t.spread.problem.withoutContact());
    for (const auto& matrix : operators)
      for (const std::string& coarse : Registry<CoarseSpace>::instance().names()) {
        const auto preconditioner = neumannNeumann(t.spread, matrix, coarse);
        const Matrix m = t.toDense(static_cast<const Operator&>(*preconditioner));
        TEST_COMPARE(difference(m, m.transpose()), <, 1e-9);
        TEST_COMPARE(eigenvalues(m)(0), >, 1e-9 * m.norm());
        const Matrix r = random(t.size(), 1, 9);
        TEST_COMPARE(r.col(0).dot(m * r.col(0)), >, 0.0);
      }
  }
}

TEUCHOS_UNIT_TEST(NeumannNeumann, BalancesItsCoarseSpace) {
  for (const Scene& scene : {clampedSquare(3, 3), pressedBlocks()}) {
    const Twins t(scene);
    for (const char* name : {"Kernels", "Rigid Modes"}) {
      const auto m = neumannNeumann(t.spread, t.spread.linearised.matrix, name);
      const Matrix r = random(t.size(), 1, 4);
      const MultiVectorPtr z = t.spread.space->vector(), rest = t.toSpread(r);
      m->apply(*t.toSpread(r), *z);
      t.spread.matrix().apply(*z, *rest, Teuchos::NO_TRANS, -1.0, 1.0);
      Matrix seen;
      t.spread.space->gather(*rest, seen);
      const auto weighting = Registry<Weighting>::instance().make("Stiffness Diagonal", Parameters());
      weighting->setup(*t.spread.space, t.spread.matrix().locals());
      const auto coarse = Registry<CoarseSpace>::instance().make(name, Parameters());
      int columns = 0;
      for (int i = 0; i < t.spread.space->locals(); ++i) {
        Matrix modes = coarse->columns(*t.spread.matrix().locals()[i]), mine(modes.rows(), 1);
        weighting->apply(i, modes);
        t.spread.space->coupling(i).restrictTo(seen, mine);
        for (int k = 0; k < modes.cols(); ++k)
          TEST_COMPARE(std::abs(modes.col(k).dot(mine.col(0))), <, 1e-9 * modes.col(k).norm() * r.norm());
        columns += int(modes.cols());
      }
      int all = 0;
      Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, columns, Teuchos::outArg(all));
      TEST_COMPARE(all, >, 0);
      TEST_COMPARE(m->coarseSize(), <=, all);
    }
  }
}

TEUCHOS_UNIT_TEST(NeumannNeumann, HoldsTheModesThatItsNameSays) {
  const Twins t(clampedSquare(2, 4));  // two of four subdomains are held
  TEST_EQUALITY(neumannNeumann(t.spread, t.spread.linearised.matrix, "None")->coarseSize(), 0);
  TEST_EQUALITY(neumannNeumann(t.spread, t.spread.linearised.matrix, "Kernels")->coarseSize(), 2 * 3);
  TEST_EQUALITY(neumannNeumann(t.spread, t.spread.linearised.matrix, "Rigid Modes")->coarseSize(), 4 * 3);
}

// Balancing has no eigenvalue below one, and the eigenvalue one is that of the coarse space; Lanczos finds both ends of the dense spectrum.
TEUCHOS_UNIT_TEST(NeumannNeumann, ConditionIsThatOfDenseEigenvalues) {
  const Twins t(clampedSquare(2, 8, 1.0, 0.25));
  const Matrix s = schur(t);
  for (const char* coarse : {"None", "Kernels", "Rigid Modes"}) {
    const auto m = neumannNeumann(t.spread, t.spread.linearised.matrix, coarse);
    const Vector values = eigenvaluesOfProduct(t.toDense(static_cast<const Operator&>(*m)), s);
    const double condition = values(values.size() - 1) / values(0);
    if (std::string(coarse) != "None") TEST_COMPARE(std::abs(values(0) - 1.0), <, 1e-8);
    const Lanczos found = conjugateGradients(t.spread.matrix(), *m, *t.spread.space, *t.toSpread(random(t.size(), 1, 5)));
    TEST_COMPARE(std::abs(found.condition / condition - 1.0), <, 1e-2);
    out << coarse << ": condition " << condition << ", " << found.iterations << " iterations\n";
  }
}

// Unit square clamped on its left side, lambda = mu, H/h = 8. The bounds are the required ones; next to them the current values, to detect
// a drift. Both coarse spaces level off: each step to four times as many subdomains adds less than the one before.
TEUCHOS_UNIT_TEST(NeumannNeumann, ConditionLevelsOffFrom4To64Subdomains) {
  const int blocks[3] = {2, 4, 8};
  const std::map<std::string, std::pair<double, std::vector<double>>> expected{{"Rigid Modes", {3.5, {2.109, 3.092, 3.399}}},
                                                                               {"Kernels", {13.0, {2.477, 6.919, 8.509}}}};
  for (const auto& [coarse, bounds] : expected) {
    double found[3];
    for (int k = 0; k < 3; ++k) {
      found[k] = conditionOf(clampedSquare(blocks[k], 8, 1.0, 0.25), coarse).condition;
      out << coarse << ", " << blocks[k] * blocks[k] << " subdomains: condition " << found[k] << "\n";
      TEST_COMPARE(found[k], <, bounds.first);
      TEST_COMPARE(std::abs(found[k] / bounds.second[k] - 1.0), <, 0.02);
    }
    TEST_COMPARE(found[2] - found[1], <, 0.75 * (found[1] - found[0]));
  }
  const double none = conditionOf(clampedSquare(4, 8, 1.0, 0.25), "None").condition;
  out << "None, 16 subdomains: condition " << none << "\n";
  TEST_COMPARE(none, >, 100.0);
}

TEUCHOS_UNIT_TEST(NeumannNeumann, ConditionDoesNotFeelAnAlignedJumpOf1e6) {
  const Scene scene = clampedSquare(4, 4, 1.0, 0.25);
  const double uniform = conditionOf(scene, "Rigid Modes").condition;
  for (bool columns : {true, false}) {
    for (const char* weighting : {"Stiffness Diagonal", "Young", "Multiplicity"}) {
      const double jump = conditionOf(scene, "Rigid Modes", weighting, board(4, 1e6, columns)).condition;
      out << (columns ? "columns, " : "chess board, ") << weighting << ": condition " << jump << " (uniform " << uniform << ")\n";
      if (std::string(weighting) == "Multiplicity")
        TEST_COMPARE(jump, >, 100 * uniform)
      else
        TEST_COMPARE(jump, <, 1.1 * uniform);
    }
  }
}

TEUCHOS_UNIT_TEST(NeumannNeumann, ComputesAgainForAnotherStatus) {
  const Twins t(pressedBlocks());
  InterfaceState other = t.spread.closed;
  for (auto& rows : other.status)
    for (std::size_t p = 0; p < rows.size(); p += 2) rows[p] = PairStatus::Open;
  const auto linear = t.spread.problem.linearise(other);
  const auto again = neumannNeumann(t.spread, t.spread.linearised.matrix), fresh = neumannNeumann(t.spread, linear.matrix);
  again->compute(linear.matrix);
  const Matrix a = t.toDense(static_cast<const Operator&>(*again)), b = t.toDense(static_cast<const Operator&>(*fresh));
  TEST_COMPARE(difference(a, b), <, 1e-12);
  const Twins stranger(pressedBlocks());
  TEST_THROW(again->compute(stranger.spread.linearised.matrix), InternalError);
}

TEUCHOS_UNIT_TEST(NeumannNeumann, OneSubdomainHasNoInterfaceAndNoCoarseSpace) {
  const Twins t(clampedSquare(1, 4));
  TEST_EQUALITY(t.spread.space->size(), 0);
  const auto m = neumannNeumann(t.spread, t.spread.linearised.matrix);
  TEST_EQUALITY(m->coarseSize(), 0);
  const MultiVectorPtr r = t.spread.space->vector(), z = t.spread.space->vector();
  TEST_NOTHROW(m->apply(*r, *z));
}

TEUCHOS_UNIT_TEST(NeumannNeumann, RefusesUnknownNames) {
  TEST_THROW(resolved("Preconditioner", preconditionerSchema(), {"Neumann-Neumann/Coarse Space=Kernel"}), InputError);
  TEST_THROW(Registry<CoarseSpace>::instance().make("Kernel", Parameters()), InputError);
}

}  // namespace
}  // namespace suture
