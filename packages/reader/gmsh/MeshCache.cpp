#include <suture/base/Buffer.hpp>
#include <suture/base/Hash.hpp>
#include <suture/reader/gmsh/MeshCache.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace suture {

namespace {

namespace fs = std::filesystem;

const char* const kFormat = "suture mesh 1";  // format of the entries; any other counts as missing
const char* const kEnding = ".mesh";
constexpr auto kAbandoned = std::chrono::hours(1);  // an incomplete file of this age belongs to a process that has died

std::uint64_t checksum(const std::string& bytes) {
  Hash hash;
  hash.bytes(bytes.data(), bytes.size());
  return hash.value();
}

std::optional<std::string> bytesIn(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) return std::nullopt;
  return bytes.str();
}

/// The content of an entry without its checksum at the end; nothing if the file is missing or damaged.
std::optional<std::string> soundEntry(const std::string& file) {
  std::optional<std::string> bytes = bytesIn(file);
  std::uint64_t written = 0;
  if (!bytes || bytes->size() < sizeof written) return std::nullopt;
  std::memcpy(&written, bytes->data() + bytes->size() - sizeof written, sizeof written);
  bytes->resize(bytes->size() - sizeof written);
  if (checksum(*bytes) != written) return std::nullopt;
  return bytes;
}

/// Writes a file that appears under its name only when it is complete. \return false if it cannot be written
bool writeWhole(const std::string& file, const std::string& bytes) {
  std::string part = file + ".XXXXXX";  // mkstemp replaces the X
  const int descriptor = mkstemp(part.data());
  if (descriptor < 0) return false;
  std::size_t at = 0;
  for (ssize_t written = 1; at < bytes.size() && written > 0; at += written > 0 ? static_cast<std::size_t>(written) : 0)
    written = write(descriptor, bytes.data() + at, bytes.size() - at);
  const bool closed = close(descriptor) == 0;
  if (closed && at == bytes.size() && std::rename(part.c_str(), file.c_str()) == 0) return true;
  unlink(part.c_str());
  return false;
}

}  // namespace

std::string MeshCache::fileOf(const std::string& key) const {
  Hash hash;
  hash.bytes(key.data(), key.size());
  return (fs::path(folder_) / (hash.hexadecimal() + kEnding)).string();
}

std::optional<GmshMesh> MeshCache::find(const std::string& key) const {
  if (!used()) return std::nullopt;
  try {
    const std::string file = fileOf(key);
    std::optional<std::string> bytes = soundEntry(file);
    if (!bytes) return std::nullopt;
    Unpacker entry(std::move(*bytes));
    if (entry.get<std::string>() != kFormat || entry.get<std::string>() != key) return std::nullopt;
    const auto programs = entry.get<std::vector<FileStamp>>();
    if (!std::all_of(programs.begin(), programs.end(), isUnchanged)) return std::nullopt;
    GmshMesh mesh = entry.get<GmshMesh>();
    std::error_code ignored;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // used: removed last
    return mesh;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void MeshCache::store(const std::string& key, const std::vector<FileStamp>& programs, const GmshMesh& mesh) const {
  if (!used() || programs.empty()) return;
  try {
    Packer entry;
    entry.put(std::string(kFormat));
    entry.put(key);
    entry.put(programs);
    entry.put(mesh);
    std::string bytes = std::move(entry).bytes();
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    if (bytes.size() > bytes_ / 4) return;
    fs::create_directories(folder_);
    if (writeWhole(fileOf(key), bytes)) trim();
  } catch (const std::exception&) {
    return;  // a mesh that is not stored is made again
  }
}

void MeshCache::trim() const {
  struct Entry {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<Entry> entries;
  std::uintmax_t total = 0;
  std::error_code failed;
  for (const fs::directory_entry& file : fs::directory_iterator(folder_)) {
    const std::string name = file.path().filename().string();
    if (name.find(kEnding) == std::string::npos || !file.is_regular_file(failed)) continue;  // not ours
    const Entry entry{file.last_write_time(failed), file.file_size(failed), file.path()};
    if (failed) continue;  // another process has removed it
    if (file.path().extension() == kEnding) {
      total += entry.bytes;
      entries.push_back(entry);
    } else if (fs::file_time_type::clock::now() - entry.used > kAbandoned) {
      fs::remove(entry.path, failed);
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  for (const Entry& entry : entries) {
    if (total <= bytes_) break;
    fs::remove(entry.path, failed);
    total -= entry.bytes;
  }
}

std::string meshCacheFolder() {
  const auto value = [](const char* name) {
    const char* text = std::getenv(name);
    return std::string(text ? text : "");
  };
  if (const std::string own = value("SUTURE_MESH_CACHE"); !own.empty()) return own == "off" ? "" : own;
  const fs::path caches = value("XDG_CACHE_HOME"), home = value("HOME");
  if (caches.is_absolute()) return (caches / "suture" / "meshes").string();
  return home.is_absolute() ? (home / ".cache" / "suture" / "meshes").string() : "";
}

}  // namespace suture
