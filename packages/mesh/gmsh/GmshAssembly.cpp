#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/mesh/gmsh/GmshAssembly.hpp>
#include <suture/mesh/gmsh/GmshTypes.hpp>

#include <algorithm>
#include <climits>
#include <cmath>

namespace suture {

namespace {

// The same cell seen from behind: the first node stays.
void turnRound(Cell cell, int* nodes) {
  static const int order[][9] = {{0, 2, 1}, {0, 2, 1, 5, 4, 3}, {0, 3, 2, 1}, {0, 3, 2, 1, 7, 6, 5, 4}, {0, 3, 2, 1, 7, 6, 5, 4, 8}};
  int old[9];
  const int count = cellInfo(cell).nodes;
  std::copy_n(nodes, count, old);
  for (int i = 0; i < count; ++i) nodes[i] = old[order[static_cast<int>(cell)][i]];
}

template <typename Less, typename T>
void makeSet(std::vector<T>& values, const Less& less) {
  if (!std::is_sorted(values.begin(), values.end(), less)) std::sort(values.begin(), values.end(), less);
  const auto same = [&](const T& a, const T& b) { return !less(a, b) && !less(b, a); };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
}

class Assembly {
 public:
  Assembly(GmshMesh gmsh, const std::string& file) : gmsh_(std::move(gmsh)) {
    mesh_.source = file;
    mesh_.dimension = 2;
    for (const std::string& problem : gmsh_.problems) report(problem);
    reportForeign();
    if (gmsh_.surfaces.empty() && gmsh_.foreign.empty()) report("holds no surface elements; is there a Surface, and is it meshed?");
  }

  Mesh mesh() {
    problems_.throwIfAny();
    orient();
    numberNodes();
    addElements();
    addElementGroups();
    addSideGroups();
    problems_.throwIfAny();
    return std::move(mesh_);
  }

 private:
  void report(const std::string& problem) { problems_.add(kMeshFile, mesh_.source + ": " + problem); }
  void reportForeign() {
    for (const GmshMesh::Foreign& elements : gmsh_.foreign) {
      std::string names;
      for (const auto& [name, parts] : gmsh_.groups[elements.dimension])
        if (std::find(parts.begin(), parts.end(), elements.part) != parts.end()) names += (names.empty() ? "'" : ", '") + name + "'";
      const GmshType* type = gmshType(elements.type);
      report(std::to_string(elements.count) + " elements of the kind '" +
             (type ? type->name : "Gmsh type " + std::to_string(elements.type)) + "' (" +
             (names.empty() ? "in no group" : "in the group " + names) + "); known are " + knownGmshTypes() +
             ": mesh in two dimensions (gmsh -2) with elements of order 1 or 2 (-order 2)");
    }
  }
  const double* place(int node) const { return &gmsh_.coordinates[3 * static_cast<std::size_t>(node)]; }

  bool isClockwise(const GmshMesh::Surface& surface) const {
    const CellInfo& cell = cellInfo(surface.cell);
    for (std::size_t first = 0; first < surface.nodes.size(); first += static_cast<std::size_t>(cell.nodes)) {
      const int* nodes = &surface.nodes[first];
      const double* o = place(nodes[0]);
      double twice = 0;
      for (int i = 1; i + 1 < cell.vertices; ++i) {
        const double *a = place(nodes[i]), *b = place(nodes[i + 1]);
        twice += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
      }
      if (!(twice < 0)) return false;
    }
    return true;
  }
  // A surface meshed clockwise as a whole (its normal points down) is sound; single clockwise elements are not, and stay as they are.
  void orient() {
    std::vector<GmshMesh::Surface>& all = gmsh_.surfaces;
    for (auto first = all.begin(); first != all.end();) {
      const auto end = std::find_if(first, all.end(), [&](const GmshMesh::Surface& s) { return s.tag != first->tag; });
      if (std::all_of(first, end, [&](const GmshMesh::Surface& s) { return isClockwise(s); }))
        for (auto surface = first; surface != end; ++surface) {
          const auto each = static_cast<std::size_t>(cellInfo(surface->cell).nodes);
          for (std::size_t i = 0; i < surface->nodes.size(); i += each) turnRound(surface->cell, &surface->nodes[i]);
        }
      first = end;
    }
  }

  void numberNodes() {
    number_.assign(gmsh_.tags.size(), -1);
    for (const GmshMesh::Surface& surface : gmsh_.surfaces) {
      entries_ += surface.nodes.size();
      for (const int node : surface.nodes) number_[node] = 0;
    }
    if (entries_ > INT_MAX) throw InputError(kMeshFile, mesh_.source + ": more than " + std::to_string(INT_MAX) + " nodes of elements");
    double size = 0, away = 0;
    int count = 0;
    mesh_.coordinates.reserve(2 * number_.size());
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] < 0) continue;
      number_[node] = count++;
      const double* p = place(static_cast<int>(node));
      mesh_.coordinates.insert(mesh_.coordinates.end(), {p[0], p[1]});
      size = std::max({size, std::abs(p[0]), std::abs(p[1])});
      away = std::max(away, std::abs(p[2]));
    }
    if (away > 1e-9 * size) report("nodes up to " + std::to_string(away) + " away from the plane z = 0; expected a plane mesh");
  }

  // The same nodes are the same element. Elements with the same least node are a chain, nearly always a short one.
  void addElements() {
    const int nodes = mesh_.nodes();
    std::size_t most = 0;
    for (const GmshMesh::Surface& s : gmsh_.surfaces) most += s.nodes.size() / static_cast<std::size_t>(cellInfo(s.cell).nodes);
    mesh_.cells.reserve(most);
    mesh_.offsets.reserve(most + 1);
    mesh_.connectivity.reserve(entries_);
    std::vector<int> head(static_cast<std::size_t>(nodes), -1), next;
    std::vector<long long> sums;  // sum of each side's nodes: most others in a chain have another one
    next.reserve(most);
    sums.reserve(most);
    for (const GmshMesh::Surface& surface : gmsh_.surfaces) {
      const int each = cellInfo(surface.cell).nodes;
      std::vector<int>& elements = elementsOf_.emplace_back();
      elements.reserve(surface.nodes.size() / static_cast<std::size_t>(each));
      for (std::size_t first = 0; first < surface.nodes.size(); first += static_cast<std::size_t>(each)) {
        int mine[9], least = nodes;
        long long sum = 0;
        for (int i = 0; i < each; ++i) {
          mine[i] = number_[surface.nodes[first + static_cast<std::size_t>(i)]];
          least = std::min(least, mine[i]);
          sum += mine[i];
        }
        int same = head[least];
        while (same >= 0 && !(sums[same] == sum && isOf(same, mine, each))) same = next[same];
        if (same < 0) {
          same = mesh_.elements();
          next.push_back(head[least]);
          head[least] = same;
          sums.push_back(sum);
          mesh_.cells.push_back(surface.cell);
          mesh_.connectivity.insert(mesh_.connectivity.end(), mine, mine + each);
          mesh_.offsets.push_back(static_cast<int>(mesh_.connectivity.size()));
        }
        elements.push_back(same);
      }
    }
  }
  bool isOf(int element, const int* nodes, int count) const {
    const Span<const int> own = mesh_.nodesOf(element);
    return own.size() == static_cast<std::size_t>(count) && std::is_permutation(own.begin(), own.end(), nodes);
  }

  void addElementGroups() {
    for (const auto& [name, parts] : gmsh_.groups[2]) {
      std::vector<int>& members = mesh_.elementGroups[name];
      const auto among = [&, &all = parts](int part) { return std::find(all.begin(), all.end(), part) != all.end(); };
      for (std::size_t s = 0; s < gmsh_.surfaces.size(); ++s) {
        const GmshMesh::Surface& surface = gmsh_.surfaces[s];
        const std::vector<int>& elements = elementsOf_[s];
        if (surface.parts.empty() && among(surface.tag)) members.insert(members.end(), elements.begin(), elements.end());
        for (std::size_t e = 0; e < surface.parts.size(); ++e)
          if (among(surface.parts[e])) members.push_back(elements[e]);
      }
      makeSet(members, std::less<int>());
    }
  }

  void addSideGroups() {
    std::vector<char> among(static_cast<std::size_t>(mesh_.nodes()), 0);  // ends of curve elements
    for (const auto& curve : gmsh_.curves)
      for (const int node : curve.second)
        if (number_[node] >= 0) among[number_[node]] = 1;
    const SideTable table(mesh_, among);
    for (const auto& [name, parts] : gmsh_.groups[1]) {
      std::vector<Side> sides;
      std::vector<Point> outside, inside;  // middles of curve elements that are no side of the boundary
      for (const int part : parts) {
        const auto found = gmsh_.curves.find(part);
        if (found == gmsh_.curves.end()) continue;
        for (std::size_t i = 0; i < found->second.size(); i += 2) {
          const int a = found->second[i], b = found->second[i + 1];
          const bool known = number_[a] >= 0 && number_[b] >= 0;  // else no surface element has one of them
          const std::vector<Side> here = known ? table.between(number_[a], number_[b]) : std::vector<Side>();
          if (here.size() == 1) {
            sides.push_back(here[0]);
            continue;
          }
          const double *p = place(a), *q = place(b);
          (here.empty() ? outside : inside).push_back({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 0});
        }
      }
      if (gmsh_.isUnnamed(name) && !(outside.empty() && inside.empty())) continue;
      reportSides(name, outside, "are no side of any surface element");
      reportSides(name, inside,
                  "lie inside the material, between two elements; if two bodies meet there, each must be a shape of its own, never "
                  "fragmented with the other");
      makeSet(sides, [](const Side& x, const Side& y) { return std::make_pair(x.element, x.side) < std::make_pair(y.element, y.side); });
      mesh_.sideGroups[name] = std::move(sides);
    }
  }
  void reportSides(const std::string& group, const std::vector<Point>& middles, const std::string& what) {
    if (!middles.empty())
      report("curve group '" + group + "': " + std::to_string(middles.size()) + " of its elements " + what + " (the first at " +
             placeText(middles[0]) + ")");
  }

  GmshMesh gmsh_;
  Mesh mesh_;
  Problems problems_;
  std::size_t entries_ = 0;                   // nodes of all elements
  std::vector<int> number_;                   // number of each node of Gmsh; -1: no element has it
  std::vector<std::vector<int>> elementsOf_;  // each surface
};

}  // namespace

Mesh assembleGmsh(GmshMesh gmsh, const std::string& file) { return Assembly(std::move(gmsh), file).mesh(); }

}  // namespace suture
