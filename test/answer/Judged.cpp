#include <answer/Judged.hpp>

namespace suture::blocks {

Judged::Judged(const Scene& given) : scene(given), all(given, world(), std::vector<double>(), false) {
  Monitor silent;
  const MonolithicResult found = solveMonolithic(given.mesh, given.constraints, given.model, MonolithicOptions(), silent);
  if (!found.converged) throw NumericalError(found.failure);
  take(found);
}

void Judged::take(const MonolithicResult& found) {
  displacement.clear();
  for (const SubdomainMesh& mesh : all.meshes) {
    Vector& u = displacement.emplace_back(2 * mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node) u.segment<2>(2 * node) = found.displacement.segment<2>(2 * mesh.globalNodes[node]);
  }
  if (world()->getRank() == 0) pairs = found.pairs;
}

Verification Judged::verdict() const {
  return verify(*world(), {all.meshes, all.model, displacement, pairs, scene.constraints.pieces, tolerance, {}, past});
}

double Judged::deformation(int body) const {
  return deformations(*world(), all.meshes, displacement, int(all.model.bodies.size()))[body].largest;
}

void Judged::move(int body, const std::function<void(const Point& place, double* u)>& change) {
  for (std::size_t i = 0; i < all.meshes.size(); ++i)
    for (int node = 0; all.meshes[i].body == body && node < all.meshes[i].nodes(); ++node)
      change(all.meshes[i].point(node), &displacement[i][2 * node]);
}

void Judged::moveNear(int body, const Point& place, const std::function<void(double* u)>& change) {
  GlobalId nearest = -1;
  double least = 1e300;
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    const Point p = scene.mesh.point(node);
    const double distance = std::hypot(p[0] - place[0], p[1] - place[1]);
    if (scene.mesh.bodyOfNode[node] == body && distance < least) least = distance, nearest = node;
  }
  for (std::size_t i = 0; i < all.meshes.size(); ++i)
    for (int node = 0; node < all.meshes[i].nodes(); ++node)
      if (all.meshes[i].globalNodes[node] == nearest) change(&displacement[i][2 * node]);
}

int Judged::strongest() const {
  int best = -1;
  for (const PairResult& pair : pairs)
    if (best < 0 || pair.force > pairs[best].force) best = pair.id;
  return best;
}

int Judged::widest() const {
  int best = -1;
  for (const PairResult& pair : pairs)
    if (best < 0 || pair.gap > pairs[best].gap) best = pair.id;
  return best;
}

const Check& check(const Verification& verdict, const std::string& name) {
  for (const Check& check : verdict.checks)
    if (check.name == name) return check;
  throw InternalError("no check of the name " + name);
}

Scene looseBlock(double young, double load, int cells) {
  std::vector<Box> all = twoBoxes(2 * cells, cells, 2, 2);
  Scene scene = scenes::fromBoxes(all, young, 0.3);
  scene.model.materialOfBody[1].young = 0.4 * young;
  scene.pairUp();
  scene.fixLower();
  scene.hold("upper_right", 0, 0.0);
  scene.pressure("upper_top", 0.01 * load);
  scene.traction("upper_left", {0, -0.004 * load, 0});
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 2e-3 * load * pair.position[0] * pair.position[0];
  return scene;
}

Scene mortarBlock() {
  Scene scene = looseBlock();
  auto& pairs = scene.constraints.pairs;
  for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
    const int next = scene.constraints.pairs[i + 1].ends[1].node;
    pairs[i].ends[1].weight = -0.75;
    pairs[i].ends.push_back({next, -0.25});
  }
  return scene;
}

Scene blockOnObstacle(double young) {
  Box box;
  box.name = "block";
  box.x0 = -1;
  box.nx = 16;
  box.ny = 8;
  box.blocksX = box.blocksY = 2;
  Scene scene = scenes::fromBoxes({box}, young, 0.3);
  scene.hold("block_top", 0, 0.0);
  scene.hold("block_top", 1, -0.002);
  const std::vector<int> nodes = scene.nodesOf("block_bottom");
  ContactPiece piece{"ground", {}, {0}, {}, 0.0, {}};
  for (const int node : nodes) {
    ContactPair pair;
    pair.id = int(scene.constraints.pairs.size());
    pair.line = pair.piece = 0;
    pair.ends = {{node, 1.0}};
    pair.normal = {0, -1, 0};
    pair.position = scene.mesh.point(node);
    pair.gap = 2e-3 * pair.position[0] * pair.position[0];
    pair.length = 2.0 / 16;
    piece.pairs.push_back(pair.id);
    scene.constraints.pairs.push_back(pair);
  }
  scene.constraints.pieces = {piece};
  return scene;
}

Scene liftedBlock() {
  Scene scene = scenes::fromBoxes(twoBoxes(16, 8, 2, 2), 100.0, 0.3);
  scene.pairUp();
  scene.fixLower();
  scene.hold("upper_top", 0, 0.3);
  scene.hold("upper_top", 1, 0.1);
  return scene;
}

Scene strongAndWeak(double weak) {
  std::vector<Box> boxes = twoBoxes(16, 8, 2, 2);
  for (int k = 0; k < 2; ++k) {
    Box box = boxes[k];
    box.name += "2";
    box.x0 += 10;
    box.x1 += 10;
    boxes.push_back(box);
  }
  Scene scene = scenes::fromBoxes(boxes, 100.0, 0.3);
  std::vector<ContactPair> pairs;
  std::vector<ContactPiece> pieces;
  for (int k = 0; k < 2; ++k) {
    const std::string tail = k == 0 ? "" : "2";
    scene.sideA = "lower" + tail + "_top";
    scene.sideB = "upper" + tail + "_bottom";
    scene.pairUp();
    pieces.push_back({"line" + tail, {}, {2 * k, 2 * k + 1}, {}, 0.0, {}});
    for (ContactPair pair : scene.constraints.pairs) {
      pair.id = int(pairs.size());
      pair.line = pair.piece = k;
      pieces.back().pairs.push_back(pair.id);
      pairs.push_back(pair);
    }
    scene.hold("lower" + tail + "_bottom", 0, 0.0);
    scene.hold("lower" + tail + "_bottom", 1, 0.0);
    scene.hold("upper" + tail + "_right", 0, 0.0);
    scene.pressure("upper" + tail + "_top", k == 0 ? 0.01 : 0.01 * weak);
    scene.traction("upper" + tail + "_left", {0, k == 0 ? -0.004 : -0.004 * weak, 0});
  }
  for (int k = 2; k < 4; ++k) scene.model.materialOfBody[k].young *= weak;
  scene.constraints.pairs = pairs;
  scene.constraints.pieces = pieces;
  return scene;
}

}  // namespace suture::blocks
