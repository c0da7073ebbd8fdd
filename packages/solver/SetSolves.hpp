#pragma once
#include <suture/search/LinearContactSolver.hpp>
#include <suture/solver/OuterSolver.hpp>

#include <vector>

namespace suture {

/// Linear solver of StateSearch for frictionless contact on the interface: preconditioned conjugate gradients. Collective.
///
/// The norm of a residual is sqrt(r.M^-1 r) relative to the energy norm of the solution, sqrt(U.S U), for each cluster of bodies connected
/// by closed pairs. S is block diagonal in clusters, and each block is scaled by its own energy for conjugate gradients, so that a weak
/// cluster is solved as accurately as a strong one. At the end the residual of each body must also be small compared with the energy of the
/// body.
class SetSolves : public LinearContactSolver {
 public:
  /// \param inner  tolerance of the loosest solves
  SetSolves(OuterSolver::Run& run, double inner);

  /// Evaluates the given start of a run; run.done() is true if it is the solution.
  void evaluateStart();

  double loosest() const override { return inner_; }
  double tightest() const override { return run_.settings.tolerance; }
  ContactAnswer solve(const PairStates& states, double tolerance) override;
  void move(const Vector& motion) override;
  Vector motion() const override { return run_.result.state.rigid; }
  bool goesOn() override { return !run_.done() && !run_.stopRequested(); }

 private:
  void precondition(const InterfaceState& state, const Teuchos::RCP<InterfaceOperator>& matrix);
  void findClusters(const ClosedSet& closed);
  bool oneCluster() const;
  Vector energies(const InterfaceState& state) const;
  Vector lentNorms(const Vector& norms) const;
  Vector productsByPart(const MultiVector& r) const;
  void scaleBy(const InterfaceState& from, const InterfaceState& state, const MultiVector& load);
  double overestimate(const InterfaceState& state, double tolerance) const;
  void scale(MultiVector& x, bool inverse) const;
  double norm(const MultiVector& residual, const InterfaceState& state);
  double middle() const;
  PairResolution finalResolution() const;
  void chooseOrigin(const InterfaceState& from, InterfaceState& state, int& applications);
  bool oneSolve(InterfaceState& state, bool goOn, double requested, InnerResult& cost, int& applications);
  bool solveLinear(InterfaceState& state, bool goOn, double tolerance, const EnergyCriterion& criterion, InnerResult& cost,
                   int& applications);

  OuterSolver::Run& run_;
  const ContactSets& sets_;
  const double inner_;
  MultiVectorPtr step_;
  ClosedSet closed_;                // set of the last solve; empty if it cannot be resumed
  ContactStates preconditioned_;    // states for which the preconditioner was made
  bool hasPreconditioner_ = false;  // the same on all ranks, including those without a local problem
  Teuchos::RCP<InterfaceOperator> matrix_;
  std::vector<int> clusterOf_;  // by part
  Vector lift_;                 // energy norm of each cluster at the start of the last solve, which sets the round-off level
  Vector largest_;              // twice the largest energy of each part so far; sets the round-off level
  Vector found_;                // the same for solutions only, without the energy of closing gaps
  Vector size_;                 // reference norm of the residual of each cluster
  std::vector<double> scale_;   // per owned unknown, if scaled_
  bool scaled_ = false;         // several clusters, each scaled by its own energy. The same on all ranks
  double largestScale_ = 1.0;
  double reference_ = 0.0;
  double whole_ = 0.0;     // last global residual norm; single bodies may have more than their share
  double sharper_ = 1.0;   // factor on tolerances, for the residuals of single bodies
  InterfaceState start_;   // state and status of the first solve, until the second one
  bool deformed_ = false;  // the state is the answer of a solve, so its energy is a valid scale
};

}  // namespace suture
