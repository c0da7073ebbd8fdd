#include <suture/report/Checkpoint.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/hdf5/Hdf5File.hpp>

#include "SampleRun.hpp"

using namespace suture;

namespace {

// Displacements and states of all pairs come back to the last bit, on every rank.
void comesBack(sample::SampleRun& sample, const std::string& name, bool slides, bool& success, Teuchos::FancyOStream& out) {
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string path = sample.folder_ + "/" + name;
  std::map<int, ContactState> expected{{0, PairStatus::Slip}, {1, PairStatus::Slip}, {2, PairStatus::Open}, {3, PairStatus::Slip}};
  if (slides) {
    expected[0] = {PairStatus::Slip, {0.6, -0.8, 0.0}, 0.75};
    expected[1] = {PairStatus::Stick, {0, 0, 0}, 1.0 / 3.0};
  }
  for (PairResult& pair : sample.solution_.pairs) pair.state = expected.at(pair.id);
  writeCheckpoint(*sample.comm_, path, "hash", sample.subdomains_, sample.solution_);
  const Start found = readCheckpoint(*sample.comm_, path, "hash", sample.subdomains_);
  TEST_ASSERT(found.status == expected);
  TEST_EQUALITY(found.displacement.size(), sample.solution_.displacement.size());
  for (std::size_t s = 0; s < found.displacement.size(); ++s) TEST_ASSERT(found.displacement[s] == sample.solution_.displacement[s]);
  TEST_EQUALITY(Hdf5File::open(*sample.comm_, path).has("/SutureCheckpoint/Sliding"), slides);
  TEST_THROW(readCheckpoint(*sample.comm_, path, "another hash", sample.subdomains_), InputError);
}

TEUCHOS_UNIT_TEST(Checkpoint, KeepsDisplacementsAndStates) {
  sample::SampleRun sample(sample::folderOf("checkpoint"));
  comesBack(sample, "frictionless.h5", false, success, out);
}

TEUCHOS_UNIT_TEST(Checkpoint, KeepsDirectionsAndBoundsOfPairsThatSlide) {
  sample::SampleRun sample(sample::folderOf("checkpoint_sliding"));
  comesBack(sample, "sliding.h5", true, success, out);
}

}  // namespace
