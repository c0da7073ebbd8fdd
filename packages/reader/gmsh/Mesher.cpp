// suture_mesher: the only program that runs Gmsh. The library starts it for every .geo and CAD file (MesherProcess.hpp): a file that ends,
// hangs or crashes Gmsh, or makes it run programs, harms only this process. Writes MesherMessages to file descriptor 3.
//     suture_mesher FILE MESH_SIZE_FACTOR BYTES SECONDS ALLOW_PROGRAMS(0|1) ORDER(0|1|2) LARGEST_SIZE SCALE SIMPLICES(0|1) SIZES
// ORDER 0: as the file says, for CAD 2. LARGEST_SIZE 0: none, in the unit of the mesh. SCALE: factor on the lengths of the file.
// SIMPLICES 1: no quadrilaterals, prisms or hexahedra. SIZES: file with a packed SizeField that replaces all sizes, or -.
#include <suture/base/Buffer.hpp>
#include <suture/base/FileStamp.hpp>
#include <suture/reader/cad/CadModel.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>
#include <suture/reader/gmsh/GmshTypes.hpp>
#include <suture/reader/gmsh/SizesByPlace.hpp>

#include <gmsh.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
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

/// This program and all libraries that it has loaded: with the input, they determine the mesh.
std::vector<FileStamp> loadedPrograms() {
  std::error_code failed;
  std::vector<FileStamp> all;
  const auto add = [&all](const std::string& path) {
    if (const std::optional<FileStamp> stamp = stampOf(path)) all.push_back(*stamp);
  };
  add(std::filesystem::read_symlink("/proc/self/exe", failed).string());
  dl_iterate_phdr(
      [](dl_phdr_info* library, std::size_t, void* to) {
        if (library->dlpi_name && *library->dlpi_name == '/') (*static_cast<const decltype(add)*>(to))(library->dlpi_name);
        return 0;
      },
      const_cast<void*>(static_cast<const void*>(&add)));
  return all;
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
  } catch (const CadError& error) {
    send(MesherMessage::Refused, error.what());
    return false;
  } catch (...) {
    thrown = thrownText();
    if (thrown.empty()) thrown = "an error without a message";
  }
  const std::string logged = loggedError();
  if (thrown.empty() && logged.empty()) return true;
  send(MesherMessage::Failed, logged.empty() ? thrown : logged);
  return false;
}

/// Command line; see the top of this file.
struct Order {
  std::string file;
  double factor, seconds, largest, scale;
  std::size_t bytes;
  bool allowPrograms, simplices;
  int elementOrder;
  std::string sizes;

  explicit Order(char* argv[])
      : file(argv[1]),
        factor(std::atof(argv[2])),
        seconds(std::atof(argv[4])),
        largest(std::atof(argv[7])),
        scale(std::atof(argv[8])),
        bytes(std::strtoull(argv[3], nullptr, 10)),
        allowPrograms(std::string(argv[5]) == "1"),
        simplices(std::string(argv[9]) == "1"),
        elementOrder(std::atoi(argv[6])),
        sizes(argv[10]) {}
};

/// The options of the scene, on top of those of a .geo file.
void setOptions(const Order& order) {
  double own = 1;
  gmsh::option::getNumber("Mesh.MeshSizeFactor", own);
  gmsh::option::setNumber("Mesh.MeshSizeFactor", order.factor * own);
  if (order.elementOrder > 0) gmsh::option::setNumber("Mesh.ElementOrder", order.elementOrder);
  if (order.largest > 0) {
    gmsh::option::getNumber("Mesh.MeshSizeMax", own);
    gmsh::option::setNumber("Mesh.MeshSizeMax", std::min(own, order.largest));
    gmsh::option::getNumber("Mesh.MeshSizeMin", own);
    gmsh::option::setNumber("Mesh.MeshSizeMin", std::min(own, order.largest));
  }
}

using Sizes = std::shared_ptr<const SizesByPlace>;

/// The sizes of the order; null: none. Before files are forbidden.
Sizes sizesOf(const Order& order) {
  if (order.sizes == "-") return nullptr;
  std::ifstream in(order.sizes, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) throw std::runtime_error("cannot read " + order.sizes);
  return std::make_shared<const SizesByPlace>(Unpacker(bytes.str()).get<SizeField>(), 1 / order.scale);
}

/// Replaces all sizes of the file.
void setSizes(const Order& order, const Sizes& sizes) {
  if (order.simplices || sizes) {
    gmsh::option::setNumber("Mesh.RecombineAll", 0);
    gmsh::model::mesh::removeConstraints();
  }
  if (!sizes) return;
  gmsh::model::mesh::field::setAsBackgroundMesh(-1);
  for (const char* option :
       {"Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature", "Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeMin"})
    gmsh::option::setNumber(option, 0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", order.largest > 0 ? order.largest / order.scale : 1e22);
  gmsh::option::setNumber("Mesh.MeshSizeFactor", 1);
  gmsh::model::mesh::setSizeCallback([sizes](int, int, double x, double y, double z) { return sizes->at({x, y, z}); });
}

bool meshGeo(const Order& order, const Sizes& sizes, GmshMesh& mesh) {
  if (!good([&] { gmsh::open(order.file); })) return false;
  send(MesherMessage::Opened, "");
  return good([&] {
    setOptions(order);
    setSizes(order, sizes);
    gmsh::model::mesh::generate(std::max(2, gmsh::model::getDimension()));
    mesh = readMesh();
  });
}

constexpr double kRoundOff = 1e-13;  // coordinates of OpenCASCADE below this fraction of the largest one are zero

bool meshCad(const Order& order, const Sizes& sizes, GmshMesh& mesh) {
  std::optional<CadModel> model;
  if (!good([&] { model.emplace(order.file); })) return false;
  send(MesherMessage::Opened, "");
  return good([&] {
    const std::map<std::string, std::string> descriptions = model->name(order.scale);
    model->setMeshing(order.elementOrder == 1 ? 1 : 2,
                      order.largest > 0 ? std::optional<double>(order.largest / order.scale) : std::nullopt);
    gmsh::option::setNumber("Mesh.MeshSizeFactor", order.factor);
    setSizes(order, sizes);
    gmsh::model::mesh::generate(3);
    mesh = readMesh();
    mesh.descriptions = descriptions;
    double extent = 0.0;
    for (const double x : mesh.coordinates) extent = std::max(extent, std::abs(x));
    for (double& x : mesh.coordinates) x = std::abs(x) > kRoundOff * extent ? order.scale * x : 0.0;
  });
}

}  // namespace

int main(int argc, char* argv[]) {
  if (argc != 11) return 2;
  const Order order(argv);
  for (int open = 4; open < 1024; ++open) close(open);  // inherited from the parent
  limitThisProcess(order.bytes, order.seconds);
  gmsh::initialize(0, nullptr, false);  // without the user's own configuration files
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);  // the same mesh every time
  // By default an error leaves Gmsh's parser in the middle of the file. Make it continue to the end.
  gmsh::option::setNumber("General.AbortOnError", 0);
  gmsh::logger::start();
  Sizes sizes;
  if (!good([&] { sizes = sizesOf(order); })) return 1;
  if (!order.allowPrograms) forbidProgramsAndFiles();

  GmshMesh mesh;
  if (!(cadFormat(order.file) == CadFormat::None ? meshGeo(order, sizes, mesh) : meshCad(order, sizes, mesh))) return 1;
  Packer programs, packer;
  programs.put(loadedPrograms());
  send(MesherMessage::Programs, programs.bytes());
  if (!good([&] { packer.put(mesh); })) return 1;
  send(MesherMessage::Mesh, packer.bytes());
  return 0;
}
