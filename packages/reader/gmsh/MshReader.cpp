#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/reader/gmsh/GmshTypes.hpp>
#include <suture/reader/gmsh/MshCursor.hpp>
#include <suture/reader/gmsh/MshReader.hpp>

#include <climits>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <tuple>

namespace suture {

namespace {

constexpr double largestCoordinate = 1e100;  // its cube is finite

class MshReader {
 public:
  explicit MshReader(const std::string& path) : path_(path), in_(path) {}

  GmshMesh read() {
    readFormat();
    for (std::string name = in_.enterSection(); !name.empty(); name = in_.enterSection()) {
      if (!readSection(name))
        in_.skipSection();
      else
        in_.leaveSection();
    }
    finish();
    return std::move(mesh_);
  }

 private:
  using Entity = std::pair<int, int>;  // dimension, part

  void readFormat() {
    const auto none = [&] { throw InputError(kMeshFile, path_ + ": is not a Gmsh mesh; expected $MeshFormat in the first line"); };
    if (*in_.rest() != '$') none();
    std::string name = in_.enterSection();
    for (; name == "Comments"; name = in_.enterSection()) in_.skipSection();
    if (name != "MeshFormat") none();
    version_ = in_.text<double>("the version of the format");
    if (!(version_ >= 2 && version_ < 3) && !(version_ >= 4.1 && version_ < 4.2))
      in_.fail("has version " + realText(version_) +
               " of Gmsh's format; supported are 2.0 to 2.2 and 4.1: convert it (gmsh IN.msh -save -format msh41 -o OUT.msh)");
    in_.binary = in_.text<int>("0 (text) or 1 (binary)") != 0;
    if (in_.text<int>("the size of a real number") != 8)
      in_.fail("real numbers are not 8 bytes long; convert the file on the machine that wrote it");
    if (in_.binary) {
      in_.endLine();
      const int one = in_.bytes<int>("the number 1");
      if (one == 1 << 24) in_.fail("has the byte order of another kind of machine; write it as text on that machine");
      if (one != 1) in_.fail("expected the number 1 in four bytes, found " + std::to_string(one));
    }
    in_.leaveSection();
  }

  /// False if the section does not belong to a mesh.
  bool readSection(const std::string& name) {
    if (name == "PhysicalNames")
      readNames();
    else if (name == "Nodes" || name == "ParametricNodes")
      withNumbers([&](auto numbers) { version_ < 4 ? readNodes2(numbers, name != "Nodes") : readNodes4(numbers); });
    else if (name == "Elements" && !position_)
      in_.fail("expected $Nodes before $Elements");
    else if (name == "Elements")
      withNumbers([&](auto numbers) { version_ < 4 ? readElements2(numbers) : readElements4(numbers); });
    else if (version_ > 4 && (name == "Entities" || name == "PartitionedEntities"))
      withNumbers([&](auto numbers) { readEntities(numbers, name != "Entities"); });
    else
      return false;
    return true;
  }
  template <typename Work>
  void withNumbers(const Work& work) {
    if (in_.binary)
      work(MshNumbers<true>{in_});
    else
      work(MshNumbers<false>{in_});
  }
  /// Reads a count of version 2, which is text also in a binary file.
  std::size_t textCount(const char* what) {
    const auto count = in_.text<std::size_t>(what);
    in_.endLine();
    return count;
  }

  void readNames() {
    for (auto left = in_.text<std::size_t>("a number of names"); left > 0; --left) {
      const int dimension = in_.text<int>("the dimension of a physical group"), tag = in_.text<int>("the tag of a physical group");
      names_[{dimension, std::abs(tag)}] = in_.quoted("the name of a physical group");
    }
  }

  template <typename Numbers>
  void readEntities(Numbers in, bool partitioned) {
    if (partitioned) {
      in.size("a number of partitions");
      for (std::size_t ghosts = in.size("a number of ghost entities"); ghosts > 0; --ghosts)
        in.integer("the tag of a ghost entity"), in.integer("a partition");
    }
    const auto skipIntegers = [&](const char* what) {
      for (std::size_t left = in.count(in.size(what), sizeof(int), "numbers"); left > 0; --left) in.integer(what);
    };
    std::size_t counts[4];
    for (std::size_t& count : counts) count = in.size("a number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t left = counts[dimension]; left > 0; --left) {
        std::vector<int>& groups = groupsOf_[{dimension, in.integer("the tag of an entity")}];
        bool between = false;  // a curve between two parts of a surface carries the surface's groups, which are not curve groups
        if (partitioned) {
          between = in.integer("the dimension of a parent") != dimension;
          in.integer("the tag of a parent");
          skipIntegers("partitions");
        }
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in.real("a bound of an entity");
        for (std::size_t n = in.count(in.size("a number of groups"), sizeof(int), "groups"); n > 0; --n) {
          const int group = std::abs(in.integer("a physical group"));  // negative: a curve against its direction
          if (!between) groups.push_back(group);
        }
        if (dimension > 0) skipIntegers("bounding entities");
      }
  }

  template <typename Numbers>
  void readPlace(Numbers in, std::size_t tag) {
    for (int k = 0; k < 3; ++k) {
      const double x = in.real("a coordinate");
      if (!(std::abs(x) <= largestCoordinate))
        in_.fail("node " + std::to_string(tag) + " has the coordinate " + realText(x) + "; expected a number of at most " +
                 realText(largestCoordinate) + " in magnitude");
      mesh_.coordinates.push_back(x);
    }
  }
  template <typename Numbers>
  void readNodes2(Numbers in, bool parametric) {
    const std::size_t count = in.count(textCount("a number of nodes"), sizeof(int) + 3 * sizeof(double), "nodes");
    reserveNodes(count);
    for (std::size_t n = 0; n < count; ++n) {
      addTag(in, in.integer("the tag of a node"));
      readPlace(in, mesh_.tags.back());
      if (!parametric) continue;
      const int dimension = in.integer("the dimension of an entity");
      in.integer("the tag of an entity");
      for (int k = 0; k < dimension && dimension < 3; ++k) in.real("a parameter of a node");
    }
    finishNodes();
  }
  template <typename Numbers>
  void readNodes4(Numbers in) {
    const std::size_t blocks = in.size("a number of blocks");
    const std::size_t all = in.count(in.size("a number of nodes"), sizeof(std::size_t) + 3 * sizeof(double), "nodes");
    in.size("the least tag of a node"), in.size("the largest tag of a node");
    reserveNodes(all);
    for (std::size_t b = 0; b < blocks; ++b) {
      const int dimension = in.integer("the dimension of an entity");
      in.integer("the tag of an entity");
      const int parameters = in.integer("0 or 1 (parametric)") != 0 ? dimension : 0;
      const std::size_t count = in.size("a number of nodes"), first = mesh_.tags.size();
      if (count > all - first) wrongTotal("nodes", all);
      for (std::size_t n = 0; n < count; ++n) addTag(in, in.size("the tag of a node"));
      for (std::size_t n = 0; n < count; ++n) {
        readPlace(in, mesh_.tags[first + n]);
        for (int k = 0; k < parameters; ++k) in.real("a parameter of a node");
      }
    }
    if (mesh_.tags.size() != all) wrongTotal("nodes", all);
    finishNodes();
  }
  [[noreturn]] void wrongTotal(const char* what, std::size_t announced) const {
    in_.fail("announces " + std::to_string(announced) + " " + what + ", but its blocks hold a different number");
  }
  void reserveNodes(std::size_t count) {
    if (position_) in_.fail("expected one section of nodes, found a second");
    if (count > INT_MAX) in_.fail(std::to_string(count) + " nodes; at most " + std::to_string(INT_MAX) + " can be read");
    mesh_.tags.reserve(count);
    mesh_.coordinates.reserve(3 * count);
  }
  template <typename Numbers, typename Tag>
  void addTag(Numbers, Tag tag) {
    if (tag < Tag(1)) in_.fail("node " + std::to_string(tag) + "; expected tags from 1 upwards");
    mesh_.tags.push_back(static_cast<std::size_t>(tag));
  }
  /// Checks that a node that occurs in several blocks is the same in all of them.
  void finishNodes() {
    const std::vector<std::size_t>& tags = mesh_.tags;
    const double* x = mesh_.coordinates.data();
    sortByTag(mesh_.tags, mesh_.coordinates);
    for (std::size_t n = 1; n < tags.size(); ++n)
      if (tags[n] == tags[n - 1] && !std::equal(x + 3 * n, x + 3 * n + 3, x + 3 * n - 3))
        in_.fail("node " + std::to_string(tags[n]) + " occurs twice, with different coordinates");
    position_.emplace(tags);
  }

  /// Destination of the elements of one type in one entity; null: these elements are not kept.
  GmshMesh::Block* blockOf(const GmshType& type, int entity, std::size_t expected) {
    if (type.dimension == 0 || (type.dimension > 1 && !type.cell)) return nullptr;
    GmshMesh::Block& block = blocks_[{type.dimension, entity, type.number}];
    block.dimension = type.dimension;
    block.tag = entity;
    block.type = type.number;
    block.nodes.reserve(block.nodes.size() + expected * static_cast<std::size_t>(type.nodes));
    return &block;
  }
  void countForeign(const GmshType* type, int number, int dimension, int part, std::size_t count) {
    if (count > 0 && (!type || (type->dimension >= 2 && !type->cell))) mesh_.addForeign(number, dimension, part, count);
  }
  template <typename Id, typename Numbers>
  void readElement(Numbers in, const GmshType& type, GmshMesh::Block* block, Id id) {
    for (int k = 0; k < type.nodes; ++k) {
      std::size_t tag;
      if constexpr (std::is_same_v<Id, int>)
        tag = static_cast<std::size_t>(in.integer("the node of an element"));
      else
        tag = in.size("the node of an element");
      const int at = (*position_)(tag);
      if (at < 0) in_.fail("element " + std::to_string(id) + " has node " + std::to_string(Id(tag)) + ", which $Nodes does not contain");
      if (block) block->nodes.push_back(at);
    }
  }

  template <typename Numbers>
  void readElements4(Numbers in) {
    const std::size_t blocks = in.size("a number of blocks"), all = in.size("a number of elements");
    in.size("the least tag of an element"), in.size("the largest tag of an element");
    std::size_t total = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      const int dimension = in.integer("the dimension of an entity"), entity = in.integer("the tag of an entity");
      const int number = in.integer("a type of elements");
      const GmshType* type = gmshType(number);
      if (!type && in_.binary) in_.fail("elements of the unknown Gmsh type " + std::to_string(number) + "; write the file as text");
      if (type && type->dimension != dimension)
        in_.fail(std::string("elements of the kind '") + type->name + "' in an entity of dimension " + std::to_string(dimension));
      const std::size_t count = in.count(in.size("a number of elements"),
                                         sizeof(std::size_t) * static_cast<std::size_t>(1 + (type ? type->nodes : 0)), "elements");
      total += count;
      countForeign(type, number, dimension, entity, count);
      if (!type) {
        for (std::size_t line = 0; line <= count; ++line) in_.endLine();
        continue;
      }
      if (count == 0) continue;
      GmshMesh::Block* block = blockOf(*type, entity, count);
      for (std::size_t e = 0; e < count; ++e) readElement(in, *type, block, in.size("the tag of an element"));
    }
    if (total != all) wrongTotal("elements", all);
  }

  template <typename Numbers>
  void readElements2(Numbers in) {
    const std::size_t all = in.count(textCount("a number of elements"), 2 * sizeof(int), "elements");
    std::size_t done = 0;
    while (done < all) {
      // In a binary file one header serves several elements; in a text file each element repeats it.
      int id = 0, follow = 1;
      if (!in_.binary) id = in.integer("the tag of an element");
      const int number = in.integer("a type of elements");
      if (in_.binary) follow = in.integer("a number of elements");
      const int tags = in.integer("a number of tags");
      const GmshType* type = gmshType(number);
      if (follow < 1 || static_cast<std::size_t>(follow) > all - done) wrongTotal("elements", all);
      done += static_cast<std::size_t>(follow);
      if (!type) {
        if (in_.binary) in_.fail("elements of the unknown Gmsh type " + std::to_string(number) + "; write the file as text");
        countForeign(type, number, 2, tags > 0 ? in.integer("a physical group") : 0, 1);
        in_.endLine();
        continue;
      }
      for (int e = 0; e < follow; ++e) {
        if (in_.binary) id = in.integer("the tag of an element");
        int group = 0, entity = 1;
        for (int t = 0; t < tags; ++t) {
          const int tag = std::abs(in.integer("a tag of an element"));
          if (t < 2) (t == 0 ? group : entity) = tag;
        }
        countForeign(type, number, type->dimension, group, 1);
        readElement(in, *type, blockOf2(*type, entity, group), id);
      }
    }
  }
  /// Block of an element. Elements of one type, entity and group mostly follow each other.
  GmshMesh::Block* blockOf2(const GmshType& type, int entity, int group) {
    if (lastType_ != &type || lastEntity_ != entity || lastGroup_ != group) {
      last_ = blockOf(type, entity, 0);
      lastType_ = &type;
      lastEntity_ = entity;
      lastGroup_ = group;
      if (group != 0) groupsOf_[{type.dimension, group}] = {group};
    }
    if (last_) last_->parts.push_back(group);
    return last_;
  }

  void finish() {
    for (auto& entry : blocks_) mesh_.blocks.push_back(std::move(entry.second));
    for (const auto& [entity, groups] : groupsOf_)
      for (const int group : groups) {
        const auto name = names_.find({entity.first, group});
        mesh_.addGroup(entity.first, group, name == names_.end() ? "" : name->second, entity.second);
      }
  }

  std::string path_;
  MshCursor in_;
  double version_ = 0;
  GmshMesh mesh_;
  std::optional<TagPositions> position_;
  std::map<Entity, std::string> names_;                          // by dimension and physical group
  std::map<Entity, std::vector<int>> groupsOf_;                  // physical groups of a part
  std::map<std::tuple<int, int, int>, GmshMesh::Block> blocks_;  // by dimension, entity and type
  GmshMesh::Block* last_ = nullptr;
  const GmshType* lastType_ = nullptr;
  int lastEntity_ = 0, lastGroup_ = 0;
};

}  // namespace

GmshMesh readMsh(const std::string& path) { return MshReader(path).read(); }

}  // namespace suture
