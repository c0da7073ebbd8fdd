#pragma once
#include <suture/base/FileStamp.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Meshes made by Gmsh, kept in a folder for later runs of the same geometry. An entry holds all that determines the mesh, its key, which
/// is compared byte by byte, and the stamps of the programs that made it. An entry that is damaged, or whose programs have changed, counts
/// as missing. Files appear complete under their names: several processes may share the folder. No function throws or reports an error;
/// without a usable folder every mesh is missing. Local.
class MeshCache {
 public:
  static constexpr std::uintmax_t kBytes = std::uintmax_t(512) << 20;  ///< default size of the folder

  /// \param folder  made when the first mesh is stored; empty: stores and finds nothing
  /// \param bytes   the longest unused entries are removed above this total size; a mesh larger than a quarter of it is not stored
  explicit MeshCache(std::string folder, std::uintmax_t bytes = kBytes) : folder_(std::move(folder)), bytes_(bytes) {}

  bool used() const { return !folder_.empty(); }
  std::optional<GmshMesh> find(const std::string& key) const;
  void store(const std::string& key, const std::vector<FileStamp>& programs, const GmshMesh& mesh) const;

 private:
  std::string fileOf(const std::string& key) const;
  void trim() const;

  std::string folder_;
  std::uintmax_t bytes_;
};

/// The user's folder of meshes: $SUTURE_MESH_CACHE ("off": none), otherwise suture/meshes in $XDG_CACHE_HOME or in ~/.cache. Empty: none.
/// Local.
std::string meshCacheFolder();

}  // namespace suture
