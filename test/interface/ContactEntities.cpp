// Entities of the interface between bodies in contact: all ranks whose local problems share one must see the same.
#include <interface/ContactScenes.hpp>
#include <support/DryLaw.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/constraints/BuildConstraints.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <map>
#include <set>

namespace suture::blocks {

namespace {

/// A wall of two courses: two bricks below, a half, a whole and a half one above, in contact with each other at bed joint and head joints.
/// Edges of bricks lie in several joints: their pairs make clusters of more than two bodies.
Scene wall(const std::shared_ptr<const ContactLaw>& law) {
  const auto brick = [](const std::string& name, double x0, double x1, double z0) {
    Box box;
    box.name = name;
    box.x0 = x0;
    box.x1 = x1;
    box.y1 = 0.5;
    box.z0 = z0;
    box.z1 = z0 + 0.5;
    box.nx = static_cast<int>(2.0 * (x1 - x0));
    box.ny = box.nz = 1;
    box.cell = Cell::Hexahedron8;
    return box;
  };
  Scene scene = scenes::fromBoxes({brick("below0", 0.0, 1.0, 0.0), brick("below1", 1.0, 2.0, 0.0), brick("above0", 0.0, 0.5, 0.5),
                                   brick("above1", 0.5, 1.5, 0.5), brick("above2", 1.5, 2.0, 0.5)},
                                  1.0, 0.2);
  scene.model.dimension = 3;
  Contact bed = Contact::between("below0_top", "above0_bottom");
  bed.groupsA = {"below0_top", "below1_top"};
  bed.groupsB = {"above0_bottom", "above1_bottom", "above2_bottom"};
  const std::vector<Contact> contacts{Contact::between("below0_right", "below1_left"), Contact::between("above0_right", "above1_left"),
                                      Contact::between("above1_right", "above2_left"), bed};
  scene.constraints = buildConstraints(scene.mesh, {}, contacts);
  applyLaws(ContactLaws({law, law, law, law}), scene.mesh, scene.constraints);
  for (const char* below : {"below0_bottom", "below1_bottom"})
    for (int k = 0; k < 3; ++k) scene.hold(below, k, 0.0);
  return scene;
}

/// An entity as it is told to other ranks: its kind, sharers, unknowns in their order, ends.
using Told = std::vector<std::vector<GlobalId>>;

/// Entities on which the ranks differ that have one of its sharers. Collective.
int differing(const InterfaceSpace& space) {
  Packer packer;
  std::vector<int> locals;
  for (int i = 0; i < space.locals(); ++i) locals.push_back(space.localId(i));
  packer.put(locals);
  packer.put(space.entities().size());
  for (const InterfaceEntity& entity : space.entities()) {
    std::vector<GlobalId> unknowns, ends;
    for (const int place : entity.unknowns) unknowns.push_back(space.id(place));
    for (const int place : entity.ends) ends.push_back(space.id(place));
    packer.put(std::vector<GlobalId>{static_cast<GlobalId>(entity.kind)});
    packer.put(std::vector<GlobalId>(entity.sharers.begin(), entity.sharers.end()));
    packer.put(unknowns);
    packer.put(ends);
  }
  std::map<Told, std::set<int>> seen;
  std::map<int, int> rankOf;
  int rank = 0;
  for (const std::string& bytes : allGather(*space.comm(), packer.bytes())) {
    Unpacker unpacker(bytes);
    for (const int id : unpacker.get<std::vector<int>>()) rankOf[id] = rank;
    for (auto left = unpacker.get<std::size_t>(); left > 0; --left) {
      Told entity(4);
      for (auto& part : entity) part = unpacker.get<std::vector<GlobalId>>();
      seen[entity].insert(rank);
    }
    ++rank;
  }
  int count = 0;
  for (const auto& [entity, ranks] : seen) {
    bool same = true;
    for (const GlobalId sharer : entity[1]) same = same && ranks.count(rankOf.at(static_cast<int>(sharer))) > 0;
    count += !same;
  }
  return count;
}

}  // namespace

TEUCHOS_UNIT_TEST(ContactEntities, AreTheSameOnAllRanksThatShareThem) {
  for (const double coefficient : {0.0, 0.6}) {
    const Scene scene = wall(scenes::dry(0.0, coefficient));
    const OnInterface bodies(scene, world(), 5, 1);
    for (const int openEvery : {0, 2, 3, 5}) {
      const auto matrix = bodies.matrix(scene, openEvery);
      TEST_EQUALITY(differing(*matrix->space()), 0);
      int faces = 0;
      for (const InterfaceEntity& entity : matrix->space()->entities()) faces += entity.contact;
      TEST_ASSERT(faces > 0 || matrix->space()->locals() == 0);
    }
  }
}

}  // namespace suture::blocks
