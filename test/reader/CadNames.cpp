#include <suture/reader/cad/CadNames.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

using namespace suture;
using Kind = SurfaceShape::Kind;
using Names = std::vector<std::string>;

namespace {

CadBody body(const std::string& label, const Point& low = {0, 0, 0}, const Point& high = {1, 1, 1}) { return {label, low, high}; }

CadFace face(Kind kind, const Point& centre, const Point& normal = {0, 0, 0}, double area = 1) {
  CadFace made;
  made.shape.kind = kind;
  made.shape.axis = normal;
  made.centre = centre;
  made.area = area;
  return made;
}

}  // namespace

TEUCHOS_UNIT_TEST(CadNames, MakesLegalAndUniqueNamesOfBodies) {
  TEST_ASSERT(cadBodyNames({body("Shapes/fork/pin")}) == Names{"pin"});
  TEST_ASSERT(cadBodyNames({body("Shapes/base plate (steel)")}) == Names{"base_plate_steel"});
  TEST_ASSERT(cadBodyNames({body("Shapes/a=b->{c}, \"d\"")}) == Names{"a_b_c_d"});
  TEST_ASSERT(cadBodyNames({body("Shapes/Tr\xc3\xa4ger")}) == Names{"Tr\xc3\xa4ger"});
  TEST_ASSERT(cadBodyNames({body("")}) == Names{"body_1"});
  TEST_ASSERT(cadBodyNames({body("Shapes/Open CASCADE STEP translator 7.6 1/1/Open CASCADE STEP translator 7.6 1.1")}) == Names{"body_1"});
  // Bodies with the same name are numbered by place, and skip a name that is taken.
  TEST_ASSERT((cadBodyNames({body("bolt", {9, 0, 0}, {10, 1, 1}), body("bolt_1"), body("bolt", {3, 0, 0}, {4, 1, 1})}) ==
               Names{"bolt_3", "bolt_1", "bolt_2"}));
}

TEUCHOS_UNIT_TEST(CadNames, NamesTheEndsOfABody) {
  const std::vector<CadBody> bodies{body("plate", {-1, -2, -3}, {1, 2, 3})};
  const std::vector<CadFace> faces{
      face(Kind::Plane, {-1, 0, 0}, {-1, 0, 0}), face(Kind::Plane, {1, 0, 0}, {1, 0, 0}),    face(Kind::Plane, {0, -2, 0}, {0, -1, 0}),
      face(Kind::Plane, {0, 2, 0}, {0, 1, 0}),   face(Kind::Plane, {0, 0, -3}, {0, 0, -1}),  face(Kind::Plane, {0, 0, 3}, {0, 0, 1}),
      face(Kind::Plane, {0, 0, 1}, {0, 0, 1}),  // a step below the top
      face(Kind::Plane, {0, 0, 3}, {0, .6, .8}), face(Kind::Cylinder, {0, 0, 3}, {0, 0, 1}), face(Kind::Other, {0, 0, 0})};
  TEST_ASSERT((cadFaceNames(faces, bodies, {"plate"}) == Names{"plate_left", "plate_right", "plate_front", "plate_back", "plate_bottom",
                                                               "plate_top", "plate_plane_1", "plate_plane_2", "plate_cylinder_1",
                                                               "plate_surface_1"}));
  // Two feet at the same height.
  TEST_ASSERT((cadFaceNames({face(Kind::Plane, {.5, 0, -3}, {0, 0, -1}), face(Kind::Plane, {-.5, 0, -3}, {0, 0, -1})}, bodies, {"table"}) ==
               Names{"table_bottom_2", "table_bottom_1"}));
}

// The numbers follow the places: neither the order in the file nor round-off changes them.
TEUCHOS_UNIT_TEST(CadNames, DependsNeitherOnTheOrderNorOnRoundOff) {
  const std::vector<CadBody> bodies{body("a", {0, 0, 0}, {30, 30, 30}), body("b", {0, 0, 0}, {30, 30, 30})};
  std::vector<CadFace> faces;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        faces.push_back(face(Kind::Cylinder, {10. * i, 10. * j, 10. * k}));
        faces.back().body = i % 2;
        faces.push_back(face(Kind::Cylinder, {10. * i, 10. * j, 10. * k}, {0, 0, 0}, 2));  // around the same axis, larger
        faces.back().body = i % 2;
      }
  const Names expected = cadFaceNames(faces, bodies, {"a", "b"});
  TEST_EQUALITY(expected[0], "a_cylinder_1");
  TEST_EQUALITY(expected[1], "a_cylinder_2");
  TEST_EQUALITY(expected.back(), "a_cylinder_36");
  TEST_EQUALITY(std::set<std::string>(expected.begin(), expected.end()).size(), expected.size());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1e-8, 1e-8);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::size_t> order(faces.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), random);
    std::vector<CadFace> shuffled;
    for (const std::size_t i : order) {
      shuffled.push_back(faces[i]);
      for (double& c : shuffled.back().centre) c += noise(random);
      shuffled.back().area += noise(random);
    }
    const Names names = cadFaceNames(shuffled, bodies, {"a", "b"});
    for (std::size_t i = 0; i < order.size(); ++i) TEST_EQUALITY(names[i], expected[order[i]]);
  }
}
