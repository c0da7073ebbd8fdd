#pragma once
#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace suture {

constexpr const char* kMeshFile = "Mesh/File";  ///< parameter that errors in a mesh file refer to

/// Mesh in Gmsh's terms: the result of suture_mesher for a .geo file, or the content of a .msh file.
struct GmshMesh {
  /// Elements of one type in one Gmsh entity (volume, surface or curve).
  struct Block {
    int dimension = 0, tag = 0;  ///< Gmsh's entity
    int type = 0;                ///< Gmsh's number, see gmshType()
    std::vector<int> nodes;      ///< nodes as positions in `tags`, element by element, in Gmsh's order
    std::vector<int> parts;      ///< part of each element, for groups; empty: all elements belong to the part `tag`
    template <typename Self, typename Each>
    static void forEachField(Self& self, Each each) {
      each(self.dimension), each(self.tag), each(self.type), each(self.nodes), each(self.parts);
    }
  };
  /// Elements of a type that Suture does not support.
  struct Foreign {
    int type, dimension, part;
    std::size_t count;
  };
  std::vector<std::size_t> tags;    ///< tags of nodes, ascending
  std::vector<double> coordinates;  ///< x, y, z of each
  std::vector<Block> blocks;        ///< by dimension, tag and type
  std::vector<Foreign> foreign;
  std::map<int, std::map<std::string, std::vector<int>>> groups;  ///< by dimension: name -> parts
  std::vector<std::string> unnamed;                 ///< groups without a name in the file, under the names that addGroup() gives them
  std::vector<std::string> problems;                ///< problems of the mesh
  std::map<std::string, std::string> descriptions;  ///< shapes of side groups of a CAD file: "cylinder, radius 6, along z, hollow"

  /// Adds a part to a physical group. A group without a name is called "volume 2", "surface 7" or "curve 3"; a named group of that name is
  /// a problem.
  void addGroup(int dimension, int tag, const std::string& name, int part) {
    static const char* const kinds[] = {"point ", "curve ", "surface ", "volume "};
    const std::string called = !name.empty() ? name : kinds[std::clamp(dimension, 0, 3)] + std::to_string(tag);
    std::map<std::string, std::vector<int>>& all = groups[dimension];
    if (all.count(called) > 0 && isUnnamed(called) != name.empty())
      problems.push_back("the group '" + called + "' has the default name of the unnamed group " + std::to_string(tag) + "; rename it");
    if (name.empty() && !isUnnamed(called)) unnamed.push_back(called);
    all[called].push_back(part);
  }
  bool isUnnamed(const std::string& group) const { return std::find(unnamed.begin(), unnamed.end(), group) != unnamed.end(); }

  void addForeign(int type, int dimension, int part, std::size_t count) {
    auto at = std::find_if(foreign.begin(), foreign.end(), [&](const Foreign& f) { return f.type == type && f.part == part; });
    if (at == foreign.end()) at = foreign.insert(at, {type, dimension, part, 0});
    at->count += count;
  }

  template <typename Self, typename Each>
  static void forEachField(Self& self, Each each) {
    each(self.tags), each(self.coordinates), each(self.blocks), each(self.foreign), each(self.groups), each(self.unnamed),
        each(self.problems), each(self.descriptions);
  }
};

/// Positions of nodes by their tags, which ascend: a table if the tags are dense, otherwise bisection.
class TagPositions {
 public:
  /// Keeps a reference to `tags`.
  explicit TagPositions(const std::vector<std::size_t>& tags) : tags_(tags) {
    if (tags.empty()) return;
    const std::size_t range = tags.back() - tags.front();
    if (range / 4 > tags.size()) return;
    dense_.assign(range + 1, -1);
    for (std::size_t i = 0; i < tags.size(); ++i) dense_[tags[i] - tags.front()] = static_cast<int>(i);
  }
  /// Position of a tag, or -1.
  int operator()(std::size_t tag) const {
    if (!dense_.empty()) {
      const std::size_t at = tag - tags_.front();  // a lower tag wraps around to a very large number
      return at < dense_.size() ? dense_[at] : -1;
    }
    const auto at = std::lower_bound(tags_.begin(), tags_.end(), tag);
    return at != tags_.end() && *at == tag ? static_cast<int>(at - tags_.begin()) : -1;
  }

 private:
  const std::vector<std::size_t>& tags_;
  std::vector<int> dense_;  ///< by the distance from the first tag
};

/// Sorts nodes by their tags. Local.
inline void sortByTag(std::vector<std::size_t>& tags, std::vector<double>& coordinates) {
  if (std::is_sorted(tags.begin(), tags.end())) return;
  std::vector<std::pair<std::size_t, std::size_t>> order;  // tag, place
  order.reserve(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) order.emplace_back(tags[i], i);
  std::sort(order.begin(), order.end());
  const std::vector<double> old = coordinates;
  for (std::size_t i = 0; i < order.size(); ++i) {
    tags[i] = order[i].first;
    std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(3 * order[i].second), 3,
                coordinates.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
}

/// Messages of suture_mesher to its parent through its file descriptor 3: one letter, the length in eight bytes, and the text.
enum class MesherMessage : char {
  Opened = 'O',    ///< all statements, or all parts of a CAD file, are read; meshing begins
  Failed = 'F',    ///< text: Gmsh's error message
  Refused = 'R',   ///< text: why suture_mesher does not mesh the file
  Programs = 'P',  ///< the packed FileStamps of the program and its libraries; sent before Mesh
  Mesh = 'M'       ///< a packed GmshMesh: success
};

}  // namespace suture
