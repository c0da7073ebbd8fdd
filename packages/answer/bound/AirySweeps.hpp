#pragma once
#include <suture/answer/bound/AiryElement.hpp>
#include <suture/answer/bound/StarMesh.hpp>
#include <suture/answer/bound/SweepGain.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Improves equilibrated tractions in 2D by conjugate gradients for the least complementary energy.
///
/// Changes of the stresses are derived from a stress function, continuous with its gradient, a polynomial of degree k + 2 on each part of
/// the split triangles (Hsieh-Clough-Tocher elements): every iterate is exactly in equilibrium. The preconditioner solves exactly on the
/// star of each vertex. Local data: one ring of triangles; each iteration exchanges values with neighbours once.
/// \tparam K  degree of the stresses, 1 or 2
template <int K>
class AirySweeps {
 public:
  /// \param tractions  EquilibratedTractions::values; all arguments must outlive this
  AirySweeps(const StarMesh<2>& mesh, const Matrix& tractions);

  /// At least `sweeps` iterations, more while they pay (worthAnotherSweep). Collective.
  void run(int sweeps);
  /// Squared energy of the difference between statically admissible stress and the stress of the displacement, by own triangle.
  /// [energy]
  Vector energies() const;
  /// Largest resultant of the data of an own triangle, relative to `scale`. \param scale  [force]
  double imbalance() const { return imbalance_; }

 private:
  using Element = AiryElement<K>;
  using Local = typename Element::Local;
  static constexpr int onSide = Element::onSide, dofs = Element::dofs, sideData = Element::sideData, packed = Element::packed;
  static constexpr int lanes = 4;  ///< triangles whose matrices are stored and multiplied together
  struct Field {
    Matrix ofVertices, ofSides;  ///< value and gradient, 3 x vertices; onSide x sides
  };
  void findFreedom();
  void constrain(int side);
  void assemble(const Matrix& given);
  typename Element::Sides sidesOf(int e) const;
  void addSupport(int e, int a, const typename Element::Frames& frames, const Eigen::Matrix<double, sideData, 1>& traction,
                  typename Element::Energy& energy) const;
  void measureImbalance(const Matrix& given);
  void factorStars();
  void listStars();
  void addToStars(int e, const typename Element::LocalMatrix& matrix);
  void fixInStar(int v);
  Field zero() const;
  Local gather(const Field& field, int e) const;
  void product(const Field& p, Field& result) const;
  void precondition(const Field& r, Field& z) const;
  void exchange(Field& field) const;
  double dot(const Field& a, const Field& b) const;
  /// Entry i >= j of the stiffness of a triangle.
  double entry(int e, int i, int j) const { return matrices_[(std::size_t(e / lanes) * packed + i * (i + 1) / 2 + j) * lanes + e % lanes]; }

  const StarMesh<2>& mesh_;
  std::vector<Eigen::Matrix2d> frames_;                // axes for the gradient at each vertex, columns
  std::vector<unsigned> fixedAtVertex_, fixedAtSide_;  // bits
  std::unique_ptr<double[]> matrices_;  // stiffness of all triangles: rows of the lower triangles, `lanes` triangles together
  Matrix loads_;                        // dofs x triangles
  Vector start_;                        // energies of own triangles before the first sweep
  double imbalance_ = 0.0;
  Field solution_;
  // Stars: sides, and packed Cholesky factors one after the other, rows of the lower triangles; a zero on the diagonal marks a fixed
  // unknown.
  std::vector<int> starSides_, starBegin_;
  std::vector<double> factors_;
  std::vector<std::size_t> factorBegin_;
};

}  // namespace suture
