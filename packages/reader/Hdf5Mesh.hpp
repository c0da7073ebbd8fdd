#pragma once
#include <suture/base/hdf5/Hdf5Writer.hpp>
#include <suture/mesh/Mesh.hpp>

#include <functional>
#include <string>

namespace suture {

/// Writes the mesh of rank 0 (without its bodies) as Suture's own file: attribute SutureMesh = "1" (the version of the format), and the
/// datasets
///     /Dimension    2 or 3                  /Cells  shape of each element (numbers of Cell)
///     /Coordinates  nodes x dimension       /Offsets, /Connectivity   as in CellBlock
///     `/ElementGroups/<i>`  elements        `/SideGroups/<i>`  (element, side)  both with the attribute Name
/// Reading the file returns every bit of the mesh. Collective.
/// \param more  adds further content to the file; runs on rank 0
/// \throws EnvironmentError  if the file cannot be written
void writeHdf5Mesh(const Comm& comm, const Mesh& mesh, const std::string& path, const std::function<void(Hdf5Writer&)>& more = {});

/// Reads the mesh in such a file, on rank 0. Collective.
/// \throws InputError  no such file, not HDF5, not a Suture mesh, a later version, inconsistent sizes, numbers out of range, a coordinate
///                     that is not finite, a side inside the material: all errors are listed, each with its dataset
Mesh readHdf5Mesh(const Comm& comm, const std::string& path);

}  // namespace suture
