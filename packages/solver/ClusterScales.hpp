#pragma once
#include <suture/solver/OuterSolver.hpp>

#include <vector>

namespace suture {

/// Scales of residuals and unknowns: the energy norms sqrt(U.S U) of clusters, bodies that closed pairs or their springs connect. S is
/// block diagonal in clusters. Collective.
///
/// The norm of a residual is sqrt(r.M^-1 r) relative to the energy norm of the solution, for each cluster. Each block is scaled by its own
/// energy for conjugate gradients, so that a weak cluster is solved as accurately as a strong one. At the end the residual of each body
/// must also be small compared with the energy of the body.
class ClusterScales {
 public:
  /// Energies so far are those that the bodies have carried on the path of load steps.
  ClusterScales(OuterSolver::Run& run, const ContactProblem& contact);

  /// Finds the clusters of pair states.
  void find(const PairStates& states);
  bool oneCluster() const;

  /// Scales for a linear solve.
  /// \param from  state whose energies are the scales; null: the norm of the residual is the scale
  /// \param start  initial state of the solve, with closed gaps, which may need far more energy than the solution has
  void scaleBy(const InterfaceState* from, const InterfaceState& start, const MultiVector& load);
  /// True if there are several clusters, each scaled by its own energy. The same on all ranks.
  bool isScaled() const { return scaled_; }
  /// Largest scale of a cluster; one without scaling.
  double largest() const { return largestScale_; }
  /// Multiplies unknowns by the scales of their clusters, or divides them.
  void scale(MultiVector& x, bool inverse) const;

  /// Energy norm to which the residual of conjugate gradients is relative.
  double reference() const { return reference_; }
  void setReference(double value) { reference_ = value; }
  /// Records the energies of a solution.
  void recordSolution(const InterfaceState& state, double tolerance);
  /// Accuracy of the forces of the last solution relative to the largest ones of the path, if it has almost no energy; else zero.
  double unloaded() const { return unloaded_; }
  /// Largest ratio of the reference norm of a cluster and the energy norm of its solution.
  double overestimate(const InterfaceState& state, double tolerance) const;

  /// Residual norm: global, or the largest of a body relative to its own energy.
  struct Norm {
    double whole = 0.0, bodies = 0.0;
    double largest() const { return bodies > whole ? bodies : whole; }
  };
  /// The image of the state is cached in the state.
  Norm norm(const MultiVector& residual, const InterfaceState& state);
  /// Twice the largest energy of each part so far, which sets the round-off level.
  const Vector& largestEnergies() const { return largest_; }

 private:
  Vector energies(const InterfaceState& state) const;
  /// Energy norm of a solution relative to that of the largest one on the path, below which it is negligible.
  double negligible() const;
  Vector lentNorms(const Vector& norms) const;

  OuterSolver::Run& run_;
  const ContactProblem& contact_;
  std::vector<int> clusterOf_;  // by part
  Vector lift_;                 // energy norm of each cluster at the start of the last solve, which sets the round-off level
  Vector largest_;
  Vector found_;  // the same for solutions only, without the energy of closing gaps
  double unloaded_ = 0.0;
  Vector size_;                // reference norm of the residual of each cluster
  std::vector<double> scale_;  // per owned unknown, if scaled_
  bool scaled_ = false;
  bool isSized_ = false;  // the automatic tolerance knows the norm of the solution
  double largestScale_ = 1.0;
  double reference_ = 0.0;
};

}  // namespace suture
