// A user-defined preconditioner: the inverse of the stiffness matrix's diagonal on the interface. It is very cheap, but the number of PCG
// iterations grows with mesh refinement.
#include <Tpetra_MultiVector.hpp>
#include <suture/precond/Preconditioner.hpp>

using namespace suture;

namespace {

class DiagonalScaling : public Preconditioner {
 protected:
  void doCompute() override {
    // Contributions of this rank's local problems; the space sums over all ranks and over unknowns identified by contact.
    Matrix diagonal = Matrix::Zero(space()->overlapSize(), 1);
    for (int i = 0; i < space()->locals(); ++i)
      if (const auto& local = matrix()->locals()[i]) space()->coupling(i).addTransposed(local->stiffnessDiagonal(), diagonal);
    space()->sumDensities(diagonal);
    inverse_ = space()->vector();
    auto inverse = localView(*inverse_);
    for (int place = 0; place < space()->overlapSize(); ++place)
      if (const int row = space()->ownedRow(place); row >= 0 && diagonal(place, 0) > 0.0) inverse(row, 0) = 1.0 / diagonal(place, 0);
  }

  void doApply(const MultiVector& r, MultiVector& z) const override {
    const auto residual = localView(r);
    localView(z) = localView(*inverse_).col(0).asDiagonal() * residual;
  }

 private:
  MultiVectorPtr inverse_;
};

const Registration<Preconditioner> registration("Diagonal Scaling", Schema("the diagonal of the stiffness matrix on the interface"),
                                                [](const Parameters&) { return std::make_unique<DiagonalScaling>(); });

}  // namespace
