#include <suture/base/Collective.hpp>
#include <suture/reader/gmsh/StraightSides.hpp>
#include <suture/simulation/accuracy/PolygonSides.hpp>

namespace suture {

void PolygonSides::straighten(const Comm& comm, Mesh& mesh) {
  if (!isUsed_) return;
  collectivelyOnRoot(comm, "making sides straight", [&] {
    chords_ = suture::straighten(mesh, kept_);
    straightenTangled(mesh);  // sides that stay curved
  });
}

std::optional<std::vector<ChordSide>> PolygonSides::of(const Mesh& whole) const {
  if (!isUsed_) return std::nullopt;
  return chordSides(whole, chords_);
}

}  // namespace suture
