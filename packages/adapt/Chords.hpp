#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/Mesh.hpp>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace suture {

/// A straight edge of a second-order element in place of a curve.
struct Chord {
  std::array<int, 2> ends{{-1, -1}};  ///< vertices, ascending
  Point offset{0, 0, 0};              ///< from the middle of the edge to the curve [length]
};

/// Moves the mid-side nodes of all second-order triangles and tetrahedra into the middle of their edges, except those on the sides of some
/// groups. Local (rank 0). \param kept  names of side groups \return the edges that were curved, by their ends
std::vector<Chord> straighten(Mesh& mesh, const std::vector<std::string>& kept);

/// A straight side in place of a curved one, at the boundary of a body or between two materials.
struct ChordSide {
  int element = -1;
  std::vector<int> vertices;
  double length = 0.0;  ///< in 3D the square root of twice the area
  double volume = 0.0;  ///< between the side and the curve; in 2D an area
  double excess = 0.0;  ///< length (3D: area) of the curved side minus that of the straight one
};

/// Sides of a mesh that have curved edges. A mid-side offset s along the normal gives 2/3 s L between an edge of length L and its parabola,
/// and 8/3 s^2 / L more length; a triangle a third of its area times the sum of its three offsets. A side between two elements of the same
/// material is none: its shape is of no importance. Local (rank 0). \param mesh  with its bodies \param chords  of straighten(), whose mesh
/// has the same vertices
std::vector<ChordSide> chordSides(const Mesh& mesh, const std::vector<Chord>& chords);

/// Largest sizes at the nodes of a mesh for a wanted effect of straight sides. Sides of r times the length have r^2 times the effect: the
/// number of sides is least if r is proportional to effect^(-1 / (D + 1)). Not below 1/32 of the present lengths. Infinite away from
/// curves. Local (rank 0). \param effects  of each side [energy] \param wanted  their wanted sum
std::vector<double> sizesAlongCurves(const Mesh& mesh, const std::vector<ChordSide>& sides, const std::vector<double>& effects,
                                     double wanted);

}  // namespace suture
