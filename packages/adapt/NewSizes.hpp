#pragma once
#include <suture/adapt/ContactTwins.hpp>
#include <suture/mesh/Mesh.hpp>

#include <vector>

namespace suture {

/// Element sizes for the next mesh of the same geometry.
struct NewSizes {
  std::vector<double> size;  ///< length of an edge at each node [length]
  double elements = 0.0;     ///< predicted number of elements
};

/// Limits of newSizes().
struct SizeLimits {
  double least = 0.25;      ///< smallest ratio of new and old size
  double most = 2.0;        ///< largest ratio
  double gradation = 0.35;  ///< largest growth of the size over the distance
};

/// Sizes that reach a smaller error with the fewest elements: h_new = h (c / eta_T^2)^(1 / (2 k + D)) for elements of degree k, within the
/// limits, where c gives the wanted error. Then sizes grow slowly along edges, and are equal at opposite nodes of contacts; both only make
/// them smaller. h is the edge of a regular simplex (of a square or a cube) of the element's area or volume. Local (rank 0).
/// \param squares  squared error of each element [energy]
/// \param degree   polynomial degree k of the elements
/// \param target   error of the new mesh over that of this mesh, in (0, 1)
/// \param twins    contactTwins(); may be empty
/// \throws InternalError  negative, non-finite or too few squares, a degree below 1, a target outside (0, 1)
NewSizes newSizes(const Mesh& mesh, const std::vector<double>& squares, int degree, double target, const std::vector<NodePairs>& twins,
                  const SizeLimits& limits = {});

}  // namespace suture
