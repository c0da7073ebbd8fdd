#include "Memory.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <suture/base/Version.hpp>
#include <suture/report/OutputFolder.hpp>

namespace suture::study {
namespace {

using Json = nlohmann::ordered_json;

std::string pathIn(const std::string& folder) { return (std::filesystem::path(folder) / "finished.json").string(); }

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Everything that affects the figures, except a mesh file named by the scene.
Json keyOf(const Combination& run, int repetitions, int ranks) {
  return {{"scene", run.scene},
          {"text", textOf(run.scene)},
          {"overrides", run.overrides},
          {"repetitions", repetitions},
          {"version", version()},
          {"commit", commit()},
          {"ranks", ranks}};
}

}  // namespace

std::optional<FinishedRun> finishedRun(const std::string& folder, const Combination& run, int repetitions, int ranks) {
  const Json kept = Json::parse(textOf(pathIn(folder)), nullptr, false);
  if (!kept.is_object() || !kept.contains("key") || kept["key"] != keyOf(run, repetitions, ranks)) return std::nullopt;
  FinishedRun finished;
  try {
    finished.summaries = kept.at("summaries").get<std::vector<std::string>>();
    for (const std::string& text : finished.summaries)
      if (!Json::accept(text)) return std::nullopt;
    finished.exitCode = kept.at("exit_code").get<int>();
    finished.failure = kept.at("failure").get<std::string>();
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return finished;
}

void keepRun(const std::string& folder, const Combination& run, int repetitions, int ranks, const FinishedRun& finished) {
  const Json kept{{"key", keyOf(run, repetitions, ranks)},
                  {"summaries", finished.summaries},
                  {"exit_code", finished.exitCode},
                  {"failure", finished.failure}};
  writeTextFile(pathIn(folder), kept.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace suture::study
