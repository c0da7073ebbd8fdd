#include <support/SmallScenes.hpp>

namespace suture::scenes {

std::vector<int> Scene::nodesOf(const std::string& group) const {
  std::vector<int> nodes;
  for (const Side& side : mesh.sideGroups.at(group))
    for (const int node : mesh.nodesOf(side)) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

NodeRule& Scene::ruleOf(int node) {
  auto& rules = constraints.rules;
  auto at = std::lower_bound(rules.begin(), rules.end(), node, [](const NodeRule& r, int n) { return r.node < n; });
  if (at == rules.end() || at->node != node) {
    at = rules.insert(at, NodeRule{});
    at->node = node;
  }
  return *at;
}

void Scene::holdNode(int node, int component, double value) {
  ruleOf(node).fixed[component] = true;
  ruleOf(node).value[component] = value;
}

void Scene::hold(const std::string& group, int component, double value) {
  for (const int node : nodesOf(group)) holdNode(node, component, value);
}

void Scene::fixLower() {
  hold("lower_bottom", 0, 0.0);
  hold("lower_bottom", 1, 0.0);
}

void Scene::region(const std::string& group, double young) {
  if (mesh.regions.empty()) mesh.regions.assign(mesh.elements(), -1);
  for (const int e : mesh.elementGroups.at(group)) mesh.regions[e] = int(model.materialOfRegion.size());
  Material own = model.materialOfBody.front();
  own.name = group;
  own.young = young;
  model.materialOfRegion.push_back(own);
}

void Scene::pairUp(Point normal) {
  constraints.pairs.clear();
  constraints.pieces.clear();
  const auto along = [&](int node) { return mesh.point(node)[0] * normal[1] - mesh.point(node)[1] * normal[0]; };
  std::vector<int> a = nodesOf(sideA), b = nodesOf(sideB);
  const auto less = [&](int i, int j) { return along(i) < along(j); };
  std::sort(a.begin(), a.end(), less);
  std::sort(b.begin(), b.end(), less);
  const double size = std::abs(along(a.back()) - along(a.front()));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const int other : b) {
      if (std::abs(along(other) - along(a[i])) > 1e-9 * size) continue;
      ContactPair pair;
      pair.id = int(constraints.pairs.size());
      pair.line = pair.piece = 0;
      pair.ends = matchingEnds(a[i], other);
      pair.normal = normal;
      pair.gap = gap;
      pair.length = ((i + 1 < a.size() ? along(a[i + 1]) : along(a[i])) - (i > 0 ? along(a[i - 1]) : along(a[i]))) / 2;
      pair.arc = along(a[i]) - along(a.front());
      pair.position = mesh.point(a[i]);
      constraints.pairs.push_back(pair);
    }
  ContactPiece piece;
  piece.name = "contact";
  for (const ContactPair& pair : constraints.pairs) {
    if (!piece.pairs.empty()) piece.cells.push_back({piece.pairs.back(), pair.id});
    piece.pairs.push_back(pair.id);
  }
  piece.bodies = {0, 1};
  constraints.pieces = {piece};
}

Scene fromBoxes(const std::vector<Box>& all, double young, double poisson) {
  Scene scene;
  scene.mesh = boxes(all);
  std::vector<std::string> names;
  for (const Box& box : all) names.push_back(box.name);
  assignBodies(scene.mesh, names);
  scene.model.bodies = names;
  for (const std::string& name : names) scene.model.materialOfBody.push_back({name, young, poisson});
  return scene;
}

Scene twoBlocks(int nx, int nyLower, int nyUpper, double young, double poisson) {
  Box lower, upper;
  lower.name = "lower";
  upper.name = "upper";
  lower.x0 = upper.x0 = -1;
  lower.y0 = -1;
  lower.y1 = 0;
  lower.nx = upper.nx = nx;
  lower.ny = nyLower;
  upper.ny = nyUpper;
  Scene scene = fromBoxes({lower, upper}, young, poisson);
  scene.pairUp();
  return scene;
}

Scene overhang() {
  Box lower, upper;
  lower.name = "lower";
  upper.name = "upper";
  lower.x0 = upper.x0 = -1;
  lower.x1 = 0;
  lower.y0 = -1;
  lower.y1 = 0;
  lower.nx = 2;
  upper.nx = 4;
  lower.ny = upper.ny = 2;
  Scene scene = fromBoxes({lower, upper});
  scene.pairUp();
  scene.fixLower();
  return scene;
}

}  // namespace suture::scenes
