#pragma once
#include <suture/base/Point.hpp>
#include <suture/pairs/ContactLaw.hpp>

#include <functional>
#include <string>
#include <vector>

namespace suture {

/// Contact of elastic bodies condensed to its own dofs: minimise x.S x / 2 - f.x over C x <= g.
///
/// S is dense and positive semidefinite. Its kernel, the rigid motions of bodies held only by contact, is known from the geometry, not from
/// eigenvalues: the orthonormal columns of `kernel`. S is block diagonal with one block per body: `blocks` holds the first dof of each
/// block and finally the number of dofs; kernel columns may extend over several blocks only if these are not split further.
struct CondensedContact {
  Matrix stiffness;
  std::vector<int> blocks;
  Matrix kernel;
  Vector load;
  /// Row i: sum over k of coefficients[i][k] x[dofs[i][k]] <= bounds[i].
  std::vector<std::vector<int>> dofs;
  std::vector<std::vector<double>> coefficients;
  Vector bounds;
  std::vector<int> lines{};  ///< contact line of each row, with successive rows of a line being neighbours; empty: a single line
  bool surfaces = false;     ///< rows of one line lie on a surface, unordered
  Vector diagonal{};         ///< diagonal of the stiffness at the contact dofs before other dofs are eliminated; empty: not known
  Vector nodal{};  ///< compliance of each row's nodes, sum of coefficient^2 / K of the whole bodies; empty: from S [length / force]

  /// A contact pair, whose law governs its rows: the first is normal, the others are tangential.
  struct Pair {
    int first, rows;
    const ContactLaw* law;
    Point place;
    double size;  ///< tributary length or area
    bool slipped = false;
  };
  /// All pairs, in the order of the rows; bounds of tangential rows are the slips at the start of the step. Empty: frictionless, each row
  /// is a pair.
  std::vector<Pair> pairs{};
};

/// One step of the active set, as reported by Monitor::outer.
struct ActiveSetStep {
  int active = 0;
  int changed = 0;
  double residual = 0.0;  ///< largest violation: penetration of an open pair, or tension of a closed one times its compliance, relative to
                          ///< the size of the displacements; with friction the distance from the laws, relative to the forces
  double energy = 0.0;    ///< x.S x / 2 - f.x of the step's solution
};

struct ContactSolution {
  bool converged = false;
  std::string failure;
  Vector x;
  Vector force;  ///< Lagrange multiplier of each row: the force on side B along the row
  std::vector<char> active;
  std::vector<ContactState> states{};  ///< states of the pairs; empty without friction
  Vector slides{};                     ///< without equilibrium: motion in which the loads exceed friction; else empty
  double contraction = 0.0;            ///< estimated contraction of the fixed point of Tresca problems; 0: unknown, or no pair slips
};

/// Exact solution by an active set on the compliance of the rows (Delassus matrix), H = C S^-1 C^T with the kernel as free unknowns a:
///     gap = H force - C Z a - h >= 0,   force >= 0,   gap . force = 0,   (C Z)^T force = Z^T f.
/// Uses StateSearch with dense factorisations. Problems with `pairs` are solved by solveFriction().
///
/// Rows without dofs (all components prescribed) never carry a force; they are active when their bound is not positive. A row with zero gap
/// and zero force keeps its state. Local.
///
/// \param active     start, one entry per row; empty: rigid bodies on pads
/// \param iterations  maximum number of solves with an active set
/// \param step       called after each of these solves
ContactSolution solveCondensedContact(const CondensedContact& problem, std::vector<char> active, int iterations,
                                      const std::function<void(const ActiveSetStep&)>& step);

}  // namespace suture
