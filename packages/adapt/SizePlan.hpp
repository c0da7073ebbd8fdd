#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/reader/gmsh/SizeField.hpp>

#include <vector>

namespace suture {

/// Two nodes that face each other on a contact.
struct FacingNodes {
  int a = -1, b = -1;
  double distance = 0.0;  ///< along the sides, undeformed [length]
  double slide = 0.0;     ///< along the sides, by the displacements [length]
};

/// Element sizes for a next mesh with a smaller error.
struct SizePlan {
  SizeField field;
  double elements = 0.0;  ///< number of elements of the next mesh, predicted: sum of (h / h_new)^d
  bool isCapped = false;  ///< the sizes are larger than the wanted error requires
};

/// Wanted error of the next mesh.
struct WantedError {
  double square = 0.0;        ///< square of its energy norm
  double mostElements = 0.0;  ///< cap of the predicted number of elements
};

/// Sizes of least cost for a wanted error: the number of elements sum (h / h_new)^d is minimal for sum eta_K^2 (h_new / h)^2k = wanted^2,
/// which gives h_new / h = (c / eta_K^2)^(1 / (2k + d)). Triangles at a singular vertex, whose errors are much larger than those around
/// them, have an error of order 1/2 and become smaller by (5 c / eta_K^2), at most by 512. Other ratios are kept in [1/8, 2]. All are
/// rounded to eighths of a power of two, so that round-off in eta_K does not change the mesh, and sizes grow by at most a fraction of the
/// distance along edges. Facing nodes of a contact have sizes that differ by at most that fraction of their distance, hence matching nodes
/// equal ones. Their sizes are at least twice their slide, because contact forces stay at the nodes that are opposite in the mesh, and all
/// are at least 1e-7 of the extent of the mesh. Local (rank 0). \param mesh     simplices of order k \param squares  eta_K^2 of each
/// element \param largest  upper limits of the sizes at the nodes of the mesh [length]; empty: none
SizePlan planSizes(const Mesh& mesh, const std::vector<double>& squares, const std::vector<FacingNodes>& facing, const WantedError& wanted,
                   const std::vector<double>& largest = {});

/// The present sizes times a factor everywhere. Local (rank 0).
SizePlan uniformSizes(const Mesh& mesh, double factor);

}  // namespace suture
