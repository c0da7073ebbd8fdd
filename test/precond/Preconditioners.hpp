#pragma once
#include <interface/Interfaces.hpp>
#include <suture/precond/Preconditioner.hpp>

namespace suture::blocks {

/// Neumann-Neumann by the names of the scene file, for an operator of a space. Collective.
Teuchos::RCP<Preconditioner> neumannNeumann(const Interface& one, const Teuchos::RCP<const InterfaceOperator>& matrix,
                                            const std::string& coarse = "Rigid Modes", const std::string& weighting = "Stiffness Diagonal");

/// The list Preconditioner with these settings of its list `BDDC`. Local.
Parameters bddcList(std::vector<std::string> settings);

/// BDDC with these settings, for an operator and its space. Collective.
Teuchos::RCP<Preconditioner> bddcWith(const Teuchos::RCP<const InterfaceOperator>& matrix, const std::vector<std::string>& settings);

Teuchos::RCP<Preconditioner> bddc(const Teuchos::RCP<const InterfaceOperator>& matrix, const std::string& edges = "Rigid Modes",
                                  const std::string& weighting = "Stiffness Diagonal");

struct Lanczos {
  int iterations = 0;
  double condition = 0.0, least = 0.0;  // and the smallest eigenvalue
  std::vector<Matrix> iterates;         // own unknowns after each step, from zero
  std::vector<double> residuals;        // preconditioned ones after each step, relative to the first

  int iterationsTo(double tolerance) const;
};

/// Conjugate gradients, written out, until the preconditioned residual has fallen by 1e-10; the condition of M^-1 S from their Lanczos
/// matrix. Collective.
Lanczos conjugateGradients(const Operator& s, const Operator& m, const InterfaceSpace& space, const MultiVector& rhs);

/// The same for a random load, identical on any number of ranks. Collective.
Lanczos conjugateGradients(const InterfaceOperator& s, const Preconditioner& m);

Lanczos conditionOf(const Scene& scene, const std::string& coarse, const std::string& weighting = "Stiffness Diagonal",
                    const std::vector<double>& youngOf = {});

/// Young moduli in turn, as on a chess board or in columns of subdomains (which are numbered column by column).
std::vector<double> board(int blocks, double jump, bool columns);

}  // namespace suture::blocks
