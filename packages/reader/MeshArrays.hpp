#pragma once
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// A mesh as plain arrays, from a file or another program. Not checked; meshFromArrays() checks all of it.
struct MeshArrays {
  struct Group {
    std::string place;         ///< where the array is, for messages
    std::string name;          ///< name of the group
    std::vector<int> numbers;  ///< elements; or element and side (number in CellInfo::sideNodes) of each side
  };
  std::vector<int> dimension;       ///< one value, 2 or 3
  std::vector<double> coordinates;  ///< nodes x dimension [length]
  std::vector<int> cells;           ///< shape of each element: numbers of Cell
  std::vector<int> offsets;         ///< elements + 1
  std::vector<int> connectivity;    ///< nodes of element e: connectivity[offsets[e] .. offsets[e + 1]), as in CellBlock
  std::vector<Group> elementGroups, sideGroups;
};

/// The mesh of these arrays. Local.
/// \param path    in the scene, for messages;  \param source  of the arrays, likewise
/// \throws InputError  inconsistent sizes, numbers out of range, coordinates that are not finite, two groups with one name, a side inside
/// the
///                     material: all errors are listed, each with the place of its array
Mesh meshFromArrays(MeshArrays arrays, const std::string& path, const std::string& source);

}  // namespace suture
