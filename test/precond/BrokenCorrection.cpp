// Local solutions before averaging: their forces balance a residual, and their energies sum to its norm.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/Preconditioners.hpp>
#include <suture/constraints/BuildConstraints.hpp>

#include <Tpetra_MultiVector.hpp>

namespace suture {
namespace {

using namespace blocks;
using Matrices = std::vector<Teuchos::RCP<const InterfaceOperator>>;

/// S x for an x that is the same on any number of ranks.
MultiVectorPtr someResidual(const InterfaceOperator& matrix) {
  const InterfaceSpace& space = *matrix.space();
  const MultiVectorPtr x = space.vector(), r = space.vector();
  auto values = localView(*x);
  for (Eigen::Index k = 0; k < values.rows(); ++k) values(k, 0) = std::sin(1.0 + 12.9898 * double(space.map()->getGlobalElement(int(k))));
  matrix.apply(*x, *r);
  return r;
}

/// Forces sum_i R_i^T S_i w_i of traces, and sum_i w_i.S_i w_i.
struct Forces {
  MultiVectorPtr sum;
  double energy = 0.0;

  Forces(const InterfaceOperator& matrix, const std::vector<Vector>& traces) : sum(matrix.space()->vector()) {
    Matrix overlap = Matrix::Zero(matrix.space()->overlapSize(), 1);
    double mine = 0.0;
    for (std::size_t i = 0; i < traces.size(); ++i) {
      Matrix flux(traces[i].size(), 1);
      matrix.locals()[i]->applySchur(traces[i], flux);
      mine += traces[i].dot(flux.col(0));
      matrix.space()->coupling(int(i)).addTransposed(flux, overlap);
    }
    matrix.space()->scatterAdd(overlap, *sum);
    Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(energy));
  }
};

struct Balance {
  double rest;             // forces that are left, relative to the residual
  double energy, squared;  // of the traces, and r.M^-1 r
};

/// After some applications to what is left.
Balance balanceBy(const InterfaceOperator& matrix, const Preconditioner& m, int applications = 1) {
  const MultiVectorPtr r = someResidual(matrix), z = matrix.space()->vector();
  m.apply(*r, *z);
  const double squared = dot(*r, *z), size = std::sqrt(dot(*r, *r));
  std::vector<Vector> sum;
  const MultiVectorPtr rest = Teuchos::rcp(new MultiVector(*r, Teuchos::Copy));
  for (int k = 0; k < applications; ++k) {
    std::vector<Vector> traces = *m.brokenCorrection(*rest);
    for (std::size_t i = 0; i < sum.size(); ++i) traces[i] += sum[i];
    sum = std::move(traces);
    rest->update(1.0, *r, -1.0, *Forces(matrix, sum).sum, 0.0);
  }
  return {std::sqrt(dot(*rest, *rest)) / size, Forces(matrix, sum).energy, squared};
}

/// A contact line whose meshes do not match.
Scene mortarLine() {
  Box lower{"lower", 0, 3, -2, 0, 12, 8, Cell::Quadrilateral4}, upper{"upper", 0, 3, 0, 2, 18, 12, Cell::Quadrilateral4};
  lower.blocksX = upper.blocksX = 3;
  lower.blocksY = upper.blocksY = 2;
  Scene scene = scenes::fromBoxes({lower, upper}, 1.0, 0.3);
  Contact contact = Contact::between("lower_top", "upper_bottom");
  contact.coupling = Contact::Coupling::Mortar;
  scene.constraints = buildConstraints(
      scene.mesh, {Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_top", {0}, {0})}, {contact});
  return scene;
}

TEUCHOS_UNIT_TEST(BrokenCorrection, OfBddcBalancesAndHasTheNormOfTheResidual) {
  for (const Scene& scene : {turned(crossingBlocks(), 0.5), pressedBlocks(), heldOnTheLine(), mortarLine()})
    for (const int open : {0, 3}) {
      const OnInterface one(scene, world());
      const auto matrix = one.matrix(scene, open);
      for (const std::vector<std::string>& settings : {std::vector<std::string>{"Edge Constraints=Rigid Modes"},
                                                       {"Edge Constraints=None", "Weighting=Multiplicity"},
                                                       {"Edge Constraints=Adaptive", "Weighting=Deluxe"},
                                                       {"Local Inverses=Sparse"}}) {
        const auto m = bddcWith(matrix, settings);
        const Balance found = balanceBy(*matrix, *m), again = balanceBy(*matrix, *m, 3);
        out << settings.front() << ": left " << found.rest << ", " << again.rest << "; energy " << found.energy << " of " << found.squared
            << "\n";
        TEST_COMPARE(found.rest, <, 1e-6);  // inverses may be stored in single precision
        TEST_COMPARE(again.rest, <, 1e-11);
        TEST_FLOATING_EQUALITY(found.energy, found.squared, 1e-6);
      }
    }
}

// With an approximate coarse solve each application leaves a part of the forces, at most its accuracy.
TEUCHOS_UNIT_TEST(BrokenCorrection, OfAnApproximateCoarseSolveBalancesWhenRepeated) {
  const OnInterface one(pressed(wavyBlocks(twoBoxes(16, 12, 4, 3))), world());
  const auto matrix = one.matrix(pressed(wavyBlocks(twoBoxes(16, 12, 4, 3))), 3);
  const auto m = bddcWith(matrix, {"Coarse Level Above=10"});
  const Balance first = balanceBy(*matrix, *m), last = balanceBy(*matrix, *m, 20);
  out << "left " << first.rest << ", " << last.rest << "; energy " << first.energy << ", " << last.energy << " of " << last.squared << "\n";
  TEST_COMPARE(first.rest, >, 1e-6);  // the level is used
  TEST_COMPARE(last.rest, <, 1e-11);
  TEST_FLOATING_EQUALITY(last.energy, last.squared, 0.1);
}

TEUCHOS_UNIT_TEST(BrokenCorrection, OfNeumannNeumannBalances) {
  for (const Scene& scene : {clampedSquare(3, 3), pressedBlocks(), stackedBlocks(2)}) {
    const Twins t(scene);
    for (const char* coarse : {"Kernels", "Rigid Modes"}) {
      const Balance found = balanceBy(t.spread.matrix(), *neumannNeumann(t.spread, t.spread.linearised.matrix, coarse));
      out << coarse << ": left " << found.rest << "; energy " << found.energy << " of " << found.squared << "\n";
      TEST_COMPARE(found.rest, <, 1e-9);
      TEST_COMPARE(found.energy, >, 0.0);
    }
  }
}

}  // namespace
}  // namespace suture
