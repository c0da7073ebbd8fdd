#include <interface/ContactScenes.hpp>

namespace suture::blocks {

std::function<std::unique_ptr<SchurComplement>()> schurOf(const std::string& name) {
  return [name] { return schurComplement(name); };
}

std::vector<Vector> zeros(const Blocks& all) {
  std::vector<Vector> values;
  for (const auto& subdomain : all.subdomains) values.emplace_back(Vector::Zero(subdomain->dofs()));
  return values;
}

Teuchos::RCP<InterfaceOperator> OnInterface::matrix(const Scene& scene, int openEvery) const {
  std::map<int, ContactState> status;
  for (const ContactPair& pair : scene.constraints.pairs)
    if (openEvery > 0 && pair.id % openEvery == 1) status[pair.id] = PairStatus::Open;
  return problem.linearise(problem.stateOf(zeros(all), status)).matrix;
}

Scene swapped(Scene scene) {
  for (ContactPair& pair : scene.constraints.pairs) {
    pair.ends = matchingEnds(pair.ends[1].node, pair.ends[0].node);
    for (double& n : pair.normal) n = -n;
  }
  return scene;
}

void turn(Point& p, double angle) {
  p = {std::cos(angle) * p[0] - std::sin(angle) * p[1], std::sin(angle) * p[0] + std::cos(angle) * p[1], p[2]};
}

Scene turned(Scene scene, double angle) {
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    Point p = scene.mesh.point(node);
    turn(p, angle);
    for (int k = 0; k < 2; ++k) scene.mesh.coordinates[2 * node + k] = p[k];
  }
  for (ContactPair& pair : scene.constraints.pairs) {
    turn(pair.normal, angle);
    turn(pair.position, angle);
  }
  for (NodeRule& rule : scene.constraints.rules)
    for (int k = 0; k < 2; ++k) turn(rule.axes[k], angle);
  for (Load& load : scene.model.loads)
    if (load.kind != Load::Kind::Pressure) turn(load.value, angle);
  return scene;
}

Scene heldOnTheLine() {
  Scene scene = pressedBlocks();
  const std::vector<ContactPair> pairs = scene.constraints.pairs;
  scene.holdNode(pairs.front().ends[1].node, 0, 0.002);
  scene.holdNode(pairs[2].ends[0].node, 1, -0.004);
  scene.holdNode(pairs[4].ends[0].node, 1, 0.0);
  scene.holdNode(pairs[4].ends[1].node, 1, 0.0);
  scene.constraints.pairs[4].gap = 0.01;
  return scene;
}

Scene crossingBlocks() {
  std::vector<Box> all(3);
  const char* names[3] = {"lower", "left", "right"};
  for (int k = 0; k < 3; ++k) {
    all[k].name = names[k];
    all[k].nx = all[k].ny = 4;
    all[k].blocksX = all[k].blocksY = 2;
  }
  all[0].x0 = -1;
  all[0].nx = 8;
  all[0].y0 = -1;
  all[0].y1 = 0;
  all[1].x0 = -1;
  all[1].x1 = 0;
  Scene scene = scenes::fromBoxes(all, 100.0, 0.3);
  scene.model.materialOfBody[2].young = 20.0;
  std::vector<ContactPair> pairs;
  const std::array<const char*, 2> sides[3] = {{"lower_top", "left_bottom"}, {"lower_top", "right_bottom"}, {"left_right", "right_left"}};
  const std::array<int, 2> bodies[3] = {{0, 1}, {0, 2}, {1, 2}};
  std::vector<ContactPiece> pieces;
  for (int line = 0; line < 3; ++line) {
    scene.sideA = sides[line][0];
    scene.sideB = sides[line][1];
    scene.pairUp(line == 2 ? Point{1, 0, 0} : Point{0, 1, 0});
    // pieces that meet are one piece; of two rows of the lower block's node at (0, 0) each has a different partner
    pieces.push_back({names[line], {}, {bodies[line][0], bodies[line][1]}, {}, 0.0, {}});
    for (ContactPair pair : scene.constraints.pairs) {
      pair.id = int(pairs.size());
      pair.line = pair.piece = line;
      pieces.back().pairs.push_back(pair.id);
      pairs.push_back(pair);
    }
  }
  scene.constraints.pairs = pairs;
  scene.constraints.pieces = pieces;
  scene.fixLower();
  scene.hold("left_left", 0, 0.003);
  scene.hold("left_top", 1, -0.01);
  scene.hold("right_right", 0, -0.004);
  scene.hold("right_top", 1, 0.002);
  return scene;
}

}  // namespace suture::blocks
