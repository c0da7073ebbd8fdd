#pragma once
#include <suture/contact/ContactSearch.hpp>
#include <suture/solver/OuterSolver.hpp>

#include <vector>

namespace suture {

/// The linear problems of a closed set on the interface, by preconditioned conjugate gradients: what ContactSearch asks of a formulation.
/// Three accuracies: the inner tolerance, half way to the final one, the final one. Collective.
///
/// The norm of a residual is sqrt(r.M r) relative to the energy norm of the solution, sqrt(U.S U), cluster by cluster of bodies that closed
/// pairs connect: there S is block diagonal, and each block is scaled by its own energy before conjugate gradients see it. A weak cluster
/// has as many digits as a strong one beside it. At the end the residual of each body must be small beside the energy of the body, too.
class SetSolves : public ContactOracle {
 public:
  /// \param inner  tolerance of the loosest solves;  \param loose  no others: the answer is a start for something else
  SetSolves(OuterSolver::Run& run, double inner, bool loose = false);

  /// Evaluates the start that a run goes on from; run.done() tells whether it is the solution.
  void evaluateStart();

  int levels() const override { return levels_; }
  ContactAnswer solve(const ClosedSet& closed, int level) override;
  Change redistribute(const ClosedSet& closed, const Vector& given) override;
  void move(const Vector& motion) override;
  Vector motion() const override { return run_.result.state.rigid; }
  ClosedSet proposal() override { return sets_.proposal(run_.result.state); }
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
  double tolerance(int level) const;
  PairResolution finalResolution() const;
  void chooseOrigin(const InterfaceState& from, InterfaceState& state, int& applications);
  bool oneSolve(InterfaceState& state, bool goOn, int level, InnerResult& cost, int& applications);
  bool solveLinear(InterfaceState& state, bool goOn, double tolerance, const EnergyCriterion& criterion, InnerResult& cost,
                   int& applications);

  static constexpr int kFinal = 2;  // level of the final tolerance

  OuterSolver::Run& run_;
  const ContactSets& sets_;
  const double inner_;
  const int levels_;
  MultiVectorPtr step_;
  ClosedSet closed_;                // set of the last solve; empty if that cannot be resumed
  ContactStates preconditioned_;    // states that the preconditioner was made for
  bool hasPreconditioner_ = false;  // the same on all ranks, also on those without a local problem
  Teuchos::RCP<InterfaceOperator> matrix_;
  std::vector<int> clusterOf_;  // of each part
  Vector lift_;                 // energy norm of each cluster where the last solve began: rounding leaves a part of it
  Vector largest_;              // largest doubled energy that each part has had; sets what counts as rounding
  Vector found_;                // the same of answers of solves, without what closing gaps took
  Vector size_;                 // of each cluster, that its residual was relative to
  std::vector<double> scale_;   // of each owned unknown, if scaled_
  bool scaled_ = false;         // several clusters, each by its own energy. The same on all ranks
  double largestScale_ = 1.0;
  double reference_ = 0.0;
  double whole_ = 0.0;     // last norm of the residual of the whole, of which single bodies may have more than their share
  double sharper_ = 1.0;   // factor of tolerances, for the sake of single bodies
  InterfaceState start_;   // the first solve's, with its status, until the second's
  bool deformed_ = false;  // the state is the answer of a solve: its energy is a scale
};

}  // namespace suture
