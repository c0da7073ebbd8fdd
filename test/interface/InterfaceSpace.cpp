#include <Teuchos_UnitTestHarness.hpp>
#include <interface/DenseSpace.hpp>
#include <interface/Interfaces.hpp>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(InterfaceSpace, HasTheSameUnknownsOnAnyNumberOfRanks) {
  const Twins t(loadedRectangle());
  // seams: one of 10 nodes along, two of 7 across, 2 crossings counted once; one node held on the left
  TEST_EQUALITY(t.spread.space->size(), 2 * (10 + 2 * 7 - 2 - 1));
  TEST_EQUALITY(t.single.space->size(), t.spread.space->size());
  const Twins c(pressedBlocks());
  TEST_EQUALITY(c.spread.space->size(), 2 * (2 * 7 + 2));  // y = -1/2, 1/2 and a free node of the seam beyond each
  TEST_EQUALITY(c.single.space->size(), c.spread.space->size());
}

TEUCHOS_UNIT_TEST(InterfaceSpace, KnowsWhereItsUnknownsAre) {
  const Twins t(loadedRectangle());
  for (std::size_t i = 0; i < t.spread.overlap.size(); ++i) {
    const GlobalId unknown = t.spread.overlap[i];
    const Point along = t.spread.space->direction(int(i));
    for (int k = 0; k < 3; ++k) TEST_EQUALITY(along[k], unknown % 2 == k ? 1.0 : 0.0);
    const Point expected = t.spread.scene.mesh.point(int(unknown / 2)), found = t.spread.space->point(int(i));
    for (int k = 0; k < 3; ++k) TEST_EQUALITY(found[k], expected[k]);
  }
}

TEUCHOS_UNIT_TEST(InterfaceSpace, GatherIsTheTransposeOfScatterAdd) {
  const Twins t(loadedRectangle());
  const InterfaceSpace& space = *t.spread.space;
  const MultiVectorPtr x = t.toSpread(random(t.size(), 1, 3));
  Matrix seen;
  space.gather(*x, seen);
  TEST_EQUALITY(seen.rows(), int(t.spread.overlap.size()));
  for (std::size_t i = 0; i < t.spread.overlap.size(); ++i)
    TEST_FLOATING_EQUALITY(seen(i, 0), random(t.size(), 1, 3)(t.place(t.spread.overlap[i]), 0), 1e-14);
  const Matrix other = random(int(seen.rows()), 1, 11 + world()->getRank());
  const MultiVectorPtr y = space.vector();
  space.scatterAdd(other, *y);
  double mine = other.col(0).dot(seen.col(0)), sum = 0.0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(sum));
  TEST_FLOATING_EQUALITY(dot(*x, *y), sum, 1e-12);
}

TEUCHOS_UNIT_TEST(InterfaceSpace, UnknownsThatVanishAreZeroForAll) {
  const Twins t(loadedRectangle());
  const InterfaceSpace& space = *t.spread.space;
  std::vector<int> places;
  for (int place = 0; place < space.overlapSize(); ++place)
    if (space.id(place) % 7 == 0) places.push_back(place);
  const auto without = space.without(places);
  const MultiVectorPtr x = t.toSpread(random(t.size(), 1, 3));
  Matrix all, seen;
  space.gather(*x, all);
  without->gather(*x, seen);
  for (const int place : places) {
    all(place, 0) = 0.0;
    TEST_EQUALITY(without->sharers(place).size(), 0);
    TEST_EQUALITY(without->entityOfPlaces()[place], -1);
  }
  TEST_EQUALITY((all - seen).norm(), 0.0);
  const MultiVectorPtr y = without->vector();
  without->scatterAdd(Matrix::Ones(space.overlapSize(), 1), *y);
  const auto owned = localView(static_cast<const MultiVector&>(*y));
  for (const int place : places)
    if (space.ownedRow(place) >= 0) TEST_EQUALITY(owned(space.ownedRow(place), 0), 0.0);
}

TEUCHOS_UNIT_TEST(InterfaceSpace, SumsCountTheLocalProblemsThatMeet) {
  const Twins t(loadedRectangle());
  const InterfaceSpace& space = *t.spread.space;
  Matrix count = Matrix::Zero(int(t.spread.overlap.size()), 1);
  for (int i = 0; i < space.locals(); ++i) space.coupling(i).addTransposed(Matrix::Ones(space.coupling(i).rows(), 1), count);
  space.sum(count);
  for (std::size_t i = 0; i < t.spread.overlap.size(); ++i) {
    const Point p = space.point(int(i));
    const bool crossing = p[1] == 1.0 && (p[0] == 1.0 || p[0] == 2.0);
    TEST_EQUALITY(count(i, 0), crossing ? 4.0 : 2.0);
  }
}

// Unknowns of vertices and of edges' ends.
std::vector<char> pointsOf(const InterfaceSpace& space) {
  std::vector<char> points(space.overlapSize(), 0);
  for (const InterfaceEntity& entity : space.entities())
    for (const int place : entity.kind == EntityKind::Vertex ? entity.unknowns : entity.ends) points[place] = 1;
  return points;
}

// 3 x 3 subdomains of 4 x 4 cells, free. By hand: 4 cross points and 8 end points of seams; 12 edges of 3 nodes.
TEUCHOS_UNIT_TEST(InterfaceSpace, KnowsEntitiesAndSharersOfAGrid) {
  const Twins t(square(3, 4));
  const InterfaceSpace& space = *t.spread.space;
  int counts[3] = {0, 0, 0}, all[3];
  const std::vector<char> points = pointsOf(space);
  for (int i = 0; i < space.overlapSize(); ++i) {
    if (space.map()->getLocalElement(space.id(i)) < 0) continue;  // count each once
    counts[0] += points[i];
    counts[1] += space.sharers(i).size() == 4;
    counts[2] += space.sharers(i).size() == 2;
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 3, counts, all);
  TEST_EQUALITY(all[0], 2 * (4 + 8));
  TEST_EQUALITY(all[1], 2 * 4);
  TEST_EQUALITY(all[2], 2 * (8 + 12 * 3));

  std::set<int> mine;
  for (int i = 0; i < space.locals(); ++i) mine.insert(space.localId(i));
  Packer packer;
  const std::vector<int> entityOf = space.entityOfPlaces();
  for (std::size_t e = 0; e < space.entities().size(); ++e) {
    const InterfaceEntity& entity = space.entities()[e];
    TEST_ASSERT(!entity.contact);
    TEST_ASSERT(std::any_of(entity.sharers.begin(), entity.sharers.end(), [&](int s) { return mine.count(s) > 0; }));
    const bool vertex = entity.kind == EntityKind::Vertex;
    TEST_EQUALITY(entity.unknowns.size(), vertex ? 2u : 2u * 3u + entity.ends.size());
    std::vector<GlobalId> ids(entity.sharers.begin(), entity.sharers.end());
    for (const int place : entity.unknowns) {
      TEST_ASSERT(space.sharers(place) == entity.sharers);
      TEST_EQUALITY(entityOf[place], int(e));
      ids.push_back(space.id(place));
    }
    if (!vertex) packer.put(ids);
  }
  std::set<std::vector<GlobalId>> edges;  // an edge that two ranks describe must be identical, including the order of its unknowns
  for (const std::string& bytes : allGather(*world(), packer.bytes())) {
    Unpacker unpacker(bytes);
    while (!unpacker.done()) edges.insert(unpacker.get<std::vector<GlobalId>>());
  }
  TEST_EQUALITY(edges.size(), 12u);
}

// Local problems by hand, distributed over the ranks; every rank sees every unknown that a relation names.
struct ByHand {
  InterfaceLayout layout;
  std::shared_ptr<const InterfaceSpace> space;
  ByHand(const std::vector<std::vector<GlobalId>>& boundaries, const std::vector<GlobalId>& partners, int dimension = 2) {
    for (int i = world()->getRank(); i < int(boundaries.size()); i += world()->getSize()) {
      layout.dimension = dimension;  // unknown to other ranks
      layout.locals.push_back(i);
      layout.boundaries.push_back(boundaries[i]);
      for (const GlobalId id : boundaries[i]) layout.unknowns.push_back({id, {double(id), 0, 0}, {1, 0, 0}});
    }
    layout.partners = partners;
    space = std::make_shared<InterfaceSpace>(world(), layout);
  }
  int at(GlobalId id) const { return int(space->overlap()->getLocalElement(id)); }
};

// 20 = -0.5 x 30;  4 = 2 x 13 + 0.25 x 31;  2 = 0
struct Related : ByHand {
  std::shared_ptr<const InterfaceSpace> plain = space;
  Related() : ByHand({{1, 2, 3, 4}, {1, 2, 11, 12, 13, 20}, {3, 4, 30, 31}, {11, 12, 13, 31}}, {2, 4, 13, 20, 30, 31}) {
    space = plain->related({{at(20), {at(30)}, {-0.5}}, {at(4), {at(13), at(31)}, {2.0, 0.25}}, {at(2), {}, {}}}, {});
  }
  static Matrix expected(const DenseSpace& all) {
    Matrix t = Matrix::Identity(all.size(), all.size());
    for (GlobalId id : {20, 4, 2}) t(all.place(id), all.place(id)) = 0.0;
    t(all.place(20), all.place(30)) = -0.5;
    t(all.place(4), all.place(13)) = 2.0;
    t(all.place(4), all.place(31)) = 0.25;
    return t;
  }
};

TEUCHOS_UNIT_TEST(InterfaceSpace, KnowsItsDimensionOnRanksWithoutLocalProblems) {
  const ByHand one({{1, 2}}, {}, 3);  // on rank 0 alone
  TEST_EQUALITY(one.space->dimension(), 3);
  TEST_EQUALITY(one.space->related({}, {})->dimension(), 3);
}

TEUCHOS_UNIT_TEST(InterfaceSpace, GathersAndScattersWithRelations) {
  const Related r;
  const DenseSpace all(*r.space);
  TEST_EQUALITY(all.size(), 10);
  const Matrix t = Related::expected(all);
  double spread = 1.0;
  TEST_EQUALITY((all.gathered(&spread) - t).norm(), 0.0);
  TEST_EQUALITY(spread, 0.0);
  // contributions of every rank, and their sum by hand
  const Matrix own = random(r.space->overlapSize(), 2, 5 + world()->getRank());
  Matrix mine = Matrix::Zero(all.size(), 2), sum(all.size(), 2);
  for (int i = 0; i < own.rows(); ++i) mine.row(all.place(r.space->id(i))) += own.row(i);
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), sum.data());
  const MultiVectorPtr owned = r.space->vector(2);
  r.space->scatterAdd(own, *owned);
  TEST_COMPARE(difference(all.dense(*owned), t.transpose() * sum), <, 1e-15);
  Matrix overlap = own;
  r.space->sum(overlap);
  const Matrix expected = t * t.transpose() * sum;
  for (int i = 0; i < overlap.rows(); ++i) TEST_COMPARE((overlap.row(i) - expected.row(all.place(r.space->id(i)))).norm(), <, 1e-14);
}

TEUCHOS_UNIT_TEST(InterfaceSpace, DensitiesGiveAPartitionOfUnityWithRelations) {
  const Related r;
  const DenseSpace all(*r.space);
  std::vector<Matrix> densities;
  Matrix sum = Matrix::Zero(r.space->overlapSize(), 1);
  for (int i = 0; i < r.space->locals(); ++i) {
    const Coupling& coupling = r.space->coupling(i);
    densities.push_back((random(coupling.rows(), 1, 40 + r.space->localId(i)).array() + 1.5).matrix());  // between 0.5 and 2.5
    coupling.addTransposed(densities.back(), sum);
  }
  r.space->sumDensities(sum);
  // sum over local problems of (R_i T)^T D_i (R_i T)
  Matrix mine = Matrix::Zero(all.size(), all.size()), unity(all.size(), all.size());
  const Matrix t = Related::expected(all);
  for (int i = 0; i < r.space->locals(); ++i)
    for (int k = 0; k < r.space->coupling(i).rows(); ++k) {
      const int place = r.space->coupling(i).columns()[k];
      const Matrix row = t.row(all.place(r.space->id(place)));
      if (sum(place) > 0.0) mine += row.transpose() * (densities[i](k) / sum(place)) * row;
    }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, int(mine.size()), mine.data(), unity.data());
  Matrix identity = Matrix::Identity(all.size(), all.size());
  for (GlobalId idle : {20, 4, 2}) identity(all.place(idle), all.place(idle)) = 0.0;
  TEST_COMPARE((unity - identity).norm(), <, 1e-14);
}

TEUCHOS_UNIT_TEST(InterfaceSpace, RelationsJoinSharersAndHoldUnknownsThatSeveralExpress) {
  const Related r;
  const auto sharers = [&](GlobalId id) { return r.space->sharers(r.at(id)); };
  TEST_ASSERT((sharers(30) == std::vector<int>{1, 2}));
  TEST_ASSERT((sharers(13) == std::vector<int>{0, 1, 2, 3}));
  TEST_ASSERT((sharers(31) == std::vector<int>{0, 2, 3}));
  const std::vector<char> points = pointsOf(*r.space);
  for (GlobalId expressed : {20, 4, 2}) {
    TEST_ASSERT(sharers(expressed).empty());
    TEST_EQUALITY(r.space->entityOfPlaces()[r.at(expressed)], -1);
    TEST_ASSERT(r.space->relation(r.at(expressed)) != nullptr);
    TEST_EQUALITY(r.plain->sharers(r.at(expressed)).size(), expressed == 20 ? 1u : 2u);  // the space itself is unchanged
  }
  // 30 is shared by two through a relation only, on no chain: it would be in no edge.
  TEST_ASSERT(points[r.at(13)] && points[r.at(31)] && points[r.at(30)]);
  TEST_THROW(r.space->related({}, {}), InternalError);
}

// Two local problems below (1 to 5 and 5 to 9: the seam between them ends on the line at 5), one above (101 to 109); pair 8 is open.
TEUCHOS_UNIT_TEST(InterfaceSpace, ChainsAreCutWhereLocalProblemsChangeAndPairsOpen) {
  std::vector<GlobalId> partners;
  for (GlobalId k = 1; k <= 9; ++k) partners.insert(partners.end(), {k, 100 + k});
  const ByHand hand({{1, 2, 3, 4, 5}, {5, 6, 7, 8, 9}, {101, 102, 103, 104, 105, 106, 107, 108, 109}}, partners);
  std::vector<InterfaceRelation> relations;
  std::vector<std::vector<int>> chains(2);
  for (GlobalId k = 1; k <= 9; ++k) {
    if (k == 8) continue;
    relations.push_back({hand.at(k), {hand.at(100 + k)}, {1.0}});
    chains[k == 9].push_back(hand.at(k));
  }
  const auto space = hand.space->related(relations, chains);
  for (GlobalId k = 1; k <= 9; ++k) {
    const std::vector<int> below = k < 5 ? std::vector<int>{0} : k == 5 ? std::vector<int>{0, 1} : std::vector<int>{1};
    std::vector<int> both = below;
    both.push_back(2);
    TEST_ASSERT(space->sharers(hand.at(k)) == (k == 8 ? below : std::vector<int>()));
    TEST_ASSERT(space->sharers(hand.at(100 + k)) == (k == 8 ? std::vector<int>{2} : both));
    TEST_EQUALITY(bool(pointsOf(*space)[hand.at(100 + k)]), k == 1 || k == 5 || k == 7 || k == 9);
    TEST_ASSERT(!pointsOf(*space)[hand.at(k)]);
  }
  std::map<std::vector<int>, std::vector<GlobalId>> edges;  // by sharers
  for (const InterfaceEntity& entity : space->entities()) {
    TEST_ASSERT(entity.contact);
    std::vector<GlobalId> ids;
    for (const int place : entity.unknowns) ids.push_back(space->id(place));
    if (entity.kind == EntityKind::Edge)
      edges[entity.sharers] = ids;
    else  // where the seam meets the line, and the last pair, alone behind the open one
      TEST_ASSERT(ids == std::vector<GlobalId>{105} || ids == std::vector<GlobalId>{109});
  }
  TEST_EQUALITY(edges.size(), 2u);
  TEST_ASSERT((edges[{0, 2}] == std::vector<GlobalId>{101, 102, 103, 104}));
  TEST_ASSERT((edges[{1, 2}] == std::vector<GlobalId>{106, 107}));
}

}  // namespace
}  // namespace suture
