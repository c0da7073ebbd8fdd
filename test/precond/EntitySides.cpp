// Sides of the entities that subdomains share, and the data exchanged between them.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/Sheets.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/PrimalConstraints.hpp>

#include <set>

namespace suture {
namespace {

using namespace blocks;

/// Points that are separate primal unknowns, that all sharers include and that this side includes by a single row of its trace; without
/// code of the library.
std::set<double> singleRows(const InterfaceSpace& space, const std::vector<char>& alone, const EntitySide& side,
                            const std::vector<int>& sharers) {
  std::set<double> ids;
  for (const int column : space.coupling(side.local).columns()) {
    const InterfaceRelation* by = space.relation(column);
    if (by && by->others.size() != 1) continue;
    const int place = by ? by->others[0] : column;
    const std::vector<int>& all = space.sharers(place);
    if (alone[place] && std::includes(all.begin(), all.end(), sharers.begin(), sharers.end())) ids.insert(double(space.id(place)));
  }
  return ids;
}

// At a meeting point of contact lines one side may include a point only through a relation of several unknowns. Both sides leave the point
// out, on any ranks.
TEUCHOS_UNIT_TEST(EntitySides, AgreeOnThePointsThatTheyShare) {
  int differed = 0;
  Scene kinks = brickBlocks();  // along the line one unknown equals another; at its ends, and once inside, four are in one equation
  for (const std::size_t pair : {std::size_t(0), std::size_t(4), kinks.constraints.pairs.size() - 1})
    kinks.constraints.pairs[pair].normal = {0.6, 0.8, 0};
  for (const Scene& scene : {kinks, swapped(kinks), crossingBlocks()}) {
    const OnInterface one(scene, world());
    const auto matrix = one.problem.linearise(one.problem.initialState()).matrix;
    const InterfaceSpace& space = *matrix->space();
    const std::vector<char> alone = verticesAndEnds(space);
    const std::vector<InterfaceEntity> entities = withoutAlone(space, alone);
    const std::vector<EntitySide> sides = entitySides(space, entities);
    const std::vector<AloneRows> points = aloneRows(space, entities, sides, alone);
    const auto exchanged = [&](const auto& idsOf) {
      return exchangeSides(space, entities, sides, [&](std::size_t k) {
        const std::vector<double> ids = idsOf(k);
        return Matrix(Eigen::Map<const Matrix>(ids.data(), int(ids.size()), 1));
      });
    };
    const auto before = exchanged([&](std::size_t k) {
      const auto ids = singleRows(space, alone, sides[k], entities[sides[k].entity].sharers);
      return std::vector<double>(ids.begin(), ids.end());
    });
    const auto after = exchanged([&](std::size_t k) { return std::vector<double>(points[k].ids.begin(), points[k].ids.end()); });
    for (const EntitySide& side : sides) {
      const auto &all = before[side.entity], &both = after[side.entity];
      TEST_EQUALITY(both[0].rows(), both[1].rows());
      if (both[0].rows() == both[1].rows()) TEST_ASSERT(both[0] == both[1]);
      TEST_EQUALITY(both[0].rows(),
                    std::count_if(all[0].data(), all[0].data() + all[0].size(), [&](double id) { return (all[1].array() == id).any(); }));
      differed += all[0].rows() != all[1].rows();
    }
  }
  int all = 0;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, differed, Teuchos::outArg(all));
  out << all << " edges whose sides differed\n";
  TEST_COMPARE(all, >, 0);
}

// Three sharers, one or several on a rank: each gets the data of the others.
TEUCHOS_UNIT_TEST(EntitySides, ExchangeTheMatricesOfAllSharers) {
  const Sheets sheets(world());
  const InterfaceSpace& space = *sheets.matrix->space();
  const std::vector<InterfaceEntity> entities = withoutAlone(space, verticesAndEnds(space));
  const std::vector<EntitySide> sides = entitySides(space, entities);
  TEST_EQUALITY(int(sides.size()), space.locals());
  const auto all = exchangeSides(space, entities, sides, [&](std::size_t k) {
    TEST_EQUALITY(sides[k].rows.size(), 16u);
    return Matrix(Matrix::Constant(1 + space.localId(sides[k].local), 2, 10.0 * space.localId(sides[k].local)));
  });
  for (const auto& own : all)
    for (int sheet = 0; sheet < 3; ++sheet) TEST_ASSERT(own[sheet] == Matrix::Constant(1 + sheet, 2, 10.0 * sheet));
}

}  // namespace
}  // namespace suture
