// suture_mesher: the only program that runs Gmsh. The library starts it for every .geo and .msh file (MesherProcess.hpp), so that a file
// that ends, hangs or crashes Gmsh, or makes it run programs, harms only this process. Writes MesherMessages to its descriptor 3.
//     suture_mesher geo|msh FILE MESH_SIZE_FACTOR BYTES SECONDS ALLOW_PROGRAMS(0|1)
#include <suture/base/Buffer.hpp>
#include <suture/mesh/gmsh/GmshMesh.hpp>

#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "Sandbox.hpp"

namespace {

using namespace suture;

void send(MesherMessage message, const std::string& text) {
  const std::uint64_t length = text.size();
  std::string bytes(1, static_cast<char>(message));
  bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
  const auto put = [](const std::string& all) {
    for (std::size_t at = 0; at < all.size();) {
      const ssize_t written = write(3, all.data() + at, all.size() - at);
      if (written <= 0) return;
      at += static_cast<std::size_t>(written);
    }
  };
  put(bytes);
  put(text);
}

/// The first error that Gmsh has logged, or "".
std::string loggedError() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  const std::string mark = "Error: ";
  for (const std::string& line : log)
    if (line.compare(0, mark.size(), mark) == 0) return line.substr(mark.size());
  return "";
}

std::optional<Cell> cellOfGmshType(int type) {
  switch (type) {
    case 2:
      return Cell::Triangle3;
    case 9:
      return Cell::Triangle6;
    case 3:
      return Cell::Quadrilateral4;
    case 16:
      return Cell::Quadrilateral8;
    case 10:
      return Cell::Quadrilateral9;
    default:
      return std::nullopt;
  }
}

std::string gmshTypeName(int type) {
  std::string name;
  int dimension, order, nodes, primary;
  std::vector<double> coordinates;
  try {
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, coordinates, primary);
  } catch (...) {  // one that Gmsh does not know either
  }
  return name.empty() ? "Gmsh type " + std::to_string(type) : name;
}

void readNodes(GmshMesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  mesh.tags.reserve(tags.size());
  mesh.coordinates.reserve(coordinates.size());
  for (const std::size_t i : order) {
    mesh.tags.push_back(tags[i]);
    mesh.coordinates.insert(mesh.coordinates.end(), {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
  }
}

/// " (in the group 'a')": the physical groups of an entity.
std::string groupsOf(int dimension, int tag) {
  std::vector<int> physical;
  gmsh::model::getPhysicalGroupsForEntity(dimension, tag, physical);
  std::string names;
  for (const int group : physical) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, group, name);
    names += (names.empty() ? "" : ", ") + (name.empty() ? std::to_string(group) : "'" + name + "'");
  }
  return names.empty() ? "in no group" : "in the group " + names;
}

const char* const knownCells = "; known are triangles of 3 or 6 nodes and quadrilaterals of 4, 8 or 9 nodes";

/// \return how many elements of any kind there are
std::size_t readElements(GmshMesh& mesh) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  std::map<std::pair<std::string, std::string>, std::size_t> foreign;  // kind of cell, its group -> how many
  std::size_t all = 0;
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t count = elements[t].size();
      all += count;
      if (count == 0 || dimension == 0) continue;
      const std::size_t each = nodes[t].size() / count;
      const auto cell = cellOfGmshType(types[t]);
      if (dimension == 3 || (dimension == 2 && !cell)) {
        foreign[{gmshTypeName(types[t]), groupsOf(dimension, tag)}] += count;
      } else if (dimension == 1) {
        for (std::size_t e = 0; e < count; ++e)  // a line's end points are its first two nodes, whatever its order
          mesh.curves[tag].insert(mesh.curves[tag].end(), {nodes[t][e * each], nodes[t][e * each + 1]});
      } else {
        mesh.surfaces.push_back({tag, *cell, std::move(nodes[t])});
      }
    }
  }
  for (const auto& [kind, count] : foreign)
    mesh.problems.push_back(std::to_string(count) + " elements of the kind '" + kind.first + "' " + kind.second + knownCells);
  if (mesh.surfaces.empty() && foreign.empty())
    mesh.problems.push_back(std::string("holds no surface elements") +
                            (entities.empty() ? ": the geometry is empty" : "; is there a Surface, and does a .msh file hold its mesh?"));
  return all;
}

void readGroups(GmshMesh& mesh) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    if (dimension != 1 && dimension != 2) continue;
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.empty()) continue;
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    std::vector<int>& all = (dimension == 2 ? mesh.surfaceGroups : mesh.curveGroups)[name];
    for (const int entity : entities) all.push_back(std::abs(entity));  // a curve may be named against its direction
  }
}

/// The elements that a .msh file (text) holds, by type and place. Gmsh passes over some types in silence.
class Declared {
 public:
  explicit Declared(const std::string& path) : in_(path) {
    double version = 0;
    int binary = 0;
    for (std::string line; std::getline(in_, line);) {
      if (line.compare(0, 11, "$MeshFormat") == 0) in_ >> version >> binary;
      if (binary != 0) return;
      if (line.compare(0, 9, "$Elements") != 0) continue;
      version < 4 ? readFlat() : readBlocks();
      return;
    }
  }
  std::size_t all() const { return all_; }
  /// Those that the mesh does not have, in a sentence.
  std::string missing() const {
    std::string text;
    for (const auto& [kind, count] : counts_) {
      std::vector<std::size_t> tags, nodes;
      const auto [type, dimension, tag] = kind;
      std::size_t kept = 0;
      try {
        gmsh::model::mesh::getElementsByType(type, tags, nodes, tag);
        kept = tags.size();
      } catch (...) {  // a type or a place that Gmsh does not know: none is kept
      }
      if (kept >= count) continue;
      text += (text.empty() ? "" : "; ") + std::to_string(count - kept) + " elements of the kind '" + gmshTypeName(type) + "' " +
              (tag < 0 ? "" : groupsOf(dimension, tag) + " ") + "are lost";
    }
    return text;
  }

 private:
  void readFlat() {
    std::size_t number = 0;
    in_ >> all_;
    std::string line;
    std::getline(in_, line);
    for (std::size_t e = 0; e < all_ && std::getline(in_, line); ++e) {
      std::istringstream words(line);
      int type = 0;
      if (words >> number >> type) ++counts_[{type, 2, -1}];
    }
  }
  void readBlocks() {
    std::size_t blocks = 0, least = 0, most = 0;
    in_ >> blocks >> all_ >> least >> most;
    std::string line;
    for (std::size_t b = 0; b < blocks; ++b) {
      int dimension = 0, tag = 0, type = 0;
      std::size_t count = 0;
      if (!(in_ >> dimension >> tag >> type >> count)) return;
      std::getline(in_, line);
      counts_[{type, dimension, tag}] += count;
      for (std::size_t e = 0; e < count && std::getline(in_, line); ++e) {
      }
    }
  }

  std::ifstream in_;
  std::size_t all_ = 0;
  std::map<std::tuple<int, int, int>, std::size_t> counts_;  // type, dimension and number of the entity (-1: any)
};

GmshMesh readMesh(bool geometry, const std::string& path) {
  GmshMesh mesh;
  readNodes(mesh);
  const std::size_t kept = readElements(mesh);
  readGroups(mesh);
  if (!geometry) {
    const Declared declared(path);
    if (kept < declared.all()) {
      const std::string missing = declared.missing();
      mesh.problems.push_back(missing.empty() ? "Gmsh read " + std::to_string(kept) + " of the " + std::to_string(declared.all()) +
                                                    " elements that $Elements announces"
                                              : missing + knownCells);
    }
  }
  return mesh;
}

/// Text of the exception in hand; libgmsh 4.8 throws texts and numbers, later ones exceptions.
std::string thrownText() {
  try {
    throw;
  } catch (const std::string& text) {
    return text;
  } catch (const std::bad_alloc&) {
    return "out of memory: it asks for more than this machine has left";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an error without a message";
  }
}

/// Runs a step; false, and the reason is sent, when it fails. Errors in a file may be in the log only, and the first one there says most.
template <typename Step>
bool good(Step step) {
  std::string thrown;
  try {
    step();
  } catch (...) {
    thrown = thrownText();
    if (thrown.empty()) thrown = "an error without a message";
  }
  const std::string logged = loggedError();
  if (thrown.empty() && logged.empty()) return true;
  send(MesherMessage::Failed, logged.empty() ? thrown : logged);
  return false;
}

}  // namespace

int main(int argc, char* argv[]) {
  if (argc != 7) return 2;
  const bool geometry = std::string(argv[1]) == "geo", allowPrograms = std::string(argv[6]) == "1";
  const std::string path = argv[2];
  const double factor = std::atof(argv[3]);
  for (int open = 4; open < 1024; ++open) close(open);  // files of the parent
  limitThisProcess(std::strtoull(argv[4], nullptr, 10), std::atof(argv[5]));
  gmsh::initialize(0, nullptr, false);  // without the user's own configuration files
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);  // the same mesh every time
  // By default an error leaves Gmsh's parser in the middle of the file. Let it go to the end.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
  if (!allowPrograms) forbidProgramsAndFiles();

  if (!good([&] { gmsh::open(path); })) return 1;
  send(MesherMessage::Opened, "");
  GmshMesh mesh;
  const bool made = good([&] {
    if (geometry) {
      double own = 1;
      gmsh::option::getNumber("Mesh.MeshSizeFactor", own);
      gmsh::option::setNumber("Mesh.MeshSizeFactor", factor * own);
      gmsh::model::mesh::generate(2);
    }
  });
  if (!made || !good([&] { mesh = readMesh(geometry, path); })) return 1;
  Packer packer;
  if (!good([&] { packer.put(mesh); })) return 1;
  send(MesherMessage::Mesh, packer.bytes());
  return 0;
}
