#include <suture/report/Checkpoint.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/hdf5/Hdf5Reader.hpp>
#include <suture/base/hdf5/Hdf5Writer.hpp>

#include "SampleRun.hpp"

using namespace suture;

namespace {

// Displacements and states of all pairs are restored to the last bit, on every rank.
void comesBack(sample::SampleRun& sample, const std::string& name, bool slides, bool& success, Teuchos::FancyOStream& out) {
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string path = sample.folder_ + "/" + name;
  std::map<int, ContactState> expected{{0, PairStatus::Slip}, {1, PairStatus::Slip}, {2, PairStatus::Open}, {3, PairStatus::Slip}};
  if (slides) {
    expected[0] = {PairStatus::Slip, {0.6, -0.8, 0.0}, 0.75, 0.3};
    expected[1] = {PairStatus::Stick, {0, 0, 0}, 1.0 / 3.0, 0.6};
  }
  for (PairResult& pair : sample.solution_.pairs) pair.state = expected.at(pair.id);
  writeCheckpoint(*sample.comm_, path, "hash", sample.subdomains_, sample.solution_);
  const Start found = readCheckpoint(*sample.comm_, path, "hash", sample.subdomains_);
  TEST_ASSERT(found.status == expected);
  TEST_EQUALITY(found.displacement.size(), sample.solution_.displacement.size());
  for (std::size_t s = 0; s < found.displacement.size(); ++s) TEST_ASSERT(found.displacement[s] == sample.solution_.displacement[s]);
  TEST_EQUALITY(Hdf5Reader(*sample.comm_, path).has("/SutureCheckpoint/Sliding"), slides);
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

/// A file as written before laws had a slope: four numbers per pair.
TEUCHOS_UNIT_TEST(Checkpoint, ReadsFilesWithoutTheSlopeOfTheLaw) {
  sample::SampleRun sample(sample::folderOf("checkpoint_old"));
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string path = sample.folder_ + "/old.h5", group = "/SutureCheckpoint";
  for (PairResult& pair : sample.solution_.pairs) pair.state = {PairStatus::Slip, {0.6, -0.8, 0.0}, 0.75, 0.3};
  for (const std::size_t columns : {4, 3}) {
    {
      std::vector<GlobalId> nodes;
      std::vector<double> values, sliding;
      std::vector<int> pairs, status;
      for (std::size_t s = 0; s < sample.subdomains_.size(); ++s) {
        const auto& ids = sample.subdomains_[s].globalNodes;
        nodes.insert(nodes.end(), ids.begin(), ids.end());
        const Vector& u = sample.solution_.displacement[s];
        values.insert(values.end(), u.data(), u.data() + u.size());
      }
      for (const PairResult& pair : sample.solution_.pairs) {
        pairs.push_back(pair.id);
        status.push_back(1);
        const double row[] = {0.6, -0.8, 0.0, 0.75};
        sliding.insert(sliding.end(), row, row + columns);
      }
      Hdf5Writer file(*sample.comm_, path);
      file.group(group);
      file.attribute(group, "MeshHash", std::string("hash"));
      file.write(group + "/Nodes", nodes);
      file.write(group + "/Displacement", values, 2);
      file.write(group + "/Pairs", pairs);
      file.write(group + "/Status", status);
      file.write(group + "/Sliding", sliding, int(columns));
      file.close();
    }
    if (columns == 3) {
      TEST_THROW(readCheckpoint(*sample.comm_, path, "hash", sample.subdomains_), InputError);
      continue;
    }
    const Start found = readCheckpoint(*sample.comm_, path, "hash", sample.subdomains_);
    for (const auto& [pair, state] : found.status) TEST_ASSERT(state == ContactState(PairStatus::Slip, {0.6, -0.8, 0.0}, 0.75));
    TEST_EQUALITY(found.status.size(), 4);
  }
}

// The path of load steps is restored to the last bit, on every rank; forces of lines on rank 0 were written, and all ranks read them.
TEUCHOS_UNIT_TEST(Checkpoint, KeepsThePathOfLoadSteps) {
  sample::SampleRun sample(sample::folderOf("checkpoint_path"));
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string path = sample.folder_ + "/path.h5";
  PathState written;
  written.length = 0.125;
  for (int step = 1; step <= 3; ++step) {
    StepRow row;
    row.step = step, row.time = step / 3.0, row.length = 1 / 3.0, row.outer = 4 * step, row.pcg = 50 + step, row.givenUp = step - 1;
    row.active = 3, row.sticking = 2, row.slipping = 1, row.changed = step, row.residual = 1e-9 / step, row.energy = -1.0 / 7.0;
    row.work = {1.0 / step, 0.3, 0.01, 0.2, 0.21, 1.5};
    row.seconds = 0.1;
    if (sample.comm_->getRank() == 0) row.forceOnB = {{1.0 / 3.0, step * 1.0, 0}, {0, 2.0, 0}};
    written.rows.push_back(row);
  }
  for (const PairResult& pair : sample.solution_.pairs)
    written.pairs.push_back({pair.id, {{0.1 * pair.id, 1.0 / 3.0, 0}, pair.id % 2 == 1, 0.7}, 2.0 + pair.id, {0, 0.25, 0.5}});
  written.changes = "t = 1: 'core' removed";
  written.released = {{1.0, 1, {0.1, -1.0 / 3.0, 0.0}}};
  written.fits = {{3, 1.0 / 7.0}};
  written.since = 2.0 / 3.0;
  for (const Vector& u : sample.solution_.displacement) written.reference.push_back(u / 3.0);
  writeCheckpoint(*sample.comm_, path, "hash", sample.subdomains_, sample.solution_, written);
  PathState read = readPath(*sample.comm_, path);
  TEST_EQUALITY(read.rows.size(), 3u);
  TEST_EQUALITY(read.changes, written.changes);
  TEST_EQUALITY(read.released.size(), 1u);
  TEST_ASSERT(read.released[0].removal == 1.0 && read.released[0].node == 1 && read.released[0].force == written.released[0].force);
  TEST_ASSERT(read.fits.size() == 1 && read.fits[0].pair == 3 && read.fits[0].gap == 1.0 / 7.0);
  readCheckpoint(*sample.comm_, path, "hash", sample.subdomains_, &read);
  TEST_EQUALITY(read.length, 0.125);
  TEST_EQUALITY(read.since, written.since);
  TEST_EQUALITY(read.reference.size(), written.reference.size());
  for (std::size_t s = 0; s < read.reference.size(); ++s) TEST_ASSERT(read.reference[s] == written.reference[s]);
  TEST_EQUALITY(read.rows.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const StepRow &a = read.rows[i], &b = written.rows[i];
    TEST_ASSERT(a.step == b.step && a.time == b.time && a.outer == b.outer && a.pcg == b.pcg && a.givenUp == b.givenUp);
    TEST_ASSERT(a.slipping == b.slipping && a.changed == b.changed && a.residual == b.residual && a.energy == b.energy);
    TEST_ASSERT(a.work.external == b.work.external && a.work.dissipated == b.work.dissipated && a.work.size == b.work.size);
    TEST_EQUALITY(a.forceOnB.size(), 2u);
    TEST_EQUALITY(a.forceOnB[0][1], 1.0 + double(i));
  }
  TEST_EQUALITY(read.pairs.size(), 4u);
  for (const PathState::Pair& pair : read.pairs) {
    TEST_EQUALITY(pair.past.slip[0], 0.1 * pair.id);
    TEST_EQUALITY(pair.past.slipped, pair.id % 2 == 1);
    TEST_EQUALITY(pair.past.dissipated, 0.7);
    TEST_EQUALITY(pair.force, 2.0 + pair.id);
    TEST_EQUALITY(pair.tangential[2], 0.5);
  }
  writeCheckpoint(*sample.comm_, path, "hash", sample.subdomains_, sample.solution_);
  readCheckpoint(*sample.comm_, path, "hash", sample.subdomains_, &read);
  TEST_ASSERT(read.empty());
}

}  // namespace
