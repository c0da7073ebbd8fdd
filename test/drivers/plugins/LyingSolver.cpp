// An outer solver with a false report: it solves the problem, perturbs the trace at one node and reports convergence. The verdict of the
// run must find the error. See lies.py.
#include <suture/solver/OuterSolver.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

namespace {

using namespace suture;

const char* const honest = "Active Set";

Schema schemaOfLies() {
  return Schema(Registry<OuterSolver>::instance().schemas().at(honest))
      .real("Lie", 1e-3, "Disturbance of one unknown, relative to the largest one.", Range{0.0, 1.0, false, false, {}});
}

class LyingSolver : public OuterSolver {
 public:
  explicit LyingSolver(const Parameters& own)
      : honest_(Registry<OuterSolver>::instance().make(honest, own)), lie_(own.get<double>("Lie")) {}

 protected:
  bool worksBySets() const override { return true; }
  bool wantsAuxiliary() const override { return false; }
  double auxiliaryTolerance(const OuterSettings& settings) const override { return settings.tolerance; }

  void doSolve(Run& run) const override {
    run.result = honest_->solve(run.problem, run.settings, run.monitor);
    const InterfaceProblem::Linearisation tangent = run.problem.linearise(run.result.state);
    const MultiVectorPtr step = tangent.matrix->space()->vector();
    // The last unknown of the first rank that owns one.
    const Comm& comm = *tangent.matrix->space()->comm();
    const int mine = step->getLocalLength() > 0 ? comm.getRank() : comm.getSize();
    int first = 0;
    Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(first));
    Teuchos::Array<double> largest(1);
    run.result.state.trace->normInf(largest());
    if (comm.getRank() == first) step->replaceLocalValue(int(step->getLocalLength()) - 1, 0, lie_ * largest[0]);
    run.problem.update(run.result.state, *step, 1.0);
    run.solved = true;
  }

 private:
  std::unique_ptr<OuterSolver> honest_;
  double lie_;
};

const Registration<OuterSolver> registration("Lying", schemaOfLies(),
                                             [](const Parameters& own) { return std::make_unique<LyingSolver>(own); });

}  // namespace
