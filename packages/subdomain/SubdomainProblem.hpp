#pragma once
#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/subdomain/LocalProblem.hpp>
#include <suture/subdomain/SchurComplement.hpp>
#include <suture/subdomain/Subdomain.hpp>

namespace suture {

/// Local problem of a single subdomain without contact: a member of the set T of the paper.
class SubdomainProblem : public LocalProblem {
 public:
  /// \param boundary  free unknowns of the subdomain that lie on the interface
  /// \param softest   stiffness of the softest subdomain of the scene (softestStiffness()): a much stiffer floating subdomain keeps its
  ///                  fluxes in equilibrium up to their own round-off, because otherwise the round-off of its Schur complement on
  ///                  rigid-body modes would hold it like springs to the ground
  /// `subdomain` must be assembled and outlive it.
  SubdomainProblem(int id, const Subdomain& subdomain, const std::vector<int>& boundary, const LocalSolverMaker& solver,
                   std::unique_ptr<SchurComplement> schur, double softest = 0.0);

  /// Reads the current loads of the subdomain.
  void reload();

  void applySchur(ConstLocalView trace, LocalView flux) const override;
  Vector condensedLoad() const override { return schur_->condensedLoad(); }
  double constantEnergy() const override { return schur_->interiorEnergy() + subdomain_.constantEnergy(); }
  const Vector& stiffnessDiagonal() const override { return diagonal_; }
  const Matrix& kernel() const override { return kernel_; }
  using LocalProblem::inverse;
  std::unique_ptr<LocalInverse> inverse() const override;
  std::unique_ptr<LocalInverse> sparseInverse(const Matrix& constraints) const override;
  int unknowns() const override { return subdomain_.dofs(); }
  double bytesRead() const override { return schur_->bytesRead(); }
  std::string chosenSchur() const override { return schur_->chosen(); }
  Matrix schur() const override;
  bool keepsSchur() const override { return schur_->dense() != nullptr; }
  Matrix schurBlock(const std::vector<int>& positions) const override;

  const Subdomain& subdomain() const { return subdomain_; }
  /// Values of the subdomain's free unknowns for a trace.
  Vector recover(const Vector& trace) const { return schur_->recover(trace); }
  /// K u - f on the boundary, from the values of recover(): unlike applySchur() without the round-off of the Schur complement. [force]
  Vector boundaryForces(const Vector& freeValues) const;

 protected:
  Matrix doHint(const std::string& name) const override { return rowsAt(subdomain_.hint(name).values, positions_); }

 private:
  SchurData schurData(const std::vector<int>& nodes, const std::vector<Point>& places) const;

  const Subdomain& subdomain_;
  std::vector<int> positions_;
  LocalSolverMaker solver_;
  std::unique_ptr<SchurComplement> schur_;
  Vector diagonal_;
  Matrix kernel_;
  int loadChanges_ = 0;  // Subdomain::loadChanges() at the last load of the Schur complement
  Matrix balanced_;      // orthonormal basis of the kernel; empty if fluxes are not balanced
};

/// Ratio of stiffnesses up to which the round-off of the stiffest, 1e-16 of it, is 1e-12 of the softest: four digits more than required.
/// Beyond this ratio, the digits that the softest loses are restored.
constexpr double kMuchStiffer = 1e4;

/// Minimum over all subdomains of the largest diagonal entry of the stiffness matrix. Collective. [force / length]
double softestStiffness(const Comm& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains);

/// Global numbers of some free unknowns of a subdomain.
std::vector<GlobalId> globalDofs(const Subdomain& subdomain, const std::vector<int>& dofs);
/// Node of each free unknown.
std::vector<int> nodesOfDofs(const Subdomain& subdomain);
/// Position of the node of each free unknown.
std::vector<Point> placesOfDofs(const Subdomain& subdomain);

}  // namespace suture
