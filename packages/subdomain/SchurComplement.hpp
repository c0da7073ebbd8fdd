#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/algebra/dense/PackedSymmetric.hpp>
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/base/Registry.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Input of a Schur complement: a stiffness matrix whose unknowns are split into interior (I) and boundary (B), and loads.
struct SchurData {
  const SymmetricMatrix& stiffness;  ///< all unknowns
  const Vector& load;                ///< all unknowns
  const std::vector<int>& boundary;  ///< positions of B, in the order of traces
  const std::vector<int>& nodeOf;    ///< node of each unknown
  const std::vector<Point>& places;  ///< position of the node of each unknown [length]
  LocalSolverMaker solver;
  std::string what;   ///< for messages
  int dimension = 2;  ///< dimension of the problem: 2 or 3
};

/// S_i = A_BB - A_BI A_II^-1 A_IB of eq. (12)-(14), the energy of the discrete harmonic extension, independent of its representation.
/// Strategies: Implicit (as in the paper: one back-substitution per application), Explicit (a dense matrix), Automatic (one of them); users
/// add strategies through Registry<SchurComplement>. A_II must be regular. Local.
class SchurComplement {
 public:
  static const char* kind() { return "Schur complement"; }
  virtual ~SchurComplement() = default;

  /// Factors. Stiffness and load must outlive this object.
  void compute(const SchurData& data) { doCompute(data); }
  /// Sets other loads. \param data  as for compute(), except the loads
  void reload(const SchurData& data) { doReload(data); }
  /// flux <- S trace, for several right-hand sides.
  void apply(ConstLocalView trace, LocalView flux) const {
    ++applications_;
    doApply(trace, flux);
  }
  /// f_B - A_BI A_II^-1 f_I. [force]
  virtual const Vector& condensedLoad() const = 0;
  /// S itself, if it is stored; otherwise null.
  virtual const PackedSymmetric* dense() const { return nullptr; }
  /// All unknowns of the solution with the given trace: u_I = A_II^-1 (f_I - A_IB trace).
  virtual Vector recover(const Vector& trace) const = 0;
  /// Least energy with zero trace: -f_I A_II^-1 f_I / 2.
  virtual double interiorEnergy() const = 0;

  /// Bytes that one application reads from memory; 0 if not known.
  virtual double bytesRead() const { return 0.0; }
  /// Name of the strategy that Automatic chose; empty if the user chose it.
  virtual std::string chosen() const { return {}; }

  long long applications() const { return applications_; }

 protected:
  virtual void doCompute(const SchurData& data) = 0;
  /// Optional: avoids a new factorisation.
  virtual void doReload(const SchurData& data) { doCompute(data); }
  virtual void doApply(ConstLocalView trace, LocalView flux) const = 0;

 private:
  mutable long long applications_ = 0;
};

void registerBuiltIns(Registry<SchurComplement>& registry);

/// As in the paper: a factor of A_II in addition to the stiffness matrix A; an application is one back-substitution and two products with
/// A, whose blocks are not stored a second time. The factor may be stored in single precision, M, which takes half the memory: with the
/// nearly harmonic extension E = [I; -M A_IB], an application is that of E^T A E, which is positive definite like S and differs from S by
/// the square of the round-off in M; it takes a second back-substitution and a third product. Single precision is tried; the factor stays
/// in double precision if the difference is noticeable.
class ImplicitSchurComplement : public SchurComplement {
 public:
  enum class Precision { Double, Single };

  static Schema schema();
  explicit ImplicitSchurComplement(Precision precision = Precision::Double);
  explicit ImplicitSchurComplement(const Parameters& own);
  ~ImplicitSchurComplement() override;

  const Vector& condensedLoad() const override { return condensedLoad_; }
  Vector recover(const Vector& trace) const override;
  double interiorEnergy() const override { return interiorEnergy_; }
  /// Precision of the stored factor.
  Precision precision() const { return single_ ? Precision::Single : Precision::Double; }

 protected:
  void doCompute(const SchurData& data) override;
  void doReload(const SchurData& data) override;
  void doApply(ConstLocalView trace, LocalView flux) const override;

 private:
  void tryInSinglePrecision(const SparseMatrix& stiffness);

  Precision wanted_;
  const SymmetricMatrix* stiffness_ = nullptr;
  std::vector<int> interior_, boundary_;
  std::unique_ptr<LocalSolver> interiorSolver_;  // factor of A_II, or
  std::unique_ptr<SingleFactor> single_;         // the same factor in single precision, in the numbers of A
  SparseMatrix coupling_;                        // with single_: A_IB, rows in the numbers of A; saves reading A
  Vector condensedLoad_, interiorResponse_;
  double interiorEnergy_ = 0.0;
};

}  // namespace suture
