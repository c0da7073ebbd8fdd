// A corpus of contact scenes drawn from a seed: each is solved by both formulations and by Monolithic. Every run must be solved with
// a verdict that holds and agree with the others, or be refused for the same reason by all.
//
//     test_corpus [--first S] [--count N] [--only SEED] [--formulation monolithic|interface|groups] [--dump DIR] [--verbose]
#include <corpus/CorpusJudge.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <Tpetra_Core.hpp>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>

namespace {

using namespace suture;
using namespace suture::corpus;

struct Options {
  std::uint64_t first = 1;
  int count = 300;
  std::string only, dump;
  bool verbose = false;
  std::vector<std::uint64_t> seeds;  // --only, which may be repeated; or `count` from `first`
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&]() -> std::string { return i + 1 < argc ? argv[++i] : ""; };
    if (name == "--first")
      options.first = std::stoull(value());
    else if (name == "--count")
      options.count = std::stoi(value());
    else if (name == "--only")
      options.seeds.push_back(std::stoull(value()));
    else if (name == "--formulation")
      options.only = value();
    else if (name == "--dump")
      options.dump = value();
    else if (name == "--verbose")
      options.verbose = true;
    else
      throw std::invalid_argument("unknown option " + name);
  }
  if (options.seeds.empty())
    for (int i = 0; i < options.count; ++i) options.seeds.push_back(options.first + i);
  return options;
}

struct Counts {
  int solved = 0, refused = 0, wrong = 0, lost = 0, neutral = 0, rounded = 0;
  long iterations = 0, pcg = 0;
  double seconds = 0;
};

std::string oneLine(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text.size() > 230 ? text.substr(0, 230) + "..." : text;
}

/// Runs one scene by all methods. Returns the errors, one per line. Collective.
std::vector<std::string> scene(const CommPtr& comm, const CorpusScene& scene, const Options& options,
                               std::map<std::string, std::map<std::string, Counts>>& table) {
  std::vector<std::string> wrong;
  std::vector<std::pair<const Way*, Outcome>> outcomes;
  Whole whole;  // the first method whose constraints could be built
  for (const Way& way : ways()) {
    if (!options.only.empty() && way.name != options.only) continue;
    Whole own;
    outcomes.emplace_back(&way, run(comm, scene, way, own));
    if (own.mesh.nodes() > 0 && whole.mesh.nodes() == 0) whole = std::move(own);
  }
  if (comm->getRank() != 0) return wrong;

  std::optional<Judge> judge;
  std::optional<Feasibility> feasibility;
  if (whole.mesh.nodes() > 0) feasibility = judge.emplace(whole).feasibility();
  if (feasibility && ((scene.expected == Expected::Solvable && *feasibility == Feasibility::None) ||
                      (scene.expected == Expected::Unsolvable && *feasibility != Feasibility::None)))
    wrong.push_back(std::to_string(scene.seed) + "  " + scene.family + "  the judge finds otherwise than the scene was made");
  const Outcome* reference = nullptr;
  for (auto& [way, outcome] : outcomes) {
    Counts& counts = table[scene.family][way->name];
    std::string complaint;
    if (outcome.ending == Ending::Solved) {
      complaint = judge->verdict(outcome);
      if (complaint.empty() && reference) complaint = judge->difference(outcome, *reference);
      if (complaint.empty() && !reference) reference = &outcome;
      if (complaint.empty() && feasibility == Feasibility::None) complaint = "solved, but has no solution";
      if (complaint.empty() && judge->neutralMotions(outcome) > 0) ++counts.neutral;
      if (complaint.empty() && judge->rounding(outcome) > 1.0) ++counts.rounded;
      counts.iterations += outcome.iterations;
      counts.pcg += outcome.pcg;
      ++(complaint.empty() ? counts.solved : counts.wrong);
    } else if (outcome.ending == Ending::Refused) {
      const Outcome& other = outcomes.front().second;
      if (other.ending != Ending::Refused || other.reason != outcome.reason) complaint = "refused, not as the others: " + outcome.reason;
      if (!feasibility || feasibility == Feasibility::Held) complaint = "refused, but has a solution: " + outcome.reason;
      ++(complaint.empty() ? counts.refused : counts.wrong);
    } else {
      complaint = "lost: " + outcome.reason;
      ++counts.lost;
    }
    counts.seconds += outcome.seconds;
    if (!complaint.empty())
      wrong.push_back(std::to_string(scene.seed) + "  " + scene.family + "  " + way->name + "  " + oneLine(complaint));
    if (options.verbose && outcome.ending == Ending::Solved)
      std::printf("  neutral motions %d, rounding %.1e times the bound\n", judge->neutralMotions(outcome), judge->rounding(outcome));
    if (options.verbose)
      std::printf("%llu %s %s: %s, %d nodes, %zu pairs, %d iterations, %d PCG, %.0f ms %s\n", (unsigned long long)scene.seed,
                  scene.family.c_str(), way->name.c_str(),
                  outcome.ending == Ending::Solved    ? "solved"
                  : outcome.ending == Ending::Refused ? "refused"
                                                      : "lost",
                  scene.mesh.nodes(), outcome.forces.size(), outcome.iterations, outcome.pcg, 1e3 * outcome.seconds,
                  outcome.reason.c_str());
  }
  return wrong;
}

void print(const std::map<std::string, std::map<std::string, Counts>>& table) {
  std::printf("\n%-12s %-11s %7s %7s %7s %7s %8s %8s %10s %8s %8s\n", "family", "method", "solved", "refused", "wrong", "lost", "neutral",
              "rounded", "iterations", "PCG", "seconds");
  std::map<std::string, Counts> totals;
  const auto row = [](const std::string& family, const std::string& way, const Counts& c) {
    std::printf("%-12s %-11s %7d %7d %7d %7d %8d %8d %10ld %8ld %8.2f\n", family.c_str(), way.c_str(), c.solved, c.refused, c.wrong, c.lost,
                c.neutral, c.rounded, c.iterations, c.pcg, c.seconds);
  };
  for (const auto& [family, ofWays] : table)
    for (const auto& [way, c] : ofWays) {
      row(family, way, c);
      Counts& total = totals[way];
      total.solved += c.solved, total.refused += c.refused, total.wrong += c.wrong, total.lost += c.lost, total.neutral += c.neutral,
          total.rounded += c.rounded;
      total.iterations += c.iterations, total.pcg += c.pcg, total.seconds += c.seconds;
    }
  for (const auto& [way, c] : totals) row("all", way, c);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  const CommPtr comm = Teuchos::DefaultComm<int>::getComm();
  const Options options = parse(argc, argv);
  std::map<std::string, std::map<std::string, Counts>> table;
  int wrong = 0;
  for (const std::uint64_t seed : options.seeds) {
    const CorpusScene random = corpusScene(seed);
    if (!options.dump.empty()) dump(*comm, random, options.dump);
    for (const std::string& line : scene(comm, random, options, table)) {
      ++wrong;
      std::printf("%s\n", line.c_str());
      std::fflush(stdout);
    }
  }
  if (comm->getRank() == 0) print(table);
  Teuchos::broadcast(*comm, 0, Teuchos::outArg(wrong));
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
