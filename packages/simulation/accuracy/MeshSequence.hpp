#pragma once
#include <suture/adapt/SizePlan.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/simulation/accuracy/PolygonError.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Errors on a mesh, from which the next one follows; complete on rank 0 only.
struct MeshErrors {
  const Mesh& whole;            ///< with its bodies
  std::vector<double> squares;  ///< squared error of each element
  std::vector<FacingNodes> facing;
  PolygonError polygon{};  ///< effect of straight sides
  WantedError wanted{};
  bool isUniform = false;  ///< the next mesh has elements of half the size everywhere
};

/// Plan of the next mesh, on rank 0.
struct MeshPlan {
  double elements = 0.0;  ///< number of elements, predicted
  bool isCapped = false;  ///< fewer elements than the wanted error requires, or none at all: see WantedError::mostElements
};

/// The meshes of a scene with a request for accuracy: the first one, and finer ones.
class MeshSequence {
 public:
  virtual ~MeshSequence() = default;
  /// The first mesh, with side groups and element groups, on rank 0. Collective. \throws InputError
  virtual Mesh start(const Comm& comm) = 0;
  /// Sides of the present mesh that are straight in place of curved ones; nothing if sides are not made straight, or if it is not known.
  /// Local (rank 0). \param whole  the present mesh, with its bodies
  virtual std::optional<std::vector<ChordSide>> chords(const Mesh& whole) const = 0;
  /// Plans the mesh after the present one. Local (rank 0).
  virtual MeshPlan plan(const MeshErrors& errors) = 0;
  /// Makes the planned mesh, on rank 0. Collective. \throws InputError  it cannot be made
  virtual Mesh next(const Comm& comm) = 0;
  /// Word for the refinement in summary.json.
  virtual std::string name() const = 0;
};

}  // namespace suture
