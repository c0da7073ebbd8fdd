#pragma once
#include <suture/algebra/LocalInverse.hpp>
#include <suture/base/Types.hpp>
#include <suture/subdomain/Hint.hpp>

#include <forward_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// One term of the sum (20): a linear problem on part of the bodies, known to other parts only by trace and flux on its boundary. Made from
/// a subdomain, or from a contact group with given status of its pairs. Local: a local problem lives as a whole on one rank.
class LocalProblem {
 public:
  virtual ~LocalProblem() = default;

  const std::string& name() const { return name_; }
  int id() const { return id_; }  ///< number among all local problems of the scene, the same on any number of ranks
  /// Unknowns on the boundary, in the numbering common to all local problems; the order of traces and fluxes.
  const std::vector<GlobalId>& boundary() const { return boundary_; }
  int size() const { return static_cast<int>(boundary_.size()); }

  /// flux <- S_loc trace, for several right-hand sides. [length] to [force]
  virtual void applySchur(ConstLocalView trace, LocalView flux) const = 0;
  /// Loads (and gaps) condensed to the boundary: the term of F (+ F_g) in eq. (17), (21). [force]
  virtual Vector condensedLoad() const = 0;
  /// Least energy with zero trace, including the part of prescribed displacements. [force x length]
  virtual double constantEnergy() const = 0;
  /// Diagonal of the stiffness matrix on the boundary (not of S). [force / length]
  virtual const Vector& stiffnessDiagonal() const = 0;
  /// Traces of a basis of the kernel of S_loc: size() x k.
  virtual const Matrix& kernel() const = 0;
  /// Optional data on the boundary, size() x columns; no columns if there are no data of this name. The coarse modes of a group are those
  /// of its subdomains, each on its own part, and its kernel. Computed at the first call, and kept if there are any.
  const Matrix& hint(const std::string& name) const;
  /// S^+, computed at the call. \throws NumericalError
  virtual std::unique_ptr<LocalInverse> inverse() const = 0;
  /// Inverse under constraints C x = 0, rows x size(), of full rank. \throws NumericalError  they leave a mechanism
  virtual std::unique_ptr<LocalInverse> inverse(const Matrix& constraints) const;
  /// The same inverse by a sparse factor instead of the Schur complement (SparseConstrainedInverse); null if that is not possible.
  virtual std::unique_ptr<LocalInverse> sparseInverse(const Matrix& constraints) const { return (void)constraints, nullptr; }
  /// Number of unknowns of the matrix that is condensed to S_loc; size() if there is none.
  virtual int unknowns() const { return size(); }

  /// Bytes that one applySchur() reads from memory; 0 if not known.
  virtual double bytesRead() const { return 0.0; }
  /// Representation of S_loc, if it was chosen automatically; otherwise empty.
  virtual std::string chosenSchur() const { return {}; }

  /// S_loc as a dense matrix.
  virtual Matrix schur() const;
  /// True if schur() is a copy, false if every column of it needs a solution.
  virtual bool keepsSchur() const { return true; }
  /// Dense block of S_loc for some positions of the boundary.
  virtual Matrix schurBlock(const std::vector<int>& positions) const;

 protected:
  LocalProblem(int id, std::string name, std::vector<GlobalId> boundary)
      : id_(id), name_(std::move(name)), boundary_(std::move(boundary)) {}
  /// See hint(): one row per unknown of the boundary, or no columns.
  virtual Matrix doHint(const std::string& name) const { return (void)name, Matrix(size(), 0); }

 private:
  int id_;
  std::string name_;
  std::vector<GlobalId> boundary_;
  mutable std::forward_list<std::pair<std::string, Matrix>> hints_;  // only nonempty ones
  mutable Matrix none_;
};

}  // namespace suture
