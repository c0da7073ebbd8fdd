#include <corpus/GridBody.hpp>

#include <map>

namespace suture::corpus {

namespace {

using Step = std::pair<int, int>;  // in half cells

class Mesher {
 public:
  Mesher(const GridBody& body, Mesh& mesh) : body_(body), mesh_(mesh) {}

  void run() {
    const bool triangles = cellInfo(body_.cell).vertices == 3;
    for (int j = 0; j < body_.ny; ++j)
      for (int i = 0; i < body_.nx; ++i) {
        if (!present(i, j)) continue;
        const Step a{2 * i, 2 * j}, b{2 * i + 2, 2 * j}, c{2 * i + 2, 2 * j + 2}, d{2 * i, 2 * j + 2};
        if (!triangles) {
          element({a, b, c, d}, i, j);
        } else if ((i + j) % 2 == 0) {
          element({a, b, c}, i, j);
          element({a, c, d}, i, j);
        } else {
          element({a, b, d}, i, j);
          element({b, c, d}, i, j);
        }
      }
  }

 private:
  bool present(int i, int j) const {
    if (body_.periodic) i = (i + body_.nx) % body_.nx;
    if (i < 0 || j < 0 || i >= body_.nx || j >= body_.ny) return false;
    return !body_.present || body_.present(i, j);
  }

  int node(Step at) {
    if (body_.periodic) at.first %= 2 * body_.nx;
    const auto [found, isNew] = numbers_.emplace(at, mesh_.nodes());
    if (isNew) {
      const Point p = body_.map(at.first / (2.0 * body_.nx), at.second / (2.0 * body_.ny));
      mesh_.coordinates.insert(mesh_.coordinates.end(), {p[0], p[1]});
    }
    return found->second;
  }

  static Step between(Step a, Step b) { return {(a.first + b.first) / 2, (a.second + b.second) / 2}; }

  void element(const std::vector<Step>& corners, int i, int j) {
    const int number = mesh_.elements(), n = static_cast<int>(corners.size());
    for (const Step& corner : corners) mesh_.connectivity.push_back(node(corner));
    if (cellInfo(body_.cell).nodes > cellInfo(body_.cell).vertices)
      for (int k = 0; k < n; ++k) mesh_.connectivity.push_back(node(between(corners[k], corners[(k + 1) % n])));
    if (body_.cell == Cell::Quadrilateral9) mesh_.connectivity.push_back(node({2 * i + 1, 2 * j + 1}));
    mesh_.cells.push_back(body_.cell);
    mesh_.offsets.push_back(static_cast<int>(mesh_.connectivity.size()));
    mesh_.elementGroups[body_.name].push_back(number);
    mesh_
        .elementGroups["subdomain_" + body_.name + "_" + std::to_string(i * body_.cutsX / body_.nx) + "_" +
                       std::to_string(j * body_.cutsY / body_.ny)]
        .push_back(number);
    for (int k = 0; k < n; ++k) boundary(corners[k], corners[(k + 1) % n], i, j, {number, k});
  }

  void boundary(const Step& from, const Step& to, int i, int j, const Side& side) {
    const auto face = [&](Face which, int di, int dj) {
      if (present(i + di, j + dj)) return;
      const std::string suffix = body_.side(i, j, which);
      if (!suffix.empty()) mesh_.sideGroups[body_.name + "_" + suffix].push_back(side);
    };
    if (from.second == 2 * j && to.second == 2 * j) face(Face::Bottom, 0, -1);
    if (from.first == 2 * i + 2 && to.first == 2 * i + 2) face(Face::Right, 1, 0);
    if (from.second == 2 * j + 2 && to.second == 2 * j + 2) face(Face::Top, 0, 1);
    if (from.first == 2 * i && to.first == 2 * i) face(Face::Left, -1, 0);
  }

  const GridBody& body_;
  Mesh& mesh_;
  std::map<Step, int> numbers_;
};

}  // namespace

void add(const GridBody& body, Mesh& mesh) { Mesher(body, mesh).run(); }

void renumber(Mesh& mesh, const std::vector<int>& nodes, const std::vector<int>& elements) {
  const Mesh old = mesh;
  for (int n = 0; n < old.nodes(); ++n)
    for (int k = 0; k < 2; ++k) mesh.coordinates[2 * nodes[n] + k] = old.coordinates[2 * n + k];
  std::vector<int> oldOf(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) oldOf[elements[e]] = static_cast<int>(e);
  mesh.connectivity.clear();
  mesh.offsets = {0};
  for (int e = 0; e < old.elements(); ++e) {
    mesh.cells[e] = old.cells[oldOf[e]];
    for (const int node : old.nodesOf(oldOf[e])) mesh.connectivity.push_back(nodes[node]);
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  }
  for (auto& group : mesh.elementGroups)
    for (int& element : group.second) element = elements[element];
  for (auto& group : mesh.sideGroups)
    for (Side& side : group.second) side.element = elements[side.element];
}

std::string boxSide(int, int, Face face) {
  switch (face) {
    case Face::Bottom:
      return "bottom";
    case Face::Right:
      return "right";
    case Face::Top:
      return "top";
    default:
      return "left";
  }
}

}  // namespace suture::corpus
