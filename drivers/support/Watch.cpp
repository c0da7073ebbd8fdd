#include "Watch.hpp"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <suture/base/Errors.hpp>
#include <suture/base/Timers.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/History.hpp>
#include <thread>
#include <vector>

#include "CommandLine.hpp"
#include "Program.hpp"

namespace fs = std::filesystem;

namespace suture {

namespace {

constexpr std::chrono::milliseconds kGlance(200);
constexpr double kPatience = 20.0;      // seconds for a run to start
constexpr std::size_t kMostShown = 20;  // iterations before the first kGlance that are shown

std::optional<std::string> contentOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// Grows while a run writes; read in whole lines.
class GrowingTable {
 public:
  /// Complete lines that are new since the last call, without the header. \param isNew  the file is another one than before: another run
  std::vector<std::string> newLines(const fs::path& path, bool& isNew) {
    isNew = false;
    std::error_code error;
    if (!fs::exists(path, error)) return {};
    isNew = !continues(path);
    if (isNew) read_ = 0, lastLine_.clear();
    return linesFrom(path);
  }
  /// The same, of the final table of the run that has written the lines so far.
  std::vector<std::string> lastLines(const fs::path& path) { return continues(path) ? linesFrom(path) : std::vector<std::string>(); }
  const std::vector<std::string>& columns() const { return columns_; }
  static std::vector<std::string> fields(const std::string& line) {
    std::vector<std::string> all(1);
    for (const char c : line) {
      if (c == ',')
        all.emplace_back();
      else
        all.back() += c;
    }
    return all;
  }

 private:
  /// The file has the last line read at its place.
  bool continues(const fs::path& path) const {
    std::ifstream file(path, std::ios::binary);
    std::string line(lastLine_.size(), '\0');
    file.seekg(static_cast<std::streamoff>(read_ - line.size()));
    return line.empty() || (file.read(line.data(), static_cast<std::streamsize>(line.size())) && line == lastLine_);
  }

  std::vector<std::string> linesFrom(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(read_));
    const std::string text(std::istreambuf_iterator<char>(file), {});
    std::vector<std::string> lines;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
      if (read_ == 0)
        columns_ = fields(text.substr(begin, end - begin));
      else
        lines.push_back(text.substr(begin, end - begin));
      lastLine_ = text.substr(begin, end + 1 - begin);
      read_ += lastLine_.size();  // half a line is read again
    }
    return lines;
  }

  std::size_t read_ = 0;
  std::string lastLine_;
  std::vector<std::string> columns_;
};

/// The run that holds the lock of a folder.
enum class RunState { Running, None };

/// FolderLock writes "process 123 on host"; the file of a killed run stays. The lock itself is left alone: to try it could refuse a run
/// that starts at that moment.
RunState stateOf(const fs::path& folder) {
  const std::optional<std::string> owner = contentOf(folder / ".suture.lock");
  if (!owner) return RunState::None;
  int process = 0;
  char host[100] = "", here[100] = "";
  if (std::sscanf(owner->c_str(), "process %d on %99s", &process, host) != 2) return RunState::Running;  // not written yet
  ::gethostname(here, sizeof here - 1);
  if (std::string(host) != here) return RunState::Running;
  return ::kill(process, 0) == 0 || errno == EPERM ? RunState::Running : RunState::None;
}

class View {
 public:
  explicit View(std::string folder) : folder_(std::move(folder)) {}

  int show() {
    if (!waitForRun()) return int(ExitCode::Input);
    while (true) {
      const bool isRunning = stateOf(folder_) == RunState::Running;  // before the rows: after its end there are no more
      showNewRows();
      if (!isRunning) break;
      showWaiting();
      if (!std::cout) return printFailure();
      std::this_thread::sleep_for(kGlance);
    }
    return showEnd();
  }

 private:
  fs::path at(const char* name) const { return fs::path(folder_) / name; }

  /// False: there is no run, neither in progress nor finished.
  bool waitForRun() {
    std::error_code ignored;
    const double begin = Timers::now();
    while (stateOf(folder_) != RunState::Running && !fs::exists(at("summary.json"), ignored) &&
           !fs::exists(at(LiveHistory::kName), ignored)) {
      if (Timers::now() - begin > kPatience) {
        wipe();
        std::cout << std::flush;
        std::cerr << "suture_solve: no run writes into '" << folder_ << "', and it has no results"
                  << (fs::is_directory(folder_, ignored) ? "" : ": there is no such folder")
                  << "; expected the output folder of a run (its last line names the folder)" << std::endl;
        return false;
      }
      status(format("waiting for a run in '%s'", folder_.c_str()));
      std::this_thread::sleep_for(kGlance);
    }
    return true;
  }

  void showNewRows() {
    bool isNew = false;
    const std::vector<std::string> lines = table_.newLines(at(LiveHistory::kName), isNew);
    if (isNew && hasHeader_) {
      line("   another run started in this folder");
      hasHeader_ = false;
    }
    showRows(lines);
  }

  void showRows(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    std::size_t first = 0;
    if (!hasHeader_ && lines.size() > kMostShown) {
      first = lines.size() - kMostShown;
      line("   " + std::to_string(first) + " earlier iterations");
    }
    for (std::size_t i = first; i < lines.size(); ++i) showRow(lines[i]);
    last_ = Timers::now();
  }

  void showRow(const std::string& text) {
    const std::vector<std::string> fields = GrowingTable::fields(text), &columns = table_.columns();
    if (fields.size() != columns.size()) return;  // a damaged line
    std::map<std::string, std::string> value;
    for (std::size_t i = 0; i < columns.size(); ++i) value[columns[i]] = fields[i];
    const auto number = [&](const char* name) { return std::strtod(value[name].c_str(), nullptr); };
    const bool inSteps = value.count("load_step") > 0;
    if (!hasHeader_) line(std::string(inSteps ? " step" : "") + "  k   PCG   residual   active  changed         energy    seconds");
    hasHeader_ = true;
    line((inSteps ? format("%5s", value["load_step"].c_str()) : "") +
         format("%3s%6s%11.1e%9s%9s%15.4e%11.2f", value["iteration"].c_str(), value["pcg"].c_str(), number("residual"),
                value["active"].c_str(), value["changed"].c_str(), number("energy"), number("seconds")));
  }

  void showWaiting() {
    const double passed = Timers::now() - last_;
    if (passed < 1.0) return;
    status(hasHeader_ ? format("%.0f s since the last iteration (Ctrl-C ends this view, not the run)", passed)
                      : format("no iteration yet, %.0f s (Ctrl-C ends this view, not the run)", passed));
  }

  int showEnd() {
    int code = int(ExitCode::Numerical);
    std::optional<std::string> text = contentOf(at("summary.json"));
    if (!text) {
      line("ended without results: the run stopped with an error, which it printed, or was killed");
    } else {
      showRows(table_.lastLines(at("history.csv")));
      const auto summary = nlohmann::json::parse(*text, nullptr, false);
      if (summary.is_discarded() || !summary.is_object()) {
        line("ended; its summary.json is damaged");
      } else {
        code = summary.value("exit_code", int(ExitCode::Numerical));
        line(endOf(summary));
      }
    }
    std::cout << std::flush;
    return std::cout ? code : printFailure();
  }

  static std::string endOf(const nlohmann::json& summary) {
    const bool converged = summary.value("converged", false);
    const auto verified = summary.find("verified");
    const int code = summary.value("exit_code", 0);
    std::string text = std::string("ended: ") + (converged ? "converged" : "NOT CONVERGED");
    if (verified != summary.end() && verified->is_boolean()) text += verified->get<bool>() ? " and verified" : ", NOT VERIFIED";
    if (const auto failure = summary.find("failure"); failure != summary.end() && failure->is_string() && *failure != "")
      text += ": " + failure->get<std::string>();
    return text + ", exit code " + std::to_string(code);
  }

  void line(const std::string& text) {
    wipe();
    std::cout << text << std::endl;
  }
  /// A line that the next one replaces; only on a terminal.
  void status(const std::string& text) {
    if (!isTerminal_) return;
    std::cout << "\r   " << text << "   " << std::flush;
    width_ = std::max(width_, text.size() + 6);
  }
  void wipe() {
    if (width_ > 0) std::cout << '\r' << std::string(width_, ' ') << '\r';
    width_ = 0;
  }
  static int printFailure() {
    std::cerr << outputFailure("suture_solve", errno != 0 ? errno : EIO);
    return int(ExitCode::Environment);
  }

  const std::string folder_;
  const bool isTerminal_ = isTerminal();
  GrowingTable table_;
  bool hasHeader_ = false;
  double last_ = Timers::now();  // when the last row was shown
  std::size_t width_ = 0;        // characters of the status line
};

}  // namespace

int watch(const std::string& folder) {
  if (!isFirstProcess()) return 0;
  return View(folder).show();
}

}  // namespace suture
