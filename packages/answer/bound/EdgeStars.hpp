#pragma once
#include <suture/answer/bound/FaceTractions.hpp>

#include <vector>

namespace suture {

/// The stars of edges in 3D as a preconditioner of changes of tractions: exact solutions over all tractions on the faces at an edge that
/// leave each tetrahedron in equilibrium.
///
/// Around an edge tetrahedra and faces alternate. Each tetrahedron is in equilibrium if all faces transmit the same force and moment: the
/// unknowns are these six numbers, none at an edge next to a face with given tractions, and the tractions without resultants of each face
/// (FaceTractions). Factors are stored in single precision: any of them keeps the equilibrium. Local.
template <int K>
class EdgeStars {
 public:
  using Face = FaceTractions<K>;
  static constexpr int count = Face::count, balanced = Face::balanced, ofElement = 4 * count;

  /// Stars of the edges of own tetrahedra. \param faces  of the mesh, by side
  EdgeStars(const StarMesh<3>& mesh, const std::vector<Face>& faces);
  /// \param grams  of each tetrahedron, rows of the lower triangle: energies of the faces' tractions in their bases, signed
  /// (StarMesh::sign)
  void factor(const std::vector<double>& grams);
  /// z <- sum over the stars of their solutions. \param r  gradients, bases of the faces by columns
  void apply(const Matrix& r, Matrix& z) const;

 private:
  /// Tetrahedron between two faces of a star, by their place in it; -1: the tractions of the face are given.
  struct Between {
    int element, sides[2], places[2];  // sides: numbers in the tetrahedron
  };
  struct Star {
    int faces, betweens;     // first entries
    std::size_t factor = 0;  // first entry
    int wrenches = 6;        // unknowns: force and moment that all faces transmit
    int restricted = -1;     // place in restricted_
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double area = 0.0, size = 0.0;
  };
  using Transfer = Eigen::Matrix<double, 6, 6>;

  void walk(int v, int w, std::vector<int> elements);
  void addFan(const std::vector<int>& elements, const std::vector<int>& sides, int v, int w);
  void restrict(Star& star, int end);
  Transfer transfer(const Star& star, int side) const;
  Matrix matrixOf(std::size_t star, const std::vector<double>& grams) const;
  int unknowns(std::size_t star) const { return stars_[star].wrenches + balanced * (stars_[star + 1].faces - stars_[star].faces); }

  const StarMesh<3>& mesh_;
  const std::vector<Face>& faces_;
  std::vector<Star> stars_;    // one more at the end
  std::vector<int> sides_;     // faces of the stars
  std::vector<double> signs_;  // direction in which the sides transmit
  std::vector<Between> betweens_;
  std::vector<Transfer> restricted_;  // bases of possible forces and moments
  std::vector<float> factors_;        // rows of lower triangles with inverted diagonals
};

}  // namespace suture
