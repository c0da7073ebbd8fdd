#include <suture/base/Timers.hpp>
#include <suture/solver/NonsymmetricSolver.hpp>

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosMultiVecTraits.hpp>
#include <BelosStubTsqrAdapter.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace suture {

namespace {

constexpr int kRestart = 120;      // iterations per basis, with two stored vectors each
constexpr double kProgress = 0.5;  // residual reduction by a restart above which it stagnates at round-off

/// Krylov vectors z = M r together with r. Their inner product is r.z: orthogonality in the norm of the preconditioner, the stopping norm,
/// without a product with M or its inverse.
class DualVector {
 public:
  DualVector(MultiVectorPtr residual, MultiVectorPtr preconditioned)
      : residual_(std::move(residual)), preconditioned_(std::move(preconditioned)) {}

  MultiVector& r() { return *residual_; }
  const MultiVector& r() const { return *residual_; }
  MultiVector& z() { return *preconditioned_; }
  const MultiVector& z() const { return *preconditioned_; }

 private:
  MultiVectorPtr residual_, preconditioned_;
};

/// (r, z) -> (A z, M A z).
struct DualOperator {
  const Operator& matrix;
  const Preconditioner& preconditioner;
};

}  // namespace

}  // namespace suture

namespace Belos {

/// Operations act on both parts, except inner products.
template <>
class MultiVecTraits<double, suture::DualVector> {
  using Vectors = suture::DualVector;
  using Part = suture::MultiVector;
  using PartTraits = MultiVecTraits<double, Part>;
  using Small = Teuchos::SerialDenseMatrix<int, double>;
  template <typename Make>
  static Teuchos::RCP<Vectors> both(const Vectors& mv, const Make& make) {
    return Teuchos::rcp(new Vectors(make(mv.r()), make(mv.z())));
  }

 public:
  using tsqr_adaptor_type = details::StubTsqrAdapter<Vectors>;

  static Teuchos::RCP<Vectors> Clone(const Vectors& mv, int columns) {
    return both(mv, [&](const Part& part) { return PartTraits::Clone(part, columns); });
  }
  static Teuchos::RCP<Vectors> CloneCopy(const Vectors& mv) {
    return both(mv, [&](const Part& part) { return PartTraits::CloneCopy(part); });
  }
  static Teuchos::RCP<Vectors> CloneCopy(const Vectors& mv, const std::vector<int>& index) {
    return both(mv, [&](const Part& part) { return PartTraits::CloneCopy(part, index); });
  }
  static Teuchos::RCP<Vectors> CloneCopy(const Vectors& mv, const Teuchos::Range1D& index) {
    return both(mv, [&](const Part& part) { return PartTraits::CloneCopy(part, index); });
  }
  static Teuchos::RCP<Vectors> CloneViewNonConst(Vectors& mv, const std::vector<int>& index) {
    return Teuchos::rcp(new Vectors(PartTraits::CloneViewNonConst(mv.r(), index), PartTraits::CloneViewNonConst(mv.z(), index)));
  }
  static Teuchos::RCP<Vectors> CloneViewNonConst(Vectors& mv, const Teuchos::Range1D& index) {
    return Teuchos::rcp(new Vectors(PartTraits::CloneViewNonConst(mv.r(), index), PartTraits::CloneViewNonConst(mv.z(), index)));
  }
  static Teuchos::RCP<const Vectors> CloneView(const Vectors& mv, const std::vector<int>& index) {
    return CloneViewNonConst(const_cast<Vectors&>(mv), index);  // NOLINT: read-only view
  }
  static Teuchos::RCP<const Vectors> CloneView(const Vectors& mv, const Teuchos::Range1D& index) {
    return CloneViewNonConst(const_cast<Vectors&>(mv), index);  // NOLINT: read-only view
  }
  static ptrdiff_t GetGlobalLength(const Vectors& mv) { return PartTraits::GetGlobalLength(mv.r()); }
  static int GetNumberVecs(const Vectors& mv) { return PartTraits::GetNumberVecs(mv.r()); }
  static bool HasConstantStride(const Vectors& mv) { return mv.r().isConstantStride() && mv.z().isConstantStride(); }

  static void MvTimesMatAddMv(double alpha, const Vectors& a, const Small& b, double beta, Vectors& mv) {
    PartTraits::MvTimesMatAddMv(alpha, a.r(), b, beta, mv.r());
    PartTraits::MvTimesMatAddMv(alpha, a.z(), b, beta, mv.z());
  }
  static void MvAddMv(double alpha, const Vectors& a, double beta, const Vectors& b, Vectors& mv) {
    PartTraits::MvAddMv(alpha, a.r(), beta, b.r(), mv.r());
    PartTraits::MvAddMv(alpha, a.z(), beta, b.z(), mv.z());
  }
  static void MvScale(Vectors& mv, double alpha) {
    PartTraits::MvScale(mv.r(), alpha);
    PartTraits::MvScale(mv.z(), alpha);
  }
  static void MvScale(Vectors& mv, const std::vector<double>& alpha) {
    PartTraits::MvScale(mv.r(), alpha);
    PartTraits::MvScale(mv.z(), alpha);
  }
  static void MvTransMv(double alpha, const Vectors& a, const Vectors& b, Small& c) { PartTraits::MvTransMv(alpha, a.r(), b.z(), c); }
  static void MvDot(const Vectors& a, const Vectors& b, std::vector<double>& dots) { PartTraits::MvDot(a.r(), b.z(), dots); }
  static void MvNorm(const Vectors& mv, std::vector<double>& norms, NormType = TwoNorm) {
    PartTraits::MvDot(mv.r(), mv.z(), norms);
    for (double& norm : norms) norm = std::sqrt(std::max(norm, 0.0));
  }
  static void SetBlock(const Vectors& a, const std::vector<int>& index, Vectors& mv) {
    PartTraits::SetBlock(a.r(), index, mv.r());
    PartTraits::SetBlock(a.z(), index, mv.z());
  }
  static void SetBlock(const Vectors& a, const Teuchos::Range1D& index, Vectors& mv) {
    PartTraits::SetBlock(a.r(), index, mv.r());
    PartTraits::SetBlock(a.z(), index, mv.z());
  }
  static void Assign(const Vectors& a, Vectors& mv) {
    PartTraits::Assign(a.r(), mv.r());
    PartTraits::Assign(a.z(), mv.z());
  }
  static void MvRandom(Vectors& mv) { PartTraits::MvRandom(mv.z()); }
  static void MvInit(Vectors& mv, double alpha = 0.0) {
    PartTraits::MvInit(mv.r(), alpha);
    PartTraits::MvInit(mv.z(), alpha);
  }
  static void MvPrint(const Vectors& mv, std::ostream& os) {
    PartTraits::MvPrint(mv.r(), os);
    PartTraits::MvPrint(mv.z(), os);
  }
};

template <>
class OperatorTraits<double, suture::DualVector, suture::DualOperator> {
 public:
  static void Apply(const suture::DualOperator& op, const suture::DualVector& x, suture::DualVector& y, ETrans = NOTRANS) {
    op.matrix.apply(x.z(), y.r());
    op.preconditioner.apply(y.r(), y.z());
  }
  static bool HasApplyTranspose(const suture::DualOperator&) { return false; }
};

}  // namespace Belos

namespace suture {

InnerResult solveNonsymmetric(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                              const MultiVector& b, MultiVector& x, double tolerance, double reference, int most) {
  using Problem = Belos::LinearProblem<double, DualVector, DualOperator>;
  const double begin = Timers::now();
  x.putScalar(0.0);
  const auto copy = [&] { return Teuchos::rcp(new MultiVector(b, Teuchos::Copy)); };
  const auto nothing = [&] { return preconditioner->space()->vector(); };
  const auto right = Teuchos::rcp(new DualVector(copy(), nothing()));
  preconditioner->apply(right->r(), right->z());
  const double norm = std::sqrt(std::max(dot(right->r(), right->z()), 0.0));
  if (!std::isfinite(norm)) throw NumericalError("the right-hand side of the inner solver is not finite");
  InnerResult result;
  result.reference = reference > 0.0 ? reference : norm;
  result.residual = norm > 0.0 ? norm / result.reference : 0.0;
  result.history.push_back(result.residual);
  if (result.residual <= tolerance) {
    result.converged = true;
    return result;
  }
  const auto operation = Teuchos::rcp(new DualOperator{*matrix, *preconditioner});
  // The basis contains the round-off of a single-precision preconditioner: recompute the residual and solve for the remainder.
  for (double before = 0.0; result.pcg < most; before = result.residual) {
    const auto answer = Teuchos::rcp(new DualVector(nothing(), nothing()));
    const auto problem = Teuchos::rcp(new Problem(operation, answer, right));
    problem->setProblem();
    const auto options = Teuchos::parameterList();
    options->set("Num Blocks", std::min(kRestart, most));
    options->set("Maximum Iterations", most - result.pcg);
    options->set("Maximum Restarts", most / kRestart + 1);
    options->set("Convergence Tolerance", tolerance * result.reference);
    options->set("Implicit Residual Scaling", "None");
    options->set("Explicit Residual Scaling", "None");
    options->set("Orthogonalization", "ICGS");
    options->set("Verbosity", static_cast<int>(Belos::Errors));
    Belos::BlockGmresSolMgr<double, DualVector, DualOperator> solver(problem, options);
    try {
      solver.solve();
    } catch (const Belos::BelosError& error) {
      throw NumericalError(std::string("GMRES broke down: ") + error.what());
    }
    x.update(1.0, answer->z(), 1.0);
    result.pcg += solver.getNumIters() + 1;
    matrix->apply(x, right->r());
    right->r().update(1.0, b, -1.0);
    preconditioner->apply(right->r(), right->z());
    result.residual = std::sqrt(std::max(dot(right->r(), right->z()), 0.0)) / result.reference;
    if (!std::isfinite(result.residual)) throw NumericalError("a residual is not a number");
    result.converged = result.residual <= tolerance;
    if (result.converged || (before > 0.0 && result.residual > kProgress * before)) break;
  }
  result.history.push_back(result.residual);
  result.seconds = Timers::now() - begin;
  return result;
}

}  // namespace suture
