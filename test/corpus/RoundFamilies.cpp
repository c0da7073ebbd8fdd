#include <corpus/Families.hpp>

namespace suture::corpus {

namespace {

/// Grid of an annulus: s along the angle from `from` to `to`, t from the outer radius inwards (which keeps the orientation). Sides: outer
/// (t = 0), inner (t = 1), first (s = 0), last (s = 1).
GridBody annulus(const std::string& name, Point centre, double inner, double outer, double from, double to, int nt, int nr) {
  GridBody body;
  body.name = name;
  body.nx = nt;
  body.ny = nr;
  body.map = [=](double s, double t) {
    const double r = outer + (inner - outer) * t, angle = from + (to - from) * s;
    return Point{centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), 0};
  };
  body.side = [](int, int, Face face) -> std::string {
    return face == Face::Bottom ? "outer" : face == Face::Top ? "inner" : face == Face::Left ? "first" : "last";
  };
  return body;
}

/// Clearance, conforming or a small interference.
double clearance(Random& random) {
  const double kind = random.real(0, 1);
  return kind < 0.6 ? random.power(-5, -1) : kind < 0.8 ? 0.0 : -random.power(-6, -3);
}

}  // namespace

// The right half x >= 0, held on x = 0 by symmetry: free to move up and down only.
void disc(Builder& scene) {
  Random& random = scene.random;
  const double c = clearance(random);
  const int nt = 2 * random.integer(4, 8);
  scene.body(annulus("ring", {0, 0, 0}, 1 + c, 1 + c + random.real(0.2, 0.8), -pi / 2, pi / 2, random.chance(0.5) ? nt : nt + 3,
                     random.integer(1, 3)));
  scene.body(annulus("disc", {0, 0, 0}, random.real(0.2, 0.7), 1, -pi / 2, pi / 2, nt, random.integer(2, 4)));
  for (const char* body : {"ring", "disc"})
    for (const char* end : {"_first", "_last"}) scene.roller(std::string(body) + end);
  scene.fix("ring_outer");
  scene.contact("ring_inner", "disc_outer", true);
  if (random.chance(0.6))
    scene.bodyForce("disc", {random.chance(0.5) ? 0.0 : random.real(-0.3, 0.3), random.sign(), 0});
  else
    scene.traction("disc_inner", {random.real(-0.2, 0.2), random.sign(), 0});
}

// The half y >= 0 of a plate with a hole on a pin, held on y = 0 by symmetry.
void lug(Builder& scene) {
  Random& random = scene.random;
  const double c = clearance(random), width = random.real(1.6, 3), hole = 1 + std::max(c, -0.001);
  const int k = scene.refinement, nt = 4 * k * random.integer(2, 4);
  GridBody plate = annulus("lug", {0, 0, 0}, hole, width, 0, pi, nt, k * random.integer(2, 3));
  plate.keepGrid = true;
  plate.map = [=](double s, double t) {  // from the square of half side `width` to the hole
    const double angle = pi * s, x = std::cos(angle), y = std::sin(angle), square = width / std::max(std::abs(x), std::abs(y));
    const double r = square + (hole - square) * t;
    return Point{r * x, s == 0.0 || s == 1.0 ? 0.0 : r * y, 0};
  };
  plate.side = [nt](int i, int, Face face) -> std::string {
    if (face == Face::Bottom) return 4 * i < nt ? "right" : 4 * i >= 3 * nt ? "left" : "top";
    return face == Face::Top ? "inner" : face == Face::Left ? "first" : "last";
  };
  const auto onAxis = [](GridBody& body) {
    const auto map = body.map;
    body.map = [map](double s, double t) {
      Point p = map(s, t);
      if (s == 0.0 || s == 1.0) p[1] = 0.0;
      return p;
    };
  };
  GridBody pin = annulus("pin", {0, 0, 0}, random.real(0.2, 0.6), 1, 0, pi, random.chance(0.5) ? nt : nt + random.integer(1, 5),
                         k * random.integer(1, 3));
  pin.keepGrid = true;
  onAxis(pin);
  scene.body(plate);
  scene.body(pin);
  for (const char* body : {"lug", "pin"})
    for (const char* end : {"_first", "_last"}) scene.roller(std::string(body) + end);
  scene.fix("pin_inner");
  scene.contact("pin_outer", "lug_inner", true);
  const double kind = random.real(0, 1);
  if (kind < 0.6)
    scene.traction("lug_right", {1, random.chance(0.5) ? 0.0 : random.real(-0.2, 0.2), 0});
  else if (kind < 0.8)
    scene.bodyForce("lug", {random.sign(), 0, 0});
  else
    scene.traction("lug_left", {-1, 0, 0});
}

void pushedPin(Builder& scene) {
  Random& random = scene.random;
  const double c = clearance(random);
  const int nt = 2 * random.integer(5, 9);
  GridBody ring = annulus("ring", {0, 0, 0}, 1 + c, 1 + c + random.real(0.2, 0.8), 0, 2 * pi, nt, random.integer(1, 2));
  GridBody pin = annulus("pin", {0, 0, 0}, random.real(0.2, 0.7), 1, 0, 2 * pi, random.chance(0.5) ? nt : nt + 3, random.integer(1, 3));
  ring.periodic = pin.periodic = true;
  scene.body(ring);
  scene.body(pin);
  scene.fix("ring_outer");
  scene.contact("ring_inner", "pin_outer", true);
  const double angle = random.real(0, 2 * pi), by = std::max(c, 0.0) * random.real(0.0, 2.0) + random.power(-6, -2);
  scene.move("pin_inner", {by * std::cos(angle), by * std::sin(angle), 0});
}

void discOnSlopes(Builder& scene) {
  Random& random = scene.random;
  const int k = scene.refinement, nt = 8 * k * random.integer(2, 4);
  GridBody body = annulus("disc", {0, 0, 0}, random.real(0.2, 0.7), 1, 0, 2 * pi, nt, k * random.integer(2, 3));
  body.keepGrid = true;
  body.periodic = true;
  const double left = -pi / 2 - random.real(0.3, 1.0), right = -pi / 2 + random.real(0.3, 1.0);
  const auto isNear = [nt](int i, double angle) {
    double far = 2 * pi * (i + 0.5) / nt - angle;
    far -= 2 * pi * std::round(far / (2 * pi));
    return std::abs(far) < 0.6;
  };
  body.side = [=](int i, int, Face face) -> std::string {
    const double middle = 2 * pi * (i + 0.5) / nt;
    if (face == Face::Top) return "inner";
    if (face != Face::Bottom) return "";
    if (isNear(i, pi / 2)) return "top";
    const bool isRight = std::cos(middle) > 0;
    return isNear(i, isRight ? right : left) ? (isRight ? "right" : "left") : "";
  };
  scene.body(body);
  for (const double angle : {left, right}) {
    const double gap = random.chance(0.3) ? 0.0 : random.power(-6, 0.5);
    const Point out{std::cos(angle), std::sin(angle), 0};
    scene.line(angle == left ? "disc_left" : "disc_right", {(1 + gap) * out[0], (1 + gap) * out[1], 0}, {-out[0], -out[1], 0});
  }
  const bool away = random.chance(0.15);
  scene.bodyForce("disc", {random.real(-0.2, 0.2), away ? 5.0 : -1.0, 0});
  const double over = 1 + (random.chance(0.3) ? 0.0 : random.power(-6, 0.5)), height = random.real(0.3, 1);
  scene.box(
      "lid", -1, 1, [over](double) { return over; }, [over, height](double) { return over + height; }, random.integer(4, 9),
      random.integer(2, 3));
  scene.roller("lid_left");
  scene.contact("disc_top", "lid_bottom", true);
  scene.bodyForce("lid", {0, -random.power(-3, 0), 0});
  scene.expected = Expected::Unknown;
}

// Uniform pressure on the back of an arch is carried by equal normal forces in its joints at any angles; but without a centring three
// stones or more can slide on each other.
void arch(Builder& scene) {
  Random& random = scene.random;
  const int count = random.integer(2, 5);
  std::vector<double> angles{random.real(0.2, 0.6)};
  for (int k = 0; k < count; ++k) angles.push_back(angles.back() + random.real(0.35, 0.9) * 3.0 / count);
  const double inner = random.real(1, 3), outer = inner + random.real(0.2, 1);
  const bool matching = random.chance(0.5), centring = random.chance(0.7);
  const double clearance = random.chance(0.3) ? 0.0 : random.power(-6, -2);
  const int nr = random.integer(2, 5);
  for (int k = 0; k < count; ++k) {
    const std::string name = "stone" + std::to_string(k);
    scene.body(
        annulus(name, {0, 0, 0}, inner, outer, angles[k], angles[k + 1], random.integer(3, 6), matching ? nr : random.integer(2, 5)));
    scene.pressure(name + "_outer", 1.0);
    if (centring) scene.circle(name + "_inner", {0, 0, 0}, inner - clearance, false);
    if (k > 0) scene.contact("stone" + std::to_string(k - 1) + "_last", name + "_first", true);
  }
  const auto wall = [&](double angle, double sense, const std::string& side) {
    const double gap = random.chance(0.5) ? 0.0 : random.power(-6, -2);
    const Point along{-std::sin(angle), std::cos(angle), 0};
    scene.line(side, {inner * std::cos(angle) + sense * gap * along[0], inner * std::sin(angle) + sense * gap * along[1], 0},
               {-sense * along[0], -sense * along[1], 0});
  };
  wall(angles.front(), -1, "stone0_first");
  wall(angles.back(), 1, "stone" + std::to_string(count - 1) + "_last");
  scene.expected = Expected::Unknown;
}

}  // namespace suture::corpus
