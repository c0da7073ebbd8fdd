#include <corpus/Families.hpp>

namespace suture::corpus {

namespace {

using Line = std::function<double(double)>;

Line level(double y) {
  return [y](double) { return y; };
}

/// level + a small wave, or a crown.
Line wavy(Random& random, double y, double most) {
  const double amplitude = random.chance(0.3) ? 0.0 : most * random.power(-3, 0) * random.sign();
  const double wave = random.real(0.5, 6.0), phase = random.real(0, 2 * pi);
  const bool crown = random.chance(0.4);
  const double centre = random.real(0.2, 0.8);
  return [=](double x) { return y + amplitude * (crown ? (x - centre) * (x - centre) : std::cos(wave * x + phase)); };
}

/// 0, tiny, moderate, or up to ten bodies.
double gap(Random& random) {
  const double kind = random.real(0, 1);
  if (kind < 0.25) return 0.0;
  if (kind < 0.55) return random.power(-6, -2);
  if (kind < 0.8) return random.real(0.0, 0.2);
  return random.real(0.0, 10.0);
}

/// Keeps a box from moving sideways: by a roller at its left, or by walls next to it with a push against one of them. Returns the push.
double holdSideways(Builder& scene, const std::string& body, double x0, double x1, double y) {
  Random& random = scene.random;
  if (random.chance(0.55)) {
    scene.roller(body + "_" + (random.chance(0.5) ? "left" : "right"));
    return random.chance(0.5) ? random.real(-0.3, 0.3) : 0.0;
  }
  const double clearance = random.chance(0.3) ? 0.0 : random.power(-5, 0);
  scene.line(body + "_left", {x0 - clearance * random.real(0.1, 1), y, 0}, {1, 0, 0});
  scene.line(body + "_right", {x1 + clearance * random.real(0.1, 1), y, 0}, {-1, 0, 0});
  return random.sign() * random.real(0.05, 0.4);
}

/// Presses a box down: by a pressure on its top or its weight, with a push sideways; `up` pushes it away instead.
void press(Builder& scene, const std::string& body, double push, bool up = false) {
  Random& random = scene.random;
  const double down = (up ? 1.0 : -1.0) * random.real(0.3, 1.5);
  if (random.chance(0.6))
    scene.traction(body + "_top", {push, down, 0});
  else
    scene.bodyForce(body, {push, down, 0});
}

}  // namespace

void blocks(Builder& scene) {
  Random& random = scene.random;
  const double width = random.real(0.6, 3), g = gap(random), upperHeight = random.real(0.3, 1.5);
  const double x0 = random.chance(0.5) ? 0.0 : random.real(0.0, 0.3), x1 = random.chance(0.5) ? width : random.real(0.6, 1.0) * width;
  const int nx = random.integer(3, 9);
  const bool matching = random.chance(0.4);
  scene.box("lower", 0, width, level(-1), wavy(random, 0, 0.03), nx, random.integer(2, 5));
  scene.box("upper", matching ? 0 : std::min(x0, x1 - 0.3), matching ? width : x1, wavy(random, 0.061 + g, 0.03),
            level(0.061 + g + upperHeight), matching ? nx : random.integer(3, 9), random.integer(2, 5));
  scene.fix("lower_bottom");
  scene.contact("lower_top", "upper_bottom");
  if (random.chance(0.25)) {
    const bool all = random.chance(0.5);
    const double down = 0.061 + g + random.power(-5, -2);
    scene.mayTurn = scene.mayTurn && all;
    scene.condition("upper_top", "Displacement", {0, -down}, "All");
    return;
  }
  const bool away = random.chance(0.15), slides = !away && random.chance(0.05);
  const double push =
      slides ? random.real(0.1, 1) : holdSideways(scene, "upper", matching ? 0 : std::min(x0, x1 - 0.3), matching ? width : x1, 0.5 + g);
  press(scene, "upper", push, away);
  if (away) scene.expected = Expected::Unsolvable;
  if (slides) scene.expected = Expected::Unknown;
}

void stack(Builder& scene) {
  Random& random = scene.random;
  const int count = random.integer(2, 6), nx = random.integer(3, 7);
  const bool matching = random.chance(0.5), away = random.chance(0.15);
  double y = 0;
  std::string below;
  for (int k = 0; k < count; ++k) {
    const std::string name = "block" + std::to_string(k);
    const double height = random.real(0.3, 1.0);
    scene.box(name, 0, 1, k == 0 ? level(y) : wavy(random, y, 0.02), k + 1 == count ? level(y + height) : wavy(random, y + height, 0.02),
              matching ? nx : random.integer(3, 7), random.integer(1, 3));
    if (k == 0) {
      scene.fix("block0_bottom");
    } else {
      scene.contact(below + "_top", name + "_bottom");
      const double push = holdSideways(scene, name, 0, 1, y + 0.5 * height);
      scene.bodyForce(name, {push, -random.real(0.2, 1) * (random.chance(0.5) ? 1.0 : 1e-3), 0});
    }
    below = name;
    y += height + 0.041 + gap(random) / count;
  }
  if (away) {
    scene.traction(below + "_top", {0, 5, 0});
    scene.expected = Expected::Unsolvable;
  } else if (random.chance(0.5)) {
    scene.pressure(below + "_top", random.real(0.1, 2));
  }
}

void tray(Builder& scene) {
  Random& random = scene.random;
  const double half = random.real(0.3, 1.2), tall = random.real(0.4, 1.5);
  const double kind = random.real(0, 1);
  const double side = kind < 0.2 ? 0.0 : kind < 0.85 ? random.power(-5, -0.5) : -random.power(-6, -3);
  const double below = random.chance(0.2) ? 0.0 : random.power(-5, 0.5), wall = random.real(0.2, 0.5);
  const int k = scene.refinement, inner = k * random.integer(3, 6), walls = k * random.integer(1, 2), floor = k * random.integer(1, 2),
            high = k * random.integer(3, 6);
  GridBody u;
  u.name = "tray";
  u.keepGrid = true;
  u.nx = inner + 2 * walls;
  u.ny = floor + high;
  const auto place = [](double at, int n, int first, double a, double b, double outer0, double outer1, int last) {
    const double i = at * n;  // cells
    if (i < first) return outer0 + (a - outer0) * i / first;
    if (i > last) return b + (outer1 - b) * (i - last) / (n - last);
    return a + (b - a) * (i - first) / (last - first);
  };
  const double a = -half - side, b = half + side, top = tall + random.real(-0.3, 0.3);
  const int n = u.nx, m = u.ny;
  u.map = [=](double s, double t) {
    const double x = place(s, n, walls, a, b, a - wall, b + wall, walls + inner);
    const double j = t * m;
    return Point{x, j < floor ? -below - wall + wall * j / floor : -below + (top + below) * (j - floor) / high, 0};
  };
  u.present = [=](int i, int j) { return i < walls || i >= walls + inner || j < floor; };
  u.side = [=](int i, int j, Face face) -> std::string {
    const bool inside = (face == Face::Top && j < floor) || (face == Face::Right && i == walls - 1 && j >= floor) ||
                        (face == Face::Left && i == walls + inner && j >= floor);
    if (inside) return face == Face::Top ? "floor" : face == Face::Right ? "innerleft" : "innerright";
    return face == Face::Bottom ? "bottom" : "";
  };
  scene.body(u);
  const bool matching = random.chance(0.3);
  scene.box("peg", -half, half, level(0), level(tall), matching ? inner / k : random.integer(3, 7), random.integer(3, 6));
  scene.fix("tray_bottom");
  scene.contact("tray_floor", "peg_bottom", true);
  scene.contact("tray_innerleft", "peg_left", true);
  scene.contact("tray_innerright", "peg_right", true);
  const double push = random.chance(0.1) ? 0.0 : random.sign() * random.power(-3, 0);
  const bool away = random.chance(0.15);
  if (away) scene.expected = Expected::Unsolvable;
  press(scene, "peg", push, away);
  if (side < 0 && away) scene.expected = Expected::Unsolvable;
}

void tilted(Builder& scene) {
  Random& random = scene.random;
  const double angle = random.sign() * random.real(0.03, 0.6), size = random.real(0.5, 1.5),
               g = std::min(gap(random), 0.5 / std::abs(std::sin(angle)));  // the sides face each other along the block's normals
  const double c = std::cos(angle), s = std::sin(angle);
  scene.box("ground", -2, 2, level(-1), level(0), random.integer(6, 14), random.integer(2, 4));
  GridBody block;
  block.name = "block";
  block.nx = random.integer(3, 7);
  block.ny = random.integer(3, 6);
  block.side = boxSide;
  const double lift = g + 0.5 * size * std::abs(s);
  block.map = [=](double u, double v) {
    const double x = size * (u - 0.5), y = size * v;
    return Point{c * x - s * y, lift + s * x + c * y, 0};
  };
  scene.body(block);
  scene.fix("ground_bottom");
  scene.contact("ground_top", "block_bottom", true);
  // Walls that touch the highest or lowest nodes of the legs; the weight pushes against one of them.
  const bool right = random.chance(0.5);
  scene.line("block_right", {2, 0, 0}, {-1, 0, 0});
  scene.line("block_left", {-2, 0, 0}, {1, 0, 0});
  scene.bodyForce("block", {(right ? 1 : -1) * random.real(0.01, 0.3), -1, 0});
  scene.expected = Expected::Unknown;
}

void layers(Builder& scene) {
  Random& random = scene.random;
  const int count = random.integer(2, 4), nx = random.integer(8, 16);
  const double length = random.real(3, 8);
  const bool matching = random.chance(0.5);
  double y = 0;
  std::string below;
  for (int k = 0; k < count; ++k) {
    const std::string name = "layer" + std::to_string(k);
    const double height = random.real(0.2, 0.6);
    const double g = k == 0 || random.chance(0.5) ? 0.0 : random.power(-6, -2);
    scene.box(name, 0, length, level(y + g), level(y + g + height), matching ? nx : random.integer(8, 16), random.integer(1, 2));
    if (k == 0) {
      scene.fix("layer0_bottom");
    } else {
      scene.contact(below + "_top", name + "_bottom");
      scene.roller(name + "_left");
      if (k + 1 < count && random.chance(0.3)) scene.roller(name + "_right");
      scene.bodyForce(name, {0, -random.power(-2, 0), 0});
    }
    below = name;
    y += g + height;
  }
  const double kind = random.real(0, 1);
  if (kind < 0.4) {
    scene.move(below + "_right", {random.power(-5, -2) * random.sign(), random.power(-5, -1.5) * random.sign(), 0});
  } else if (kind < 0.8) {
    scene.traction(below + "_right", {random.real(-1, 1), random.power(-3, -1.3), 0});
    scene.expected = Expected::Unknown;
  } else {
    scene.traction(below + "_top", {0, -random.real(0.1, 1), 0});
  }
}

void bumps(Builder& scene) {
  Random& random = scene.random;
  const double width = random.real(0.15, 0.35), height = width * random.real(0.05, 0.3), g = gap(random);
  const double one = random.real(0.2, 0.6), two = random.real(1.2, 1.8), lower = random.chance(0.5) ? 0.0 : random.power(-5, -2);
  const int nx = random.integer(12, 22);
  const Line ground = [=](double x) {
    const auto bump = [&](double centre, double high) { return high * std::exp(-(x - centre) * (x - centre) / (width * width)); };
    return bump(one, height) + bump(two, height - lower);
  };
  const bool matching = random.chance(0.4);
  scene.box("ground", 0, 2, level(-0.6), ground, nx, 3);
  scene.box("beam", 0, 2, level(height + g), level(height + g + random.real(0.3, 1)), matching ? nx : random.integer(6, 16),
            random.integer(2, 3));
  scene.fix("ground_bottom");
  scene.contact("ground_top", "beam_bottom", random.chance(0.7));
  const bool away = random.chance(0.12), over = random.chance(0.05);
  const double push = holdSideways(scene, "beam", 0, 2, height + g + 0.2);
  press(scene, "beam", over ? 20.0 : push, away);
  if (away) scene.expected = Expected::Unsolvable;
  if (over) scene.expected = Expected::Unknown;
}

}  // namespace suture::corpus
