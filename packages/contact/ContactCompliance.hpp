#pragma once
#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/base/Types.hpp>
#include <suture/contact/ContactRows.hpp>

#include <memory>
#include <vector>

namespace suture {

/// An elastic structure condensed to its contact rows. With K^+ a generalised inverse, R the kernel and N the contact rows, every
/// equilibrium state under loads b and pair forces f is
///     v = K^+ (b - N^T f) + R a,   R^T (b - N^T f) = 0,
/// so that the gaps are  g - N v = g - N K^+ b + W f - G a  with the compliance W = N K^+ N^T (dense, rows x rows) and G = N R.
/// Local.
class ContactCompliance {
 public:
  /// `inverse` and `rows` must outlive it.
  ContactCompliance(const GeneralisedInverse& inverse, const ContactRows& rows);

  /// State of the structure under loads b with some pairs closed or with unilateral contact.
  struct State {
    Vector force;                      ///< a pair, >= 0 compressive; 0 for open pairs [force]
    Vector rigid;                      ///< coefficients a of the kernel
    std::vector<ContactState> status;  ///< a pair
    int steps = 0;                     ///< changes of the active set
  };

  /// The pairs of one status closed as if glued in the normal direction (equality), those that stick along the tangents too, the others
  /// without force but that of their state: a bound along the slip, and a spring across it. Factored once, for many right-hand sides.
  class Closed {
   public:
    Closed(const ContactCompliance& contact, const std::vector<ContactState>& status);
    /// v (unknowns x right-hand sides), in: loads b, out: solution with N v = gap on the rows that are held. With a kernel left (kernel()
    /// has columns) b must be orthogonal to it, and the solution is one of many.
    /// \param gaps  zero for the homogeneous problem (tangents), one for the gaps of the rows and the bounds of pairs that slip
    /// \param force  forces, rows x right-hand sides, or null; where they are wanted they are refined
    /// \param moved  addition of rigid motions beside v to the rows: their gaps are smaller by it; empty: none [length]
    void solve(LocalView v, double gaps, Matrix* force = nullptr, const Vector& moved = {}) const;
    /// Kernel of the structure with these pairs closed: unknowns x k. By a singular value decomposition of N_A R.
    const Matrix& kernel() const { return kernel_; }
    const std::vector<ContactState>& status() const { return status_; }

   private:
    friend class ContactCompliance;
    /// A spring across the slip of a pair: a row that gives way.
    struct Spring {
      int rows[2];  // rows along the tangents; -1: none
      double coefficients[2];
      double compliance;
    };
    int size() const { return static_cast<int>(rows_.size() + springs_.size()); }
    // Values of the held rows, those of springs last, from values of all rows; and forces of all from those of the held ones.
    void pick(ConstLocalView all, LocalView held) const;
    void spread(ConstLocalView held, LocalView all) const;
    Matrix compliance() const;  // compliance of the held rows, with that of springs
    // force, in: gaps of the held rows without forces; out: their forces.
    void forces(LocalView force, const Matrix& e, Matrix& rigid) const;
    // The same, refined against the matrix itself: the factor's shift leaves no trace.
    void refinedForces(LocalView force, const Matrix& e, Matrix& rigid) const;

    const ContactCompliance& contact_;
    std::vector<ContactState> status_;
    std::vector<int> rows_;  // rows that are equations
    std::vector<Spring> springs_;
    Vector slipping_;      // forces of pairs that slip, of all rows; empty: none
    Matrix factor_;        // Cholesky factor of W on the held rows
    Matrix held_, loose_;  // orthonormal combinations of the kernel that closed pairs hold, and that they do not
    Matrix gHeld_;         // G restricted: held rows x held motions
    Matrix rigidFactor_;   // Cholesky factor of gHeld^T W^-1 gHeld
    Matrix kernel_;
  };

  /// The unilateral problem: forces and gaps >= 0, their product zero, by ContactSearch from `start`, or from rigid bodies on pads where
  /// that set leaves a body loose. Knows normal rows alone: without friction.
  /// \param v  in: loads b; out: displacements
  /// \param moved  as in Closed::solve
  /// \throws NumericalError  no equilibrium (a body is pushed away from its contacts)
  State solve(LocalView v, const std::vector<ContactState>& start, const Vector& moved = {}) const;

  int pairs() const { return rows_.size(); }
  int rows() const { return static_cast<int>(rows_.rows.rows()); }
  const Matrix& compliance() const { return compliance_; }

 private:
  const GeneralisedInverse& inverse_;
  const ContactRows& rows_;
  Matrix compliance_;  // W
  Matrix rigidRows_;   // G
};

}  // namespace suture
