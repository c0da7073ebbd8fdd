#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/Preconditioners.hpp>

namespace suture {
namespace {

using namespace blocks;

// Conjugate gradients with dense Schur complements follow those with the paper's back-substitutions, step by step.
TEUCHOS_UNIT_TEST(ExplicitIterates, AreThoseOfImplicitSchurComplements) {
  for (const Scene& scene : {clampedSquare(4, 6), stackedBlocks(2)}) {
    const Interface one(scene, world(), {}, "CHOLMOD", "Explicit"), other(scene, world(), {}, "CHOLMOD", "Implicit");
    const MultiVectorPtr load = one.space->vector();
    Matrix values = Matrix::Zero(localView(*load).rows(), 1);
    for (int i = 0; i < values.rows(); ++i) values(i, 0) = std::sin(1.0 + static_cast<double>(one.space->map()->getGlobalElement(i)));
    localView(*load) = values;
    const Lanczos explicitly = conjugateGradients(one.matrix(), *bddc(one.linearised.matrix), *one.space, *load);
    const Lanczos implicitly = conjugateGradients(other.matrix(), *bddc(other.linearised.matrix), *other.space, *load);
    TEST_EQUALITY(explicitly.iterations, implicitly.iterations);
    TEST_COMPARE(explicitly.iterations, >=, 4);
    double worst = 0.0;
    for (int k = 0; k < std::min(explicitly.iterations, implicitly.iterations); ++k) {
      const double squares[2] = {(explicitly.iterates[k] - implicitly.iterates[k]).squaredNorm(), implicitly.iterates[k].squaredNorm()};
      double all[2];
      Teuchos::reduceAll(*one.space->comm(), Teuchos::REDUCE_SUM, 2, squares, all);
      worst = std::max(worst, std::sqrt(all[0] / all[1]));
    }
    out << explicitly.iterations << " steps, largest relative difference " << worst << "\n";
    TEST_COMPARE(worst, <, 1e-10);
  }
}

}  // namespace
}  // namespace suture
