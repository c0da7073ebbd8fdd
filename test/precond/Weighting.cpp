#include <Teuchos_UnitTestHarness.hpp>
#include <precond/Preconditioners.hpp>
#include <suture/precond/Weighting.hpp>

namespace suture {
namespace {

using namespace blocks;

/// A user's dense weighting: shares by multiplicity, plus a part that cancels in the sum over the two sides of a seam (the sides are
/// distinguished by the parity of their numbers).
class UsersWeighting : public Weighting {
 protected:
  void doSetup(const InterfaceSpace& space, const LocalProblems& locals) override {
    even_.setup(space, locals);
    locals_ = locals;
  }
  void doApply(int i, LocalView trace) const override {
    const Matrix mean = trace.colwise().mean().replicate(trace.rows(), 1);
    even_.apply(i, trace);
    trace += (locals_[i]->id() % 2 == 0 ? 0.1 : -0.1) * mean;
  }
  void doApplyTranspose(int i, LocalView flux) const override { doApply(i, flux); }

 private:
  MultiplicityWeighting even_;
  LocalProblems locals_;
};

const Registration<Weighting> users("Users Own", Schema("Of a user."),
                                    [](const Parameters&) { return std::make_unique<UsersWeighting>(); });

// sum_i R_i^T D_i R_i of the identity
Matrix partition(const Twins& t, const Weighting& weighting, const LocalProblems& locals) {
  const InterfaceSpace& space = *t.spread.space;
  Matrix seen;
  space.gather(*t.toSpread(Matrix::Identity(t.size(), t.size())), seen);
  Matrix sum = Matrix::Zero(seen.rows(), seen.cols());
  for (int i = 0; i < space.locals(); ++i) {
    if (!locals[i]) continue;
    Matrix trace(space.coupling(i).rows(), seen.cols());
    space.coupling(i).restrictTo(seen, trace);
    weighting.apply(i, trace);
    space.coupling(i).addTransposed(trace, sum);
  }
  const MultiVectorPtr owned = space.vector(t.size());
  space.scatterAdd(sum, *owned);
  return t.toDense(*owned);
}

std::unique_ptr<Weighting> make(const std::string& name) { return Registry<Weighting>::instance().make(name, Parameters()); }

TEUCHOS_UNIT_TEST(Weighting, SumsToTheIdentityOnEveryInterfaceDof) {
  const std::vector<std::string> names = Registry<Weighting>::instance().names();
  for (const char* name : {"Multiplicity", "Young", "Stiffness Diagonal", "Users Own"})
    TEST_ASSERT(std::find(names.begin(), names.end(), name) != names.end());
  Box box;
  box.blocksX = 2;
  const Scene strip = scenes::fromBoxes({box});  // two subdomains with the same trace
  for (const std::string& name : names) {
    std::vector<std::pair<Scene, std::vector<double>>> cases{{strip, {1.0, 1e6}}};
    if (name != "Users Own") {
      cases.push_back({clampedSquare(3, 2), board(3, 1e6, false)});
      cases.push_back({pressedBlocks(), {}});
    }
    for (const auto& [scene, young] : cases) {
      const Twins t(scene, young);
      const auto weighting = make(name);
      weighting->setup(*t.spread.space, t.spread.matrix().locals());
      TEST_COMPARE((partition(t, *weighting, t.spread.matrix().locals()) - Matrix::Identity(t.size(), t.size())).norm(), <, 1e-13);
      for (int i = 0; i < t.spread.space->locals(); ++i) {
        const int n = t.spread.space->coupling(i).rows();
        Matrix d = Matrix::Identity(n, n), transposed = d;
        weighting->apply(i, d);
        weighting->applyTranspose(i, transposed);
        TEST_COMPARE((d.transpose() - transposed).norm(), <, 1e-14);
      }
    }
  }
}

TEUCHOS_UNIT_TEST(Weighting, WithoutContactSumsOverThePlainSubdomains) {
  const Twins t(pressedBlocks());
  const auto plain = t.spread.problem.withoutContact();
  for (const char* name : {"Multiplicity", "Young", "Stiffness Diagonal"}) {
    const auto weighting = make(name);
    weighting->setup(*t.spread.space, plain->locals());
    TEST_COMPARE((partition(t, *weighting, plain->locals()) - Matrix::Identity(t.size(), t.size())).norm(), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Weighting, FollowsTheStifferSideOfAJumpOf1e6) {
  Box box;
  box.blocksX = 2;
  const Twins t(scenes::fromBoxes({box}), {1.0, 1e6});
  for (const char* name : {"Multiplicity", "Young", "Stiffness Diagonal"}) {
    const auto weighting = make(name);
    weighting->setup(*t.spread.space, t.spread.matrix().locals());
    for (int i = 0; i < t.spread.space->locals(); ++i) {
      Matrix ones = Matrix::Ones(t.spread.space->coupling(i).rows(), 1);
      weighting->apply(i, ones);
      const bool stiff = t.spread.matrix().locals()[i]->id() == 1;
      for (int k = 0; k < ones.rows(); ++k) {
        if (std::string(name) == "Multiplicity")
          TEST_EQUALITY(ones(k), 0.5)
        else if (std::string(name) == "Young")
          TEST_FLOATING_EQUALITY(ones(k), stiff ? 1e6 / (1e6 + 1) : 1 / (1e6 + 1), 1e-12)
        else
          TEST_COMPARE(stiff ? 1 - ones(k) : ones(k), <, 1e-5);  // the diagonals depend on the triangles there, too
      }
    }
  }
}

TEUCHOS_UNIT_TEST(Weighting, RefusesAnUnknownThatNobodyHolds) {
  const Twins t(clampedSquare(2, 3));
  LocalProblems some = t.spread.matrix().locals();
  for (auto& local : some)
    if (local->id() >= 2) local.reset();  // the seam between the last two is unchanged
  for (const char* name : {"Multiplicity", "Young", "Stiffness Diagonal"})
    TEST_THROW(make(name)->setup(*t.spread.space, some), NumericalError);
}

}  // namespace
}  // namespace suture
