#pragma once
#include <suture/adapt/Chords.hpp>
#include <suture/base/Types.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Makes the second-order sides of a sequence of meshes straight, so that error bounds are strict for the polygon (polyhedron) of each
/// mesh, and keeps what was curved. Vertices stay on the curves, so that the polygons approach them.
class PolygonSides {
 public:
  /// Sides stay curved.
  PolygonSides() = default;
  /// \param kept  side groups that stay curved
  explicit PolygonSides(std::vector<std::string> kept) : kept_(std::move(kept)), isUsed_(true) {}

  bool isUsed() const { return isUsed_; }
  /// Straightens the present mesh, on rank 0. Collective.
  void straighten(const Comm& comm, Mesh& mesh);
  /// Straight sides of the present mesh in place of curved ones; nothing if sides stay curved. Local (rank 0).
  /// \param whole  the mesh with its bodies
  std::optional<std::vector<ChordSide>> of(const Mesh& whole) const;

 private:
  std::vector<std::string> kept_;
  bool isUsed_ = false;
  std::vector<Chord> chords_;  // on rank 0
};

}  // namespace suture
