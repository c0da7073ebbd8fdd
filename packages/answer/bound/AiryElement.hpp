#pragma once
#include <suture/answer/bound/BoundElements.hpp>

#include <array>

namespace suture {

/// A side of a triangle, from its first vertex to its second one (ascending).
struct AirySide {
  double length = 0.0;                               ///< [length]
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< unit normal: the direction from first to second vertex, turned clockwise
  double sign = 1.0;                                 ///< +1 if the normal points out of the triangle, else -1
  Eigen::Vector2d along() const { return {-normal[1], normal[0]}; }
};

/// Stress functions of one triangle and their complementary energy: polynomials of degree K + 2 on each part of the Alfeld split,
/// continuous with their gradients (Hsieh-Clough-Tocher elements; a stress function f gives the stresses f_yy, f_xx, -f_xy).
///
/// Unknowns: value and gradient at each vertex, the gradient along the axes of a frame; then those of the sides. A side has with K = 1 the
/// amplitude of 4 r (1 - r) in its normal slope, r = 0..1 along the side; with K = 2 those of 16 r^2 (1 - r)^2 in the value, and of
/// 4 r (1 - r) and r (1 - r) (2 r - 1) in the normal slope. Stresses that the unknowns leave free (K = 2) are those of least energy.
///
/// Energies are tabulated on the reference triangle. Local and thread-safe.
template <int K>
class AiryElement {
 public:
  static constexpr int onSide = K == 1 ? 1 : 3;  ///< unknowns of a side besides those of its ends
  static constexpr int dofs = 9 + 3 * onSide, sideData = 2 * (K + 1);
  static constexpr int packed = dofs * (dofs + 1) / 2;
  using Local = Eigen::Matrix<double, dofs, 1>;
  using LocalMatrix = Eigen::Matrix<double, dofs, dofs>;
  using SideTractions = Eigen::Matrix<double, sideData, 6 + onSide>;
  using Frames = std::array<Eigen::Matrix2d, 3>;  ///< axes of the gradients at the vertices, columns
  using Sides = std::array<AirySide, 3>;          ///< opposite to each vertex

  /// Squared energy of the difference between statically admissible stress and stress of the displacement, start + 2 x.loads +
  /// x.matrix x for unknowns x.
  struct Energy {
    LocalMatrix matrix;
    Local loads;
    double start = 0.0;
  };

  static const AiryElement& reference();

  /// \param tractions  on each side at its nodes, in the direction of its normal
  Energy energy(const BoundElement<2>& element, const Sides& sides, const Frames& frames,
                const Eigen::Matrix<double, sideData, 3>& tractions) const;

  /// Tractions at the nodes of a side, in the direction of its normal, due to unit values of: value and gradient at its first vertex, at
  /// its second one, unknowns of the side.
  static SideTractions tractionsOf(const AirySide& side, const Eigen::Matrix2d& first, const Eigen::Matrix2d& second);

 private:
  static constexpr int data = 3 * sideData + (K == 1 ? 2 : 6), free = K == 1 ? 0 : 3, columns = free + dofs;
  static constexpr int values = 3 * (K == 1 ? 3 : 6);  // values of one component of the stresses on all parts
  static constexpr int rows = 3 * values, paddedRows = (rows + 3) / 4 * 4;
  static constexpr int paddedColumns = (columns + 3) / 4 * 4, table = (columns * (columns + 1) / 2 + 3) / 4 * 4;
  using Map = Eigen::Matrix2d;
  using Data = Eigen::Matrix<double, data, 1>;

  AiryElement();
  Data referenceData(const BoundElement<2>& element, const Sides& sides, const Map& inverse, double volume,
                     const Eigen::Matrix<double, sideData, 3>& tractions) const;
  static double energyOfFlat(const BoundElement<2>& element, const Sides& sides, const Map& map, const Data& given);
  template <int Rows>
  static void toUnknowns(const Map& map, double scale, const Sides& sides, const Frames& frames,
                         const Eigen::Matrix<double, Rows, dofs>& of, Eigen::Matrix<double, Rows, dofs>& result);

  // Stresses, component by component in functions that are orthonormal over the parts: of unit data; of free stresses and unknowns.
  Eigen::Matrix<double, paddedRows, data> ofData_;
  Eigen::Matrix<double, paddedColumns, rows> ofUnknowns_;  // transposed
  Eigen::Matrix<double, table, 6> tables_;                 // energies of pairs of free stresses and unknowns, by pairs of components
};

}  // namespace suture
