#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Regions.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <reader/MeshTesting.hpp>

using namespace suture;

namespace {

Mesh twoBoxes() {
  std::vector<Box> all(2);
  all[0].name = "lower";
  all[1].name = "upper";
  for (Box& box : all) {
    box.nx = 7;
    box.ny = 5;
    box.brickX = 2;
    box.brickY = 3;
    box.blocksX = 7;
  }
  all[1].y0 = 1;
  all[1].y1 = 2;
  return boxes(all);
}

struct Entry {
  std::string body, region, group;
};

Parameters bodiesWith(const std::vector<Entry>& entries) {
  Parameters scene("Suture");
  Parameters& bodies = scene.sublist("Bodies");
  for (const char* body : {"lower", "upper"}) bodies.sublist(body).set<std::string>("Material", "rock");
  for (const Entry& entry : entries)
    bodies.sublist(entry.body).sublist("Regions").sublist(entry.region).set<std::string>("Group", entry.group);
  return bodies;
}

std::string problemsWith(const std::vector<Entry>& entries) {
  return meshtesting::problemsOf([&] {
    Mesh mesh = twoBoxes();
    const Parameters bodies = bodiesWith(entries);
    assignRegions(mesh, bodies);
  });
}

}  // namespace

TEUCHOS_UNIT_TEST(Regions, AreNumberedBodyByBodyAndLeaveTheRest) {
  Mesh mesh = twoBoxes();
  const Parameters bodies = bodiesWith(
      {{"upper", "hard", "upper_bricks_odd"}, {"lower", "seam", "subdomain_lower_3_0"}, {"lower", "edge", "subdomain_lower_0_0"}});
  assignRegions(mesh, bodies);
  const std::vector<RegionEntry> entries = regionEntries(bodies);
  TEST_EQUALITY(entries.size(), std::size_t(3));
  TEST_EQUALITY(entries[0].body, "lower");
  TEST_EQUALITY(entries[2].list->get<std::string>("Group"), "upper_bricks_odd");
  for (int e = 0; e < mesh.elements(); ++e) {
    const Point c = centreOf(mesh, e);
    const int column = int(c[0] * 7);
    int expected = -1;
    if (c[1] < 1)
      expected = column == 3 ? 0 : column == 0 ? 1 : -1;
    else if ((int(c[0] * 7) / 2 + int((c[1] - 1) * 5) / 3) % 2 == 1)
      expected = 2;
    TEST_EQUALITY(mesh.regions[e], expected);
  }
}

TEUCHOS_UNIT_TEST(Regions, CostNothingWhereThereAreNone) {
  Mesh mesh = twoBoxes();
  const std::string before = mesh.hash();
  assignRegions(mesh, bodiesWith({}));
  TEST_ASSERT(mesh.regions.empty());
  TEST_EQUALITY(mesh.hash(), before);
}

TEUCHOS_UNIT_TEST(Regions, RefuseAllThatIsWrongAtOnce) {
  const std::string said = problemsWith({{"lower", "misspelt", "lower_brick_odd"},
                                         {"lower", "stray", "subdomain_upper_3_0"},
                                         {"upper", "bricks", "upper_bricks_even"},
                                         {"upper", "column", "subdomain_upper_0_0"}});
  SUTURE_CHECK_SAYS(said,
                    "Bodies/lower/Regions/misspelt/Group: in the mesh boxes: no such surface group 'lower_brick_odd'. Did you mean "
                    "'lower_bricks_odd'? Known here: lower, lower_bricks_even");
  SUTURE_CHECK_SAYS(said,
                    "Bodies/lower/Regions/stray/Group: the surface group 'subdomain_upper_3_0' reaches outside the body 'lower': 10 "
                    "elements (the first at (");
  SUTURE_CHECK_SAYS(said, "in the body 'upper'; a region lies in one body");
  // The first column: three cells of an even brick, two of an odd one, two triangles each.
  SUTURE_CHECK_SAYS(said, "Bodies/upper/Regions/column/Group: 6 elements (the first at (");
  SUTURE_CHECK_SAYS(said, "also in Bodies/upper/Regions/bricks; an element belongs to one region");
}
