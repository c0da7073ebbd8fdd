#include <Teuchos_UnitTestHarness.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <reader/MeshTesting.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/PartitionFile.hpp>
#include <suture/partition/SubdomainBytes.hpp>
#include <suture/reader/Hdf5Mesh.hpp>

#include "Scenes.hpp"

using namespace suture;
using namespace partitiontesting;

namespace {

const MadeFor madeFor = {{"Bodies", "<two/>"}, {"Contact", "<one/>"}};

// Two stacked boxes with contact, cut by METIS; the file is written by rank 0, as suture_partition does.
struct Written {
  meshtesting::Folder folder;
  Mesh whole = mesh({box("low", 0, 4, 0, 1, 24, 6), box("top", 0, 4, 1, 2, 24, 6)});
  Constraints constraints;
  Partition partition;
  std::string path = folder.path() + "/cut.h5";

  Written() {
    addContact(whole, "low_top", "top_bottom", constraints);
    partition = makePartition(*comm(), whole, constraints, metis(7).list(), false);
    writeHdf5Mesh(*comm(), whole, path, [&](Hdf5Writer& file) { addPartition(file, whole, constraints, partition, madeFor, "remarks"); });
  }
  /// Changes a letter in the name of a body's first subdomain, wherever it occurs in the file.
  void damage() const {
    if (onRoot()) {
      std::ifstream in(path, std::ios::binary);
      std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      in.close();
      for (std::size_t at = bytes.find("top 1"); at != std::string::npos; at = bytes.find("top 1", at + 1)) bytes[at + 4] = '8';
      std::ofstream(path, std::ios::binary) << bytes;
    }
    comm()->barrier();
  }
  std::string error() const {
    try {
      readPartitionedMesh(*comm(), path, madeFor, false);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

std::string bytesOf(const SubdomainMesh& part) {
  Packer packer;
  pack(part, packer);
  return packer.bytes();
}

/// Bytes of an object in a message. \param before  content of its memory before construction
template <typename T>
std::string packedOver(unsigned char before) {
  alignas(T) unsigned char memory[sizeof(T)];
  std::fill(std::begin(memory), std::end(memory), before);
  const T* object = new (memory) T;  // not T(), which also sets the padding bytes
  Packer packer;
  packer.put(*object);
  object->~T();
  return packer.bytes();
}

// Files of the same cut are identical, byte by byte: padding of structs is in none of them.
TEUCHOS_UNIT_TEST(PartitionFile, HoldsNoBytesThatNobodyHasSet) {
  TEST_EQUALITY(packedOver<NodeRule>(0x00), packedOver<NodeRule>(0xff));
  TEST_EQUALITY(packedOver<RuleValue>(0x00), packedOver<RuleValue>(0xff));
  TEST_EQUALITY(packedOver<PairEnd>(0x00), packedOver<PairEnd>(0xff));
  TEST_EQUALITY(packedOver<ContactPair::Past>(0x00), packedOver<ContactPair::Past>(0xff));
  TEST_EQUALITY(packedOver<Support>(0x00), packedOver<Support>(0xff));
  TEST_EQUALITY(packedOver<SpringDirection>(0x00), packedOver<SpringDirection>(0xff));
}

}  // namespace

// Each rank reads what distribute() would have sent to it, byte by byte.
TEUCHOS_UNIT_TEST(PartitionFile, EqualsTheMessagesOfDistribute) {
  Written scene;
  for (const bool keepGroupsWhole : {false, true}) {
    const PartitionedMesh read = readPartitionedMesh(*comm(), scene.path, madeFor, keepGroupsWhole);
    const Partition expected = makePartition(*comm(), scene.whole, scene.constraints, metis(7).list(), keepGroupsWhole);
    const std::vector<SubdomainMesh> meshes = distribute(*comm(), scene.whole, scene.constraints, expected);
    TEST_ASSERT(read.partition.rankOf == expected.rankOf);
    TEST_ASSERT(read.partition.names == expected.names);
    TEST_ASSERT(read.partition.groups == expected.groups);
    TEST_EQUALITY(read.remarks, "remarks");
    TEST_EQUALITY(read.mine.size(), meshes.size());
    for (std::size_t i = 0; i < std::min(read.mine.size(), meshes.size()); ++i) TEST_ASSERT(bytesOf(read.mine[i]) == bytesOf(meshes[i]));
  }
  // and the file is an ordinary mesh, too
  const Mesh again = readHdf5Mesh(*comm(), scene.path);
  if (onRoot()) TEST_EQUALITY(again.hash(), scene.whole.hash());
}

TEUCHOS_UNIT_TEST(PartitionFile, NamesTheListsThatChanged) {
  Written scene;
  try {
    readPartitionedMesh(*comm(), scene.path, {{"Bodies", "<two/>"}, {"Contact", "<other/>"}}, false);
    TEST_ASSERT(false);
  } catch (const InputError& error) {
    const std::string text = error.what();
    TEST_INEQUALITY(text.find("Contact"), std::string::npos);
    TEST_EQUALITY(text.find("Bodies"), std::string::npos);
    TEST_INEQUALITY(text.find("run suture_partition again"), std::string::npos);
  }
}

TEUCHOS_UNIT_TEST(PartitionFile, RefusesDamagedTruncatedAndForeignFiles) {
  {
    Written scene;
    scene.damage();
    TEST_INEQUALITY(scene.error().find("damaged"), std::string::npos);
  }
  {
    Written scene;
    if (onRoot()) std::filesystem::resize_file(scene.path, std::filesystem::file_size(scene.path) - 5000);
    comm()->barrier();
    TEST_INEQUALITY(scene.error(), "no error");
  }
  {
    Written scene;
    writeHdf5Mesh(*comm(), scene.whole, scene.path);
    TEST_INEQUALITY(scene.error().find("not partitioned"), std::string::npos);
  }
  {
    Written scene;
    writeHdf5Mesh(*comm(), scene.whole, scene.path, [](Hdf5Writer& file) {
      file.group("/Partition");
      file.attribute("/Partition", "Version", std::string("0.1"));
    });
    TEST_INEQUALITY(scene.error().find("format version 0.1"), std::string::npos);
  }
}
