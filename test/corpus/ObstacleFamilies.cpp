#include <corpus/Families.hpp>

namespace suture::corpus {

namespace {

double obstacleGap(Random& random) {
  const double kind = random.real(0, 1);
  return kind < 0.3 ? 0.0 : kind < 0.6 ? random.power(-6, -2) : random.real(0.0, 3.0);
}

/// Two or three stacked boxes over y = low, each with a crown below; returns the name of the lowest. Held sideways by rollers or walls.
std::string pile(Builder& scene, double low) {
  Random& random = scene.random;
  const int count = random.integer(2, 3);
  double y = low;
  for (int k = 0; k < count; ++k) {
    const std::string name = "box" + std::to_string(k);
    const double crown = random.chance(0.4) ? 0.0 : random.power(-4, -1), height = random.real(0.4, 1), centre = random.real(-0.3, 0.3);
    const double base = y, top = y + 4 * crown + height;
    scene.box(
        name, -1, 1, [=](double x) { return base + crown * (x - centre) * (x - centre); }, [=](double) { return top; },
        random.integer(4, 9), random.integer(2, 4));
    if (random.chance(0.8)) {
      scene.roller(name + "_left");
    } else {
      scene.line(name + "_left", {-1 - random.power(-4, 0), 0, 0}, {1, 0, 0});
      scene.line(name + "_right", {1 + random.power(-4, 0), 0, 0}, {-1, 0, 0});
    }
    scene.bodyForce(name, {random.real(0.02, 0.2), -random.real(0.2, 1), 0});
    if (k > 0) scene.contact("box" + std::to_string(k - 1) + "_top", name + "_bottom", true);
    y = top + obstacleGap(random) / 3;
  }
  if (random.chance(0.3)) scene.pressure("box" + std::to_string(count - 1) + "_top", random.power(-2, 1));
  if (random.chance(0.12)) {
    scene.traction("box0_bottom", {0, 20, 0});
    scene.expected = Expected::Unsolvable;
  }
  return "box0";
}

}  // namespace

void onHalfPlane(Builder& scene) {
  Random& random = scene.random;
  const double slope = random.chance(0.5) ? 0.0 : random.real(-0.3, 0.3), g = obstacleGap(random);
  const std::string body = pile(scene, g + std::abs(slope) * 1.2);
  scene.line(body + "_bottom", {0, 0, 0}, {-std::sin(slope), std::cos(slope), 0});
  if (slope != 0.0 && scene.expected == Expected::Solvable) scene.expected = Expected::Unknown;
}

void onDisc(Builder& scene) {
  Random& random = scene.random;
  const double radius = random.real(1.5, 6), g = obstacleGap(random);
  const std::string body = pile(scene, g);
  scene.circle(body + "_bottom", {random.real(-0.5, 0.5), -radius, 0}, radius, false);
  if (scene.expected == Expected::Solvable) scene.expected = Expected::Unknown;
}

void onGraph(Builder& scene) {
  Random& random = scene.random;
  const double amplitude = random.power(-4, -1), wave = random.real(0.5, 5), g = obstacleGap(random);
  const std::string body = pile(scene, amplitude + g);
  scene.height(body + "_bottom", 0, amplitude, wave, random.real(0, 2 * pi));
  if (scene.expected == Expected::Solvable) scene.expected = Expected::Unknown;
}

}  // namespace suture::corpus
