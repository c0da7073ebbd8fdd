// suture_mesher: the only program that runs Gmsh. The library starts it for every .geo file (MesherProcess.hpp): a file that ends, hangs or
// crashes Gmsh, or makes it run programs, harms only this process. Writes MesherMessages to file descriptor 3.
//     suture_mesher FILE MESH_SIZE_FACTOR BYTES SECONDS ALLOW_PROGRAMS(0|1)
#include <suture/base/Buffer.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>
#include <suture/reader/gmsh/GmshTypes.hpp>

#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
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

/// The first error that Gmsh has logged, or "". A file may silence the log (General.Verbosity = 0): Gmsh then still knows its last error.
std::string loggedError() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  const std::string mark = "Error: ";
  for (const std::string& line : log)
    if (line.compare(0, mark.size(), mark) == 0) return line.substr(mark.size());
  std::string last;
  gmsh::logger::getLastError(last);
  return last;
}

void readNodes(GmshMesh& mesh) {
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(mesh.tags, mesh.coordinates, parameters);
  sortByTag(mesh.tags, mesh.coordinates);
}

void readElements(GmshMesh& mesh) {
  const TagPositions position(mesh.tags);
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dimension, tag] : entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, dimension, tag);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t count = elements[t].size();
      const GmshType* type = gmshType(types[t]);
      if (count == 0 || dimension == 0 || (dimension == 1 && !type)) continue;
      if (!type || (dimension > 1 && !type->cell)) {
        mesh.addForeign(types[t], dimension, tag, count);
        continue;
      }
      mesh.blocks.push_back({dimension, tag, types[t], {}, {}});
      mesh.blocks.back().nodes.reserve(nodes[t].size());
      for (const std::size_t node : nodes[t]) mesh.blocks.back().nodes.push_back(position(node));
    }
  }
}

void readGroups(GmshMesh& mesh) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    for (const int entity : entities) mesh.addGroup(dimension, tag, name, std::abs(entity));  // negative: a curve against its direction
  }
}

GmshMesh readMesh() {
  GmshMesh mesh;
  readNodes(mesh);
  readElements(mesh);
  readGroups(mesh);
  return mesh;
}

/// Text of the current exception; libgmsh 4.8 throws texts and numbers, later versions throw exceptions.
std::string thrownText() {
  try {
    throw;
  } catch (const std::string& text) {
    return text;
  } catch (const std::bad_alloc&) {
    return "out of memory: Gmsh needs more than this machine has left";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an error without a message";
  }
}

/// Runs a step. If it fails, sends the reason and returns false. Some errors are only logged; the first logged one is the most informative.
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
  if (argc != 6) return 2;
  const bool allowPrograms = std::string(argv[5]) == "1";
  const std::string path = argv[1];
  const double factor = std::atof(argv[2]);
  for (int open = 4; open < 1024; ++open) close(open);  // inherited from the parent
  limitThisProcess(std::strtoull(argv[3], nullptr, 10), std::atof(argv[4]));
  gmsh::initialize(0, nullptr, false);  // without the user's own configuration files
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);  // the same mesh every time
  // By default an error leaves Gmsh's parser in the middle of the file. Make it continue to the end.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
  if (!allowPrograms) forbidProgramsAndFiles();

  if (!good([&] { gmsh::open(path); })) return 1;
  send(MesherMessage::Opened, "");
  GmshMesh mesh;
  const bool made = good([&] {
    double own = 1;
    gmsh::option::getNumber("Mesh.MeshSizeFactor", own);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", factor * own);
    gmsh::model::mesh::generate(std::max(2, gmsh::model::getDimension()));
  });
  if (!made || !good([&] { mesh = readMesh(); })) return 1;
  Packer packer;
  if (!good([&] { packer.put(mesh); })) return 1;
  send(MesherMessage::Mesh, packer.bytes());
  return 0;
}
