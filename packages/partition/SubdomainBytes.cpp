#include <suture/partition/SubdomainBytes.hpp>

namespace suture {
namespace {

// One list of fields for both directions: `each` packs or unpacks.
template <typename SubdomainMeshRef, typename Each>
void forEachField(SubdomainMeshRef& part, const Each& each) {
  each(part.dimension);
  each(part.coordinates);
  each(part.cells);
  each(part.offsets);
  each(part.connectivity);
  each(part.axisymmetric);
  each(part.regions);
  each(part.coatings);
  each(part.coatingNodes);
  each(part.id);
  each(part.body);
  each(part.group);
  each(part.name);
  each(part.globalNodes);
  each(part.globalElements);
  each(part.sideGroups);
  each(part.rules);
  each(part.rigidGroups);
  each(part.supports);
  each(part.springs);
  each(part.sharedOffsets);
  each(part.sharedWith);
  each(part.contactEnds);
  each(part.seamSides);
  each(part.seamEdges);
  each(part.contactCells);
  each(part.contactRows);
}

}  // namespace

void pack(const SubdomainMesh& part, Packer& packer) {
  forEachField(part, [&packer](const auto& field) { packer.put(field); });
}

void unpack(Unpacker& unpacker, SubdomainMesh& part) {
  forEachField(part, [&unpacker](auto& field) { unpacker.get(field); });
}

}  // namespace suture
