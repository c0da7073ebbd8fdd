#pragma once
#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/base/Types.hpp>
#include <suture/condensed/ContactRows.hpp>

#include <memory>
#include <vector>

namespace suture {

/// An elastic structure condensed to its contact rows. With a generalised inverse K^+, the kernel R and the contact rows N, every
/// equilibrium state under loads b and pair forces f is
///     v = K^+ (b - N^T f) + R a,   R^T (b - N^T f) = 0,
/// and the gaps are  g - N v = g - N K^+ b + W f - G a  with the compliance W = N K^+ N^T (dense, rows x rows) and G = N R. Local.
class ContactCompliance {
 public:
  /// `inverse` and `rows` must outlive it.
  ContactCompliance(const GeneralisedInverse& inverse, const ContactRows& rows);

  /// State of the structure under loads b with some pairs closed or with unilateral contact.
  struct State {
    Vector force;                      ///< per pair, >= 0 compressive; 0 for open pairs [force]
    Vector rigid;                      ///< coefficients a of the kernel
    std::vector<ContactState> status;  ///< per pair
    int steps = 0;                     ///< changes of the active set
  };

  /// The structure with given pair states: closed pairs are tied in the normal direction (equality), sticking pairs along the tangents
  /// too. Slipping pairs have a known force along the slip and a transverse spring; open pairs have no force. Factored once for many
  /// right-hand sides.
  class Closed {
   public:
    Closed(const ContactCompliance& contact, const std::vector<ContactState>& status);
    /// v (unknowns x right-hand sides), in: loads b, out: solution with N v = gap on the held rows. If a kernel is left (kernel() has
    /// columns), b must be orthogonal to it, and the solution is not unique.
    /// \param gaps  zero for the homogeneous problem (tangents), one to apply the gaps of the rows and the bounds of slipping pairs
    /// \param force  forces, rows x right-hand sides, or null; requested forces are refined
    /// \param moved  contribution of rigid motions that v does not contain: reduces the gaps of the rows; empty: none [length]
    void solve(LocalView v, double gaps, Matrix* force = nullptr, const Vector& moved = {}) const;
    /// Kernel of the structure with these pairs closed: unknowns x k, from a singular value decomposition of N_A R.
    const Matrix& kernel() const { return kernel_; }
    const std::vector<ContactState>& status() const { return status_; }

   private:
    friend class ContactCompliance;
    /// Transverse spring of a slipping pair: a row with compliance.
    struct Spring {
      int rows[2];  // rows along the tangents; -1: none
      double coefficients[2];
      double compliance;
    };
    int size() const { return static_cast<int>(rows_.size() + springs_.size()); }
    // pick: values of the held rows (those of springs last) from values of all rows. spread: forces of all rows from those of the held
    // ones.
    void pick(ConstLocalView all, LocalView held) const;
    void spread(ConstLocalView held, LocalView all) const;
    Matrix compliance() const;  // compliance of the held rows, springs included
    // force, in: gaps of the held rows without forces; out: forces of these rows.
    void forces(LocalView force, const Matrix& e, Matrix& rigid) const;
    // The same, refined with the unshifted matrix: the shift of the factor does not affect the result.
    void refinedForces(LocalView force, const Matrix& e, Matrix& rigid) const;

    const ContactCompliance& contact_;
    std::vector<ContactState> status_;
    std::vector<int> rows_;  // rows that are equations
    std::vector<Spring> springs_;
    Vector slipping_;      // forces of slipping pairs, for all rows; empty: none
    Matrix factor_;        // Cholesky factor of W on the held rows
    Matrix held_, loose_;  // orthonormal combinations of the kernel that closed pairs hold (held_) or leave free (loose_)
    Matrix gHeld_;         // G restricted to held rows x held motions
    Matrix rigidFactor_;   // Cholesky factor of gHeld^T W^-1 gHeld
    Matrix kernel_;
  };

  /// Solves the unilateral problem (forces and gaps >= 0, their product zero) by StateSearch from `start`, or from rigid bodies on pads
  /// where that set leaves a body unconstrained. Uses normal rows only: without friction.
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
