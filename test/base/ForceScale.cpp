#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/ForceScale.hpp>

namespace suture {
namespace {

using Neighbours = std::vector<std::pair<int, int>>;

BodyForces loaded(double force) { return {force, 0.0, force, 1e-3}; }
BodyForces carrying(double force) { return {0.0, 0.0, force, 1e-3}; }

TEUCHOS_UNIT_TEST(ForceScale, IsTheForceOfABodyThatIsLoaded) {
  const auto scales = ForceScale::of({loaded(1e9), loaded(1e-6)}, {}, Neighbours{{0, 1}});
  TEST_EQUALITY(scales[0].force, 1e9);
  TEST_EQUALITY(scales[1].force, 1e-6);  // a strong neighbour does not hide its errors
  TEST_EQUALITY(scales[1].lent, 0.0);
  TEST_EQUALITY(scales[1].rounded, 0.0);
}

TEUCHOS_UNIT_TEST(ForceScale, LendsToIdleBodiesAlsoBehindOthersThatCarryNothing) {
  // A loaded body next to a chain of three bodies that carry only round-off.
  const auto scales =
      ForceScale::of({carrying(1e-18), carrying(1e-17), carrying(1e-16), loaded(10.0)}, {}, Neighbours{{0, 1}, {1, 2}, {2, 3}});
  for (int b = 0; b < 3; ++b) TEST_FLOATING_EQUALITY(scales[b].force, 1e-2, 1e-12);
}

TEUCHOS_UNIT_TEST(ForceScale, LendsNoMoreThanTheNeighbourHasWhereItCarriesMore) {
  // The middle body passes a hundredth of the load to the last one.
  const auto scales = ForceScale::of({carrying(1e-9), carrying(0.1), loaded(10.0)}, {}, Neighbours{{0, 1}, {1, 2}});
  TEST_FLOATING_EQUALITY(scales[1].force, 0.1, 1e-12);
  TEST_FLOATING_EQUALITY(scales[0].force, 1e-4, 1e-12);
}

TEUCHOS_UNIT_TEST(ForceScale, IsRoundOffOfThePathWhereNothingActsAnyMore) {
  const std::vector<BodyForces> past{loaded(5.0), carrying(5.0), carrying(0.0)};
  const auto scales = ForceScale::of({carrying(1e-14), carrying(1e-14), carrying(0.0)}, past, Neighbours{{0, 1}, {1, 2}});
  for (int b = 0; b < 3; ++b) TEST_FLOATING_EQUALITY(scales[b].rounded, 5e-12, 1e-12);
  // Small loads count as loads; round-off in a load factor that should be zero does not.
  TEST_EQUALITY(ForceScale::of({loaded(1e-8)}, {loaded(5.0)}, {})[0].rounded, 0.0);
  TEST_FLOATING_EQUALITY(ForceScale::of({loaded(1e-16)}, {loaded(5.0)}, {})[0].rounded, 5e-12, 1e-12);
}

TEUCHOS_UNIT_TEST(ForceScale, TakesTheLargestOfThePath) {
  BodyForces past;
  past.take({1.0, 4.0, 2.0, 8.0});
  past.take({2.0, 3.0, 1.0, 9.0});
  TEST_EQUALITY(past.loads, 2.0);
  TEST_EQUALITY(past.prescribed, 4.0);
  TEST_EQUALITY(past.force, 2.0);
  TEST_EQUALITY(past.deformation, 9.0);
}

}  // namespace
}  // namespace suture
