#include <suture/report/Console.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <support/TemporaryFolder.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Units.hpp>

#include "SampleRun.hpp"

using namespace suture;

namespace {

TEUCHOS_UNIT_TEST(Console, HeaderNamesSceneAndSizes) {
  sample::SampleRun sample("unused");
  sample.size_.elements = 9670;
  std::ostringstream console;
  printHeader(console, *sample.comm_, sample.scene_, sample.size_);
  const int ranks = sample.comm_->getSize();
  TEST_ASSERT(console.str().find("Suture ") == 0);
  TEST_ASSERT(console.str().find("   Two \"blocks\"   " + counted(ranks, "rank") +
                                 ", 3 subdomains   9,670 elements, 100 unknowns, 8 on the "
                                 "interface, 4 pairs in 2 pieces\n") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Console, FooterPrintsTheOutcome) {
  sample::SampleRun sample("unused");
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() != 0) return;
  printFooter(console, sample.run(), figures);
  TEST_ASSERT(console.str().find("converged: 2 outer, 16 + 8 PCG, residual 4.4e-09; 3 of 4 pairs closed, largest gap 4.000e-03 m, largest "
                                 "pressure 1.00e+01 Pa, forces balance to 3e-12\n") == 0);
}

TEUCHOS_UNIT_TEST(Console, FooterCountsThePairsThatStickAndSlip) {
  sample::SampleRun sample("unused");
  sample.rub();
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() != 0) return;
  printFooter(console, sample.run(), figures);
  TEST_ASSERT(console.str().find("largest pressure 1.00e+01 Pa, 2 stick, 1 slip, friction mobilised up to 100 %, forces balance") !=
              std::string::npos);
}

TEUCHOS_UNIT_TEST(Console, FooterGroupsTheDigitsOfCounts) {
  sample::SampleRun sample("unused");
  sample.rub();
  if (sample.comm_->getRank() == 0) sample.solution_.pairs.resize(1504, sample.solution_.pairs[1]);  // closed, sticks
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() != 0) return;
  printFooter(console, sample.run(), figures);
  TEST_ASSERT(console.str().find("; 1,503 of 1,504 pairs closed, ") != std::string::npos);
  TEST_ASSERT(console.str().find(", 1,502 stick, 1 slip, ") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Console, FooterPrintsTheKnownErrors) {
  sample::SampleRun sample("unused");
  sample.solution_.errors = {{"displacement_l2", 1.25e-5}, {"displacement_l2_relative", 0.00123}, {"pressure_l2", 2.0}};
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() != 0) return;
  printFooter(console, sample.run(), figures);
  TEST_ASSERT(console.str().find("\n   errors: displacement L2 1.250e-05 (0.12 %), pressure L2 2.000e+00\n") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Console, FooterSetsTheErrorsSideBySide) {
  sample::SampleRun sample("unused");
  sample.solution_.energyError = 0.002;
  sample.solution_.discretisation = DiscretisationError{0.1, 4.0, {}};
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() != 0) return;
  printFooter(console, sample.run(), figures);
  TEST_ASSERT(
      console.str().find("\n   error in the energy norm, estimated: discretisation 1.00e-01 (2.5 %), algebraic 2.00e-03 (0.05 %)\n") !=
      std::string::npos);
}

TEUCHOS_UNIT_TEST(Console, FooterOfAFailureGivesTheReason) {
  sample::SampleRun sample("unused");
  sample.solution_.converged = false;
  sample.solution_.failure = "50 iterations were not enough";
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() != 0) return;
  printFooter(console, sample.run(), figures);
  TEST_ASSERT(console.str().find("not converged: 50 iterations were not enough; 2 outer") == 0);
}

// The files of a folder that holds a checkpoint: it is listed unless the run is valid, since a valid run has not written it.
std::string footerWithCheckpoint(const std::function<void(sample::SampleRun&)>& change) {
  const std::string folder = blocks::makeTemporaryFolder(".", "console_");
  for (const char* name : {"checkpoint.h5", "summary.json"}) std::ofstream(folder + "/" + name) << "x";
  sample::SampleRun sample(folder);
  change(sample);
  std::ostringstream console;
  const RunFigures figures = runFigures(sample.run());
  if (sample.comm_->getRank() == 0) printFooter(console, sample.run(), figures);
  std::filesystem::remove_all(folder);
  std::string text = console.str();
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) text.replace(at, folder.size(), "out");
  return text;
}

TEUCHOS_UNIT_TEST(Console, FooterAtTheLimitContinuesFromTheCheckpoint) {
  const auto footer = [](int iterations, bool converged) {
    return footerWithCheckpoint([&](sample::SampleRun& sample) {
      sample.solution_.converged = converged;
      sample.solution_.iterations = iterations;
    });
  };
  const std::string limit = footer(50, false), early = footer(49, false), valid = footer(50, true);
  if (limit.empty()) return;  // another rank
  const std::string advice = "--restart \"out/checkpoint.h5\" --set \"Outer Solver/Maximum Iterations=500\"\n";
  TEST_ASSERT(limit.find(advice) != std::string::npos);
  TEST_ASSERT(early.find("--restart") == std::string::npos);
  TEST_ASSERT(early.find("neither subdomains nor conjugate gradients") != std::string::npos);
  TEST_ASSERT(early.find("/  checkpoint.h5  summary.json\n") != std::string::npos);
  TEST_ASSERT(valid.find("to try") == std::string::npos);
  TEST_ASSERT(valid.find("/  summary.json\n") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Console, FooterListsTheCheckpointOfAStoppedRun) {
  const std::string text = footerWithCheckpoint([](sample::SampleRun& sample) {
    sample.solution_.converged = false;
    sample.solution_.stopped = true;
  });
  if (text.empty()) return;  // another rank
  TEST_ASSERT(text.find("to try") == std::string::npos);
  TEST_ASSERT(text.find("/  checkpoint.h5  summary.json\n") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Format, GroupsDigits) {
  TEST_EQUALITY(grouped(0), "0");
  TEST_EQUALITY(grouped(999), "999");
  TEST_EQUALITY(grouped(1000), "1,000");
  TEST_EQUALITY(grouped(-1234567), "-1,234,567");
  TEST_EQUALITY(counted(1, "rank"), "1 rank");
}

TEUCHOS_UNIT_TEST(Units, TakesTheNamesOfTheScene) {
  Teuchos::ParameterList scene;
  scene.set<std::string>("Units", "mm , N,MPa");
  TEST_EQUALITY(unitsOf(scene).length, "mm");
  TEST_EQUALITY(unitsOf(scene).force, "N");
  TEST_EQUALITY(unitsOf(scene).stress, "MPa");
  scene.set<std::string>("Units", "mm");
  TEST_EQUALITY(unitsOf(scene).stress, "stress");
}

}  // namespace
