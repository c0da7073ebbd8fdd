#include <suture/partition/SubdomainBytes.hpp>

namespace suture {
namespace {

// One list of fields for both directions: `each` puts or gets.
template <typename ContactRowRef, typename Each>
void forEachFieldOfRow(ContactRowRef& row, const Each& each) {
  each(row.pair);
  each(row.dofs);
  each(row.coefficients);
  each(row.gap);
  each(row.cluster);
  each(row.points);
}

template <typename SubdomainMeshRef, typename Each>
void forEachField(SubdomainMeshRef& part, const Each& each) {
  each(part.dimension);
  each(part.coordinates);
  each(part.cells);
  each(part.offsets);
  each(part.connectivity);
  each(part.axisymmetric);
  each(part.regions);
  each(part.id);
  each(part.body);
  each(part.group);
  each(part.name);
  each(part.globalNodes);
  each(part.globalElements);
  each(part.sideGroups);
  each(part.rules);
  each(part.sharedOffsets);
  each(part.sharedWith);
  each(part.contactEnds);
  each(part.seamSides);
}

}  // namespace

void pack(const SubdomainMesh& part, Packer& packer) {
  const auto put = [&packer](const auto& field) { packer.put(field); };
  forEachField(part, put);
  packer.put(part.contactRows.size());
  for (const ContactRow& row : part.contactRows) forEachFieldOfRow(row, put);
}

void unpack(Unpacker& unpacker, SubdomainMesh& part) {
  const auto get = [&unpacker](auto& field) { unpacker.get(field); };
  forEachField(part, get);
  const auto rows = unpacker.get<std::size_t>();
  for (std::size_t i = 0; i < rows; ++i) {
    part.contactRows.emplace_back();
    forEachFieldOfRow(part.contactRows.back(), get);
  }
}

}  // namespace suture
