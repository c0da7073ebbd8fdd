// Preconditioners written in Python.
#include <algorithm>
#include <suture/base/Collective.hpp>
#include <suture/precond/NeumannNeumann.hpp>

#include "Strategies.hpp"

namespace suture::python {

namespace {

/// M^-1 = Q + (I - Q S) T (I - S Q) with T = sum_i R_i^T A_i R_i: the Python function returns A_i of each local problem, as a function of
/// the residual on its unknowns. Q is that of NeumannNeumann, none by default. Calls of Python are local, and an exception on one rank is
/// thrown on all ranks.
class PythonPreconditioner : public NeumannNeumann {
 public:
  static Schema schema(const std::string& doc) {
    Schema schema(doc);
    schema.choice("Weighting", "Stiffness Diagonal", Registry<suture::Weighting>::instance().schemas(),
                  "Weights of the subdomains at shared unknowns.");
    schema.choice("Coarse Space", "None", Registry<CoarseSpace>::instance().schemas(),
                  "Traces of a coarse problem that is solved in addition, as in Neumann-Neumann.");
    addCoarseParameters(schema);
    return schema;
  }

  PythonPreconditioner(py::object function, py::dict named, const Parameters& own)
      : NeumannNeumann(own), function_(std::move(function)), named_(std::move(named)) {}
  ~PythonPreconditioner() override {
    if (!interpreterHasEnded()) return;
    static_cast<void>(function_.release()), static_cast<void>(named_.release());
    for (py::object& one : actions_) static_cast<void>(one.release());
  }

 protected:
  void computeLocals() override {
    const LocalProblems& locals = matrix()->locals();
    Matrix diagonal = Matrix::Zero(space()->overlapSize(), 1);
    for (std::size_t i = 0; i < locals.size(); ++i)
      if (locals[i]) space()->coupling(static_cast<int>(i)).addTransposed(locals[i]->stiffnessDiagonal(), diagonal);
    space()->sumDensities(diagonal);
    collectively(*space()->comm(), "setting up the preconditioner", [&] {
      actions_.assign(locals.size(), py::none());
      for (std::size_t i = 0; i < locals.size(); ++i)
        if (locals[i]) actions_[i] = actionOf(static_cast<int>(i), locals[i], diagonal);
    });
  }

  void addLocals(const Matrix& residual, Matrix& sum) const override {
    collectively(*space()->comm(), "applying the preconditioner", [&] {
      for (std::size_t i = 0; i < actions_.size(); ++i) {
        if (actions_[i].is_none()) continue;
        const Coupling& coupling = space()->coupling(static_cast<int>(i));
        Matrix flux(coupling.rows(), 1);
        coupling.restrictTo(residual, flux);
        const auto trace = numbersOf<Vector>(called(actions_[i], kind(), py::make_tuple(Vector(flux.col(0))), py::dict()), kind(),
                                             "a value for each unknown");
        if (trace.size() != coupling.rows())
          throw InputError(kind(), "the Python function returned " + std::to_string(trace.size()) + " values for " +
                                       std::to_string(coupling.rows()) + " unknowns");
        if (!trace.allFinite()) throw InputError(kind(), "the Python function returned values that are not finite");
        coupling.addTransposed(trace, sum);
      }
    });
  }

 private:
  py::object actionOf(int i, const std::shared_ptr<const LocalProblem>& local, const Matrix& diagonal) const {
    const auto argument = std::make_shared<LocalArgument>(local);
    Matrix own(local->size(), 1);
    space()->coupling(i).restrictTo(diagonal, own);
    argument->shares = LocalArgument::Shares{{}, own.col(0)};
    own.setOnes();
    weighting().apply(i, own);
    if (own.rows() == 0 || isDiagonal(i, own.col(0))) argument->shares->weights = own.col(0);
    py::object action = called(function_, kind(), py::make_tuple(argument), named_);
    if (PyCallable_Check(action.ptr()) == 0)
      throw InputError(kind(), "the Python function returned " + typeOf(action) + "; expected a function of the residual");
    return action;
  }

  /// D_i is the diagonal matrix with these entries: a test with a vector of different entries.
  bool isDiagonal(int i, const Vector& diagonal) const {
    Matrix trial(diagonal.size(), 1);
    for (Eigen::Index k = 0; k < trial.rows(); ++k) trial(k, 0) = (k % 2 == 0 ? 1.0 : -1.0) * static_cast<double>(1 + k % 7);
    const Vector expected = diagonal.cwiseProduct(trial.col(0));
    weighting().apply(i, trial);
    return (trial.col(0) - expected).cwiseAbs().maxCoeff() <= 1e-12 * std::max(1.0, expected.cwiseAbs().maxCoeff());
  }

  py::object function_;
  py::dict named_;
  std::vector<py::object> actions_;  // by local problem; None: it does not take part
};

}  // namespace

void bindPreconditioners(py::module_& module) {
  module.def("register_preconditioner", [](const std::string& name, const py::object& function, const Defaults& defaults) {
    registerFunction<Preconditioner>(
        name, function, defaults,
        [](const py::object& f, const py::dict& named, const Parameters& own) {
          return std::make_unique<PythonPreconditioner>(f, named, own);
        },
        PythonPreconditioner::schema);
  });
}

}  // namespace suture::python
