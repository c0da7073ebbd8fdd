#pragma once
#include <suture/base/Point.hpp>
#include <suture/constraints/ContactLaw.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// Contact of elastic bodies condensed to its own dofs: minimise x.S x / 2 - f.x over C x <= g.
///
/// S is dense and positive semidefinite. Its kernel, the rigid motions of bodies that only contact holds, is known beforehand (from
/// geometry, not from eigenvalues): the columns of `kernel`, orthonormal. S is block diagonal, a block a body: `blocks` holds the first
/// dof of each and the number of dofs at the end; kernel columns may reach over several blocks only if those are not split further.
struct CondensedContact {
  Matrix stiffness;
  std::vector<int> blocks;
  Matrix kernel;
  Vector load;
  /// Row i: sum over k of coefficients[i][k] x[dofs[i][k]] <= bounds[i].
  std::vector<std::vector<int>> dofs;
  std::vector<std::vector<double>> coefficients;
  Vector bounds;
  std::vector<int> lines{};  ///< contact line of each row, successive rows of one being neighbours; empty: all of one
  bool surfaces = false;     ///< rows of one line lie on a surface, in no order

  /// A contact pair whose law decides about its rows: the first of them is along the normal, the others along the tangents.
  struct Pair {
    int first, rows;
    const ContactLaw* law;
    Point place;
    double size;  ///< tributary length or area
    bool slipped = false;
  };
  /// All pairs, in the order of the rows; bounds of tangential rows are slips at the beginning of the step. Empty: without friction, each
  /// row is a pair.
  std::vector<Pair> pairs{};
};

/// Result of one step of the active set; Monitor::outer reports it.
struct ActiveSetStep {
  int active = 0;
  int changed = 0;
  double residual = 0.0;  ///< largest violation: penetration of an open pair, or pull of a closed one times its compliance; over the size
                          ///< of the displacements
  double energy = 0.0;    ///< x.S x / 2 - f.x of the step's solution
};

struct ContactSolution {
  bool converged = false;
  std::string failure;
  Vector x;
  Vector force;  ///< multiplier of each row: what side B feels along it
  std::vector<char> active;
  std::vector<ContactState> states{};  ///< states of the pairs; empty without friction
  Matrix neutral;                      ///< combinations of kernel columns along which no force changes: x is not determined there
  Vector slides{};                     ///< where no equilibrium was found: motion in which the loads outdo friction; else empty
  double contraction = 0.0;  ///< ratio of successive changes of bounds in the fixed point of Tresca problems; 0: it was not needed
};

/// The exact solution by an active set on the compliance of the rows (Delassus matrix), H = C S^-1 C^T with the kernel as free unknowns a:
///     gap = H force - C Z a - h >= 0,   force >= 0,   gap . force = 0,   (C Z)^T force = Z^T f.
/// By ContactSearch, on dense factorisations. Problems with `pairs` are those of solveFriction().
///
/// Rows without dofs (all components prescribed) never carry a force; they are active when their bound is not positive.
/// Equivalent solutions: a row with zero gap and zero force keeps the state it had. Local.
///
/// \param active     where to start: one entry a row, or empty: rigid bodies on pads
/// \param iterations most solves with an active set
/// \param step       told of each of them
ContactSolution solveCondensedContact(const CondensedContact& problem, std::vector<char> active, int iterations,
                                      const std::function<void(const ActiveSetStep&)>& step);

}  // namespace suture
