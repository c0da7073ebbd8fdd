#include <suture/base/Buffer.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Memory.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/reader/cad/CadFile.hpp>
#include <suture/reader/gmsh/GmshTypes.hpp>
#include <suture/reader/gmsh/MesherProcess.hpp>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

extern char** environ;

namespace suture {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// File descriptor, closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

/// A running suture_mesher; the destructor kills it and waits for its end.
class Process {
 public:
  Process(const std::vector<std::string>& words, int pipe) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int standard : {0, 1, 2}) posix_spawn_file_actions_addopen(&files, standard, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_adddup2(&files, pipe, 3);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setpgroup(&attributes, 0);  // signals to the terminal's group are for the parent
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    const int failed = posix_spawn(&id_, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (failed != 0) throw EnvironmentError("cannot run " + words[0] + ": " + std::strerror(failed));
  }
  ~Process() { end(); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits for its end, at most one second, and describes how it ended; kills it and its children if it does not end.
  std::string end() {
    if (id_ <= 0) return ended_;
    int status = 0;
    bool killed = false;
    useconds_t pause = 200, waited = 0;  // [microseconds]; it usually ends at once
    while (waitpid(id_, &status, WNOHANG) == 0) {
      if (!killed && waited >= 1000000) {
        killed = true;
        kill(-id_, SIGKILL);
      }
      usleep(pause);
      waited += pause;
      pause = std::min<useconds_t>(2 * pause, 10000);
    }
    kill(-id_, SIGKILL);
    id_ = 0;
    if (WIFSIGNALED(status) && !killed)
      ended_ = std::string("suture_mesher crashed or reached a limit: ") + strsignal(WTERMSIG(status));
    else
      ended_ = "suture_mesher ended without a mesh and without a message; does a .geo file contain a statement such as Exit or Abort?";
    return ended_;
  }
  void terminate() {
    if (id_ > 0) kill(-id_, SIGKILL);
  }

 private:
  pid_t id_ = 0;
  std::string ended_;
};

/// Reads messages from the pipe, with a time limit.
class Messages {
 public:
  Messages(int pipe, double seconds) : pipe_(pipe), until_(Clock::now() + std::chrono::duration_cast<Clock::duration>(limit(seconds))) {}
  void setLimit(Clock::time_point begin, double seconds) { until_ = begin + std::chrono::duration_cast<Clock::duration>(limit(seconds)); }
  bool timedOut() const { return timedOut_; }

  /// Reads the next message; false at the end of the pipe or when the time is up.
  bool next(MesherMessage& message, std::string& text) {
    char letter = 0;
    std::uint64_t length = 0;
    if (!take(&letter, 1) || !take(reinterpret_cast<char*>(&length), sizeof length)) return false;
    message = static_cast<MesherMessage>(letter);
    text.clear();
    // Memory grows with the bytes received, not with those announced.
    while (text.size() < length) {
      const std::size_t old = text.size(), more = std::min<std::uint64_t>(length - old, std::max<std::size_t>(1 << 20, old));
      text.resize(old + more);
      if (!take(text.data() + old, more)) return false;
    }
    return true;
  }

 private:
  static std::chrono::duration<double> limit(double seconds) { return std::chrono::duration<double>(std::min(seconds, 1e8)); }

  bool take(char* to, std::size_t count) {
    while (count > 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until_ - Clock::now()).count();
      pollfd wanted{pipe_, POLLIN, 0};
      const int ready = left <= 0 ? 0 : poll(&wanted, 1, static_cast<int>(std::min<long long>(left, 1000)));
      if (ready < 0 && errno != EINTR) return false;
      if (ready <= 0) {
        if (left <= 0) timedOut_ = true;
        if (left <= 0) return false;
        continue;
      }
      const ssize_t got = read(pipe_, to, count);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      to += got;
      count -= static_cast<std::size_t>(got);
    }
    return true;
  }

  int pipe_;
  Clock::time_point until_;
  bool timedOut_ = false;
};

// Gmsh names the temporary wrapper; replace that name by the user's file.
std::string withOwnName(std::string message, const MesherOrder& order) {
  for (std::size_t at = message.find(order.opened); at != std::string::npos; at = message.find(order.opened, at + order.file.size()))
    message.replace(at, order.opened.size(), order.file);
  return message;
}

/// The end of "Gmsh has not ..." for a file that takes too long before meshing begins.
std::string unread(const MesherOrder& order, const std::string& limit) {
  if (cadFormat(order.file) != CadFormat::None)
    return "read the parts within a tenth of " + limit + "; the file is damaged, or needs a longer time limit";
  return "read the statements within a tenth of " + limit + "; does the file contain an endless loop, or a macro that calls itself?";
}

// Checks that all numbers are consistent: Gmsh's output is not trusted.
void check(const GmshMesh& mesh, const std::string& file) {
  const int nodes = static_cast<int>(mesh.tags.size());
  const auto known = [&](int node) { return node >= 0 && node < nodes; };
  bool sound = mesh.coordinates.size() == 3 * mesh.tags.size();
  for (const GmshMesh::Block& block : mesh.blocks) {
    const GmshType* type = gmshType(block.type);
    sound = sound && type && type->dimension == block.dimension && (block.dimension == 1 || type->cell) && block.parts.empty() &&
            block.nodes.size() % static_cast<std::size_t>(type->nodes) == 0 && std::all_of(block.nodes.begin(), block.nodes.end(), known);
  }
  if (!sound) throw InputError(kMeshFile, file + ": is damaged: elements refer to nodes that the file does not contain");
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i)
    if (!std::isfinite(mesh.coordinates[i]))
      throw InputError(kMeshFile, file + ": the coordinates of node " + std::to_string(mesh.tags[i / 3]) + " are not finite");
}

}  // namespace

std::string mesherProgram() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&runMesher), &info) == 0 || !info.dli_fname)
    throw EnvironmentError("cannot find the folder of the library libsuture, which contains suture_mesher");
  std::error_code failed;
  const fs::path library = fs::canonical(info.dli_fname, failed);
  const fs::path program = (failed ? fs::path(info.dli_fname) : library).parent_path() / "suture" / "suture_mesher";
  if (access(program.c_str(), X_OK) != 0)
    throw EnvironmentError("cannot run " + program.string() + ", which meshes .geo and CAD files: " + std::strerror(errno));
  return program.string();
}

GmshMesh runMesher(const MesherOrder& order, std::vector<FileStamp>* programs) {
  const double megabytes = std::min(availableMegabytes(), 1e9);
  std::unique_ptr<const SizeFieldFile> sizes;
  if (order.sizes) sizes = std::make_unique<const SizeFieldFile>(*order.sizes);
  const std::vector<std::string> words = {mesherProgram(),
                                          order.opened,
                                          realText(order.meshSizeFactor),
                                          std::to_string(static_cast<unsigned long long>(megabytes * (1 << 20))),
                                          realText(order.seconds),
                                          order.allowPrograms ? "1" : "0",
                                          std::to_string(order.order),
                                          realText(order.largest),
                                          realText(order.scale),
                                          order.simplices ? "1" : "0",
                                          sizes ? sizes->path() : "-"};
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw EnvironmentError(std::string("cannot make a pipe for suture_mesher: ") + std::strerror(errno));
  Descriptor in(ends[0]), out(ends[1]);
  const Clock::time_point begin = Clock::now();
  Process mesher(words, out);
  out.close();

  Messages messages(in, order.seconds / 10);  // statements may loop forever, and need less time than meshing
  MesherMessage message{};
  std::string text;
  bool opened = false;
  while (messages.next(message, text)) {
    if (message == MesherMessage::Opened) {
      opened = true;
      messages.setLimit(begin, order.seconds);
    } else if (message == MesherMessage::Failed) {
      throw InputError(kMeshFile, order.file + ": Gmsh reports: " + withOwnName(text, order));
    } else if (message == MesherMessage::Refused) {
      throw InputError(kMeshFile, order.file + ": " + text);
    } else if (message == MesherMessage::Programs) {
      if (programs) *programs = Unpacker(std::move(text)).get<std::vector<FileStamp>>();
    } else if (message == MesherMessage::Mesh) {
      GmshMesh mesh = Unpacker(std::move(text)).get<GmshMesh>();
      check(mesh, order.file);
      return mesh;
    } else {
      break;
    }
  }
  if (messages.timedOut()) {
    mesher.terminate();
    const std::string limit = "Mesh/Time Limit (" + realText(order.seconds) + " s)";
    throw InputError(kMeshFile,
                     order.file + ": Gmsh has not " +
                         (opened ? "finished within " + limit + "; try a coarser mesh or a longer time limit" : unread(order, limit)));
  }
  throw InputError(kMeshFile, order.file + ": Gmsh produced no mesh: " + mesher.end());
}

}  // namespace suture
