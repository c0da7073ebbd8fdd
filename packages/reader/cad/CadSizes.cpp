#include <suture/base/Point.hpp>
#include <suture/reader/cad/CadSizes.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kOfExtent = 0.1;  // largest size over the extent of a body
constexpr double kGrowth = 0.5;    // growth of the size with the distance
constexpr double kDetail = 0.05;   // size of elements on small details over the largest size of the body
constexpr double kLeast = 0.02;    // smallest size over the largest size of the smallest body, except on round faces
constexpr double kTiny = 1e-3;     // smallest size on round faces over the largest size of their body
// Size where bodies face each other over the size otherwise. With 1, 0.7, 0.5, 0.35 and 0.25, the largest pressure of a ball on a block
// (Hertz, radius of contact a fifth of the ball's) has errors of 7, 5, 6, 2 and 1 % with 3,400 to 5,400 nodes, and that of the clevis in
// tutorial 5 is 243 to 264 MPa with 3,200 to 10,600 nodes, its displacement the same within 0.4 %.
constexpr double kFacing = 0.5;
constexpr double kReach = 0.05;              // largest clearance of facing bodies over the extent of the smaller one: as in suture_new
constexpr double kOpposite = -0.5;           // largest cosine between normals that face each other
constexpr std::size_t kRayTests = 40000000;  // bounds the time: a fraction of a second

constexpr double kTurn = 2 * 3.14159265358979323846;

/// Largest size over the thickness of a wall: one second-order element, or three of first order.
double ofThickness(int order) { return order == 1 ? 1.0 / 3 : 1.0; }

/// Every how many triangles a loop visits to keep within `kRayTests` tests.
std::size_t strideFor(std::size_t own, std::size_t others) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(static_cast<double>(own) * static_cast<double>(others) / kRayTests));
}

bool boxesNear(const Skin& a, const Skin& b, double reach) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.low()[k] - reach > b.high()[k] || b.low()[k] - reach > a.high()[k]) return false;
  return true;
}

/// True if a triangle of another body faces this one within reach; the triangles there are about as large as these.
bool isFaced(const Skin::Triangle& own, const Skin& other, double reach) {
  return std::any_of(other.triangles().begin(), other.triangles().end(), [&](const Skin::Triangle& one) {
    if (dot(one.normal, own.normal) > kOpposite) return false;
    const Point way = minus(one.centre, own.centre);
    const double along = std::abs(dot(way, own.normal));
    return along <= reach && norm(way) <= along + std::sqrt(2 * (one.area + own.area));
  });
}

}  // namespace

CadSizes::CadSizes(const std::vector<Skin>& bodies, int order, const Radii& radii) : order_(order) {
  std::size_t total = 0;
  for (const Skin& skin : bodies) total += skin.triangles().size();
  for (const Skin& skin : bodies) {
    bodies_.push_back({kOfExtent * skin.extent(), {}, {}});
    least_ = least_ == 0.0 ? bodies_.back().most : std::min(least_, bodies_.back().most);
  }
  least_ *= kLeast;
  smallest_ = least_;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Skin& skin = bodies[b];
    const std::size_t stride = strideFor(skin.triangles().size(), total);
    Body& body = bodies_[b];
    for (std::size_t t = 0; t < skin.triangles().size(); t += stride) {
      const Skin::Triangle& triangle = skin.triangles()[t];
      double size = body.most;
      if (const auto thickness = skin.thicknessAt(t)) size = std::min(size, ofThickness(order) * *thickness);
      for (std::size_t other = 0; other < bodies.size(); ++other) {
        const double reach = kReach * std::min(skin.extent(), bodies[other].extent());
        if (other == b || !boxesNear(skin, bodies[other], reach) || !isFaced(triangle, bodies[other], reach)) continue;
        size *= kFacing;
        break;
      }
      size = std::max(size, least_);
      if (const auto round = radii.ofFace.find(triangle.face); round != radii.ofFace.end())
        size = std::min(size, ofRadius(b, round->second));
      smallest_ = std::min(smallest_, size);
      if (size < body.most) body.samples.push_back({triangle.centre, size});
    }
    for (const Radii::At& round : radii.at)
      if (round.body == b && ofRadius(b, round.radius) < body.most)
        body.samples.push_back({round.place, std::max(ofRadius(b, round.radius), least_)});
    std::vector<BoundingBox> places(body.samples.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i].include(body.samples[i].place);
    body.tree = std::make_shared<const BoxTree>(places);
  }
}

double CadSizes::ofRadius(std::size_t body, double radius) const {
  const double turn = kTurn * radius;
  const double most = bodies_[body].most;
  return std::max(kTiny * most, std::min(turn / leastPerTurn(order_), std::max(turn / elementsPerTurn(order_), kDetail * most)));
}

// The sample with the smallest size + growth * distance is the nearest one if each is moved away by size / growth.
double CadSizes::at(std::size_t body, const Point& place) const {
  const Body& own = bodies_[body];
  const auto away = [&](int i) { return norm(minus(own.samples[i].place, place)) + own.samples[i].size / kGrowth; };
  const int nearest = own.tree->nearest(place, away);
  return nearest < 0 ? own.most : std::min(own.most, kGrowth * away(nearest));
}

}  // namespace suture
