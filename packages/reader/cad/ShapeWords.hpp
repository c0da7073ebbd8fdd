#pragma once
#include <suture/reader/cad/SurfaceShape.hpp>

#include <string>

namespace suture {

/// Shape of a surface in words: "cylinder, radius 6, along z, hollow"; "curved" for one that has no name. Local.
/// \param scale  unit of length of the words over that of the shape
std::string inWords(const SurfaceShape& shape, double scale);

}  // namespace suture
