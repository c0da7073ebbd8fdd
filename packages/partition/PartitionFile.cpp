#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/partition/Cutter.hpp>
#include <suture/partition/PartitionFile.hpp>
#include <suture/partition/SubdomainBytes.hpp>

#include <Teuchos_Comm.hpp>

#include <cstdint>

namespace suture {

namespace {

constexpr const char* kGroup = "/Partition";
std::string at(const char* name) { return std::string(kGroup) + "/" + name; }

/// Version of the format, sizes of the types that are written in their memory layout (which depends on the compiler), and the bytes of a
/// mesh with one contact row, which change when a field is added or removed.
std::string version() {
  std::string text = "8";
  SubdomainMesh sample;
  sample.contactRows.resize(1);
  sample.contactRows[0].equations.resize(1);
  Packer packer;
  pack(sample, packer);
  text += "." + std::to_string(std::move(packer).bytes().size());
  for (const std::size_t size : {sizeof(NodeRule), sizeof(Support), sizeof(SpringDirection), sizeof(Side), sizeof(PairEnd), sizeof(Coating),
                                 sizeof(SubdomainMesh::ContactEnd), sizeof(SubdomainMesh::SeamSide), sizeof(Cell), sizeof(std::size_t)})
    text += "." + std::to_string(size);
  return text;
}

/// FNV-1a over words of eight bytes: protects against damage, not against malice, at memory speed.
GlobalId checksum(const std::string& bytes) {
  std::uint64_t state = 14695981039346656037ULL;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    state = (state ^ word) * 1099511628211ULL;
    state ^= state >> 29;
  }
  return static_cast<GlobalId>(state >> 1);
}

std::vector<unsigned char> plain(const std::string& bytes) { return {bytes.begin(), bytes.end()}; }

void mustBeSound(const std::string& path, const std::string& what, const std::string& bytes, GlobalId expected) {
  if (checksum(bytes) != expected) throw InputError("Mesh/File", path + ": " + what + " is damaged; run suture_partition again");
}

}  // namespace

Schema partitionedMeshSchema() {
  return Schema("The subdomains that suture_partition has written to Mesh/File for this scene; each rank reads its own.");
}

void addPartition(Hdf5Writer& file, const Mesh& mesh, const Constraints& constraints, const Partition& partition, const MadeFor& madeFor,
                  const std::string& remarks) {
  file.group(kGroup);
  file.attribute(kGroup, "Version", version());
  Packer head;
  head.put(madeFor);
  head.put(packed(partition));
  head.put(remarks);
  std::vector<GlobalId> ends, checksums{checksum(head.bytes())};
  std::vector<unsigned char> all;
  const MeshShare share = wholeShare(mesh, partition.subdomainOfElement);
  const std::vector<Attachments> attachments = attachmentsOf(mesh, constraints, partition, share, 1, share.holders);
  Cutter cutter(mesh, share, attachments[0], partition);
  for (int s = 0; s < partition.subdomains(); ++s) {
    Packer packer;
    pack(cutter.cut(s), packer);
    all.insert(all.end(), packer.bytes().begin(), packer.bytes().end());
    ends.push_back(static_cast<GlobalId>(all.size()));
    checksums.push_back(checksum(packer.bytes()));
  }
  file.write(at("Head"), plain(head.bytes()));
  file.write(at("Ends"), ends);
  file.write(at("Checksums"), checksums);
  file.write(at("Subdomains"), all);
}

PartitionedMesh readPartitionedMesh(const Comm& comm, const std::string& path, const MadeFor& madeFor, bool keepGroupsWhole) {
  PartitionedMesh result;
  std::vector<GlobalId> ends, checksums;
  {
    const Hdf5Reader file(comm, path);
    if (!file.has(kGroup))
      throw InputError("Mesh/File", path + ": the mesh is not partitioned; run suture_partition, or choose another Partition/Type");
    if (const std::string found = file.readTextAttribute(kGroup, "Version"); found != version())
      throw InputError("Mesh/File",
                       path + ": format version " + found + "; this Suture reads " + version() + "; run suture_partition again");
    ends = file.readGlobalIds(at("Ends"));
    checksums = file.readGlobalIds(at("Checksums"));
    const std::string head = file.readBytes(at("Head"));
    if (checksums.size() != ends.size() + 1) throw InputError("Mesh/File", path + ": " + at("Checksums") + " does not fit " + at("Ends"));
    mustBeSound(path, at("Head"), head, checksums[0]);
    Unpacker unpacker(head);
    const auto other = unpacker.get<MadeFor>();
    Problems problems;
    for (const auto& [list, text] : madeFor)
      if (const auto found = other.find(list); found == other.end() || found->second != text)
        problems.add(list, "changed since " + path + " was made; run suture_partition again");
    problems.throwIfAny();
    unpackInto(unpacker.get<std::string>(), result.partition);
    result.remarks = unpacker.get<std::string>();
  }
  if (ends.size() != static_cast<std::size_t>(result.partition.subdomains()))
    throw InputError("Mesh/File", path + ": " + std::to_string(ends.size()) + " subdomains in the file, " +
                                      std::to_string(result.partition.subdomains()) + " in its head");
  placeOnRanks(result.partition, keepGroupsWhole, comm.getSize());
  const auto alone = comm.split(comm.getRank(), 0);
  collectively(comm, "reading the subdomains in " + path, [&] {
    const Hdf5Reader file(*alone, path);
    for (std::size_t s = 0; s < ends.size(); ++s) {
      if (result.partition.rankOf[s] != comm.getRank()) continue;
      const GlobalId begin = s > 0 ? ends[s - 1] : 0;
      std::string bytes = file.readBytes(at("Subdomains"), begin, ends[s] - begin);
      mustBeSound(path, "subdomain " + std::to_string(s), bytes, checksums[s + 1]);
      Unpacker unpacker(std::move(bytes));
      result.mine.emplace_back();
      unpack(unpacker, result.mine.back());
    }
  });
  return result;
}

}  // namespace suture
