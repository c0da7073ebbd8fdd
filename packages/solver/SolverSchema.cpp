#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/OuterSolver.hpp>
#include <suture/solver/SolverSchema.hpp>
#include <suture/subdomain/LocalSolver.hpp>
#include <suture/subdomain/SchurComplement.hpp>

namespace suture {

void addSolverParameters(Schema& scene) {
  scene.oneOf("Formulation", "Condensed Groups", {"Condensed Groups"},
              "Condensed Groups (the paper): the unknown is the trace on the interface, contact is hidden inside groups of subdomains.");

  auto methods = Registry<OuterSolver>::instance().schemas();
  methods.emplace(kMonolithic,
                  Schema("The whole system on one rank, one factorisation with the contact unknowns last, active set: for small "
                         "scenes and as a reference."));
  Schema outer("How the contact problem is solved; a scene without contact is linear and enters no outer loop.");
  outer.choice("Type", "Semismooth Newton", methods, "Name of the outer solver.");
  outer.real("Tolerance", 1e-8, "Of the preconditioned norm of the residual, relative to that of the lifted start.",
             {0.0, 1.0, true, true, {}});
  outer.integer("Maximum Iterations", 50, "Outer iterations at most.", Range::atLeast(0));
  outer.integer("Maximum Inner Iterations", 1000, "Conjugate gradient iterations of one linear solve at most.", Range::atLeast(1));
  scene.list("Outer Solver", outer);

  scene.list("Preconditioner", preconditionerSchema());

  Schema subdomain = subdomainSchema();
  subdomain.choice("Schur Complement", "Implicit", Registry<SchurComplement>::instance().schemas(), "How S_i is kept.");
  scene.list("Subdomain", subdomain);
}

}  // namespace suture
