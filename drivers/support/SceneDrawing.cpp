#include "SceneDrawing.hpp"

#include <suture/base/Errors.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputSchema.hpp>
#include <suture/report/SceneData.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

extern char** environ;

namespace suture {

namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 120.0;  // limit for a drawing

/// suture_plot --scene with the same scene, overrides and plugins.
std::string commandToDraw(const SolveOptions& options) {
  std::vector<std::string> words{"suture_plot", "--scene", options.scene};
  for (const std::string& assignment : options.overrides) words.insert(words.end(), {"--set", assignment});
  for (const std::string& plugin : options.plugins) words.insert(words.end(), {"--plugin", plugin});
  return shellCommand(words);
}

/// suture_plot beside this program, else on the PATH; empty if there is none.
std::string plotProgram() {
  const auto runs = [](const fs::path& program) { return access(program.c_str(), X_OK) == 0; };
  std::error_code failed;
  const fs::path beside = fs::read_symlink("/proc/self/exe", failed).parent_path() / "suture_plot";
  if (!failed && runs(beside)) return beside.string();
  const char* const path = getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path program = fs::path(folder) / "suture_plot"; !folder.empty() && runs(program)) return program.string();
  return "";
}

/// The environment without the variables by which a program would take part in the MPI job of this one.
std::vector<char*> environmentWithoutMpi() {
  std::vector<char*> kept;
  for (char** entry = environ; *entry; ++entry) {
    const auto begins = [&](const char* with) { return std::strncmp(*entry, with, std::strlen(with)) == 0; };
    if (!begins("OMPI_") && !begins("PMIX_") && !begins("PMI_") && !begins("MPI_LOCAL")) kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
}

/// Waits for a process, at most kSeconds. \return its exit code; nothing if it was killed
std::optional<int> endOf(pid_t process) {
  int status = 0;
  for (double waited = 0.0; waitpid(process, &status, WNOHANG) == 0; waited += 0.01) {
    if (waited > kSeconds) {
      kill(process, SIGKILL);
      waitpid(process, &status, 0);
      return std::nullopt;
    }
    usleep(10000);
  }
  return WIFEXITED(status) ? std::optional<int>(WEXITSTATUS(status)) : std::nullopt;
}

/// Runs a program with its output in a file. \return its exit code; nothing if it did not start or did not end
std::optional<int> run(const std::vector<std::string>& words, const std::string& output) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, 1, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&files, 1, 2);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t all;
  sigfillset(&all);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = 0;
  std::vector<char*> environment = environmentWithoutMpi();
  const int failed = posix_spawn(&process, arguments[0], &files, &attributes, arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return failed == 0 ? endOf(process) : std::nullopt;
}

std::vector<std::string> linesOf(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A line of suture_plot without its name at the beginning.
std::string withoutName(const std::string& line) {
  const std::string name = "suture_plot: ";
  return line.compare(0, name.size(), name) == 0 ? line.substr(name.size()) : line;
}

}  // namespace

SceneDrawing::SceneDrawing(const Comm& comm, const SolveOptions& options, const SceneFile& scene, const Mesh& mesh) {
  if (!options.check) return;
  command_ = commandToDraw(options);
  const auto alone = comm.split(comm.getRank() == 0 ? 0 : -1, 0);
  if (comm.getRank() != 0 || options.quiet || !options.drawing || mesh.elements() == 0) return;
  output_ = outputFolder(scene);
  std::error_code failed;
  std::string name = (fs::temp_directory_path(failed) / "suture_check.XXXXXX").string();  // mkdtemp replaces the X
  if (failed || !mkdtemp(name.data())) {
    missing_ = std::string("cannot make a temporary folder: ") + std::strerror(errno);
    return;
  }
  folder_ = name;
  try {
    writeSceneData(*alone, mesh, scene, (folder_ / "scene.vtkhdf").string());
  } catch (const EnvironmentError& error) {
    missing_ = error.what();
  }
}

SceneDrawing::~SceneDrawing() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

void SceneDrawing::draw(std::ostream* console) const {
  if (!console) return;
  const auto notDrawn = [&](const std::string& why) {
    *console << "   not drawn: " << why << "\n   to draw it: " << command_ << std::endl;
  };
  if (!missing_.empty()) return notDrawn(missing_);
  if (folder_.empty()) {
    *console << "   to draw it: " << command_ << std::endl;
    return;
  }
  const std::string program = plotProgram();
  if (program.empty()) return notDrawn("suture_plot is neither beside suture_solve nor on the PATH");
  const fs::path output = folder_ / "output";
  const std::optional<int> code = run({program, "--scene", (folder_ / "scene.vtkhdf").string(), "--output", output_}, output.string());
  const std::vector<std::string> lines = linesOf(output);
  if (code != 0) return notDrawn(lines.empty() || !code ? "suture_plot did not run, or not within 120 s" : withoutName(lines.back()));
  for (const std::string& line : lines) *console << (&line == &lines[0] ? "   drawn: " : " ") << withoutName(line) << "\n";
  *console << std::flush;
}

}  // namespace suture
