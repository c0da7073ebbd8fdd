// Writing and reading HDF5 files.
#include <sys/resource.h>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <thread>

#include "Hdf5Testing.hpp"

namespace {

using namespace hdf5testing;

TEUCHOS_UNIT_TEST(Hdf5Files, RowsOfAllRanksFollowEachOther) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), ranks = comm->getSize();
  const std::string path = nameOf("rows");
  // Rank r has r rows (rank 0 none) of two columns.
  std::vector<double> mine(2 * rank);
  std::iota(mine.begin(), mine.end(), 100.0 * rank + 1.0 / 3.0);
  const GlobalId big = (GlobalId(1) << 40) + rank;
  {
    Hdf5Writer file(*comm, path);
    file.write("/Group/Deep/Reals", mine, 2);
    file.write("/Group/Ints", std::vector<int>{rank, -rank});
    file.write("/Group/Ids", std::vector<GlobalId>{big});
    file.write("/Group/Bytes", std::vector<unsigned char>{static_cast<unsigned char>(250 + rank)});
    file.write("/Group/Empty", std::vector<double>{}, 3);
    file.close();
  }
  std::vector<double> reals;
  std::vector<int> ints;
  for (int r = 0; r < ranks; ++r) {
    for (int i = 0; i < 2 * r; ++i) reals.push_back(100.0 * r + 1.0 / 3.0 + i);
    ints.insert(ints.end(), {r, -r});
  }
  const Hdf5Reader file(*comm, path);
  TEST_ASSERT(file.readReals("/Group/Deep/Reals") == reals);
  TEST_ASSERT(file.readInts("/Group/Ints") == ints);
  TEST_EQUALITY(file.readGlobalIds("/Group/Ids").back(), (GlobalId(1) << 40) + ranks - 1);
  TEST_EQUALITY(file.readInts("/Group/Bytes").back(), 250 + ranks - 1);
  TEST_ASSERT(file.readReals("/Group/Empty").empty());
  TEST_EQUALITY(file.readReals("/Group/Ints")[0], 0.0);  // integers are read as numbers
  removeOnRoot(path);
}

// Longer than one write, on some ranks only, and no multiple of it.
TEUCHOS_UNIT_TEST(Hdf5Files, LongRowsAreReadCompletely) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), ranks = comm->getSize();
  const std::string path = nameOf("long");
  const auto rowsOf = [](int r) { return r % 2 == 0 ? 100003 : 5; };  // three columns of them: 2.3 MiB
  const auto valuesOf = [&](int r) {
    std::vector<double> values(3 * rowsOf(r));
    std::iota(values.begin(), values.end(), 1e6 * r + 0.25);
    return values;
  };
  {
    Hdf5Writer file(*comm, path);
    file.write("/Reals", valuesOf(rank), 3);
    file.write("/Bytes", std::vector<unsigned char>(rank == ranks - 1 ? 2500001 : 0, 7));
    file.close();
  }
  std::vector<double> all;
  for (int r = 0; r < ranks; ++r) {
    const std::vector<double> values = valuesOf(r);
    all.insert(all.end(), values.begin(), values.end());
  }
  const Hdf5Reader file(*comm, path);
  TEST_ASSERT(file.readReals("/Reals") == all);
  TEST_ASSERT(file.readInts("/Bytes") == std::vector<int>(2500001, 7));
  removeOnRoot(path);
}

TEUCHOS_UNIT_TEST(Hdf5Files, TextsAndAttributesComeBack) {
  const CommPtr comm = world();
  const std::string path = nameOf("texts");
  const std::string text = "<a>\n \xC3\xA9 </a>";
  {
    Hdf5Writer file(*comm, path);
    file.write("/Record/Scene", text);
    file.write("/Record/Nothing", std::string());
    file.group("/VTKHDF");
    file.fixedAttribute("/VTKHDF", "Type", "UnstructuredGrid");
    file.attribute("/VTKHDF", "Version", std::vector<GlobalId>{1, 0});
    file.attribute("/Record", "Sign", std::string("positive compressive"));
    file.attribute("/Record/Scene", "Load", 0.5);
    file.attribute("/", "Unit", std::string("m"));
    file.close();
  }
  const Hdf5Reader file(*comm, path);
  TEST_EQUALITY(file.readText("/Record/Scene"), text);
  TEST_EQUALITY(file.readText("/Record/Nothing"), "");
  TEST_EQUALITY(file.readTextAttribute("/VTKHDF", "Type"), "UnstructuredGrid");
  TEST_EQUALITY(file.readTextAttribute("/Record", "Sign"), "positive compressive");
  TEST_EQUALITY(file.readTextAttribute("/", "Unit"), "m");
  TEST_ASSERT((file.members("/") == std::vector<std::string>{"Record", "VTKHDF"}));
  TEST_ASSERT((file.members("/Record") == std::vector<std::string>{"Nothing", "Scene"}));
  TEST_ASSERT(file.has("/Record/Scene") && file.has("/") && !file.has("/Record/Other") && !file.has("/No/Such"));
  removeOnRoot(path);
}

TEUCHOS_UNIT_TEST(Hdf5Files, HasNoTimeOfItsMaking) {
  const CommPtr comm = world();
  const std::string path = nameOf("untimed");
  const auto written = [&] {
    Hdf5Writer file(*comm, path);
    file.group("/Group/Of/Groups");
    file.write("/Group/Reals", std::vector<double>{0.5, 0.25}, 2);
    file.write("/Group/Text", std::string("text"));
    file.write("/Group/Texts", std::vector<std::string>{"a", "bc"});
    file.attribute("/Group/Reals", "unit", "m");
    file.close();
    comm->barrier();
    std::ifstream bytes(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(bytes), {});
  };
  const std::string first = written();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 stores seconds
  comm->barrier();
  TEST_ASSERT(!first.empty());
  TEST_ASSERT(written() == first);
  comm->barrier();
  removeOnRoot(path);
}

TEUCHOS_UNIT_TEST(Hdf5Files, IsNotThereBeforeItIsClosed) {
  const CommPtr comm = world();
  const std::string path = nameOf("unclosed");
  {
    Hdf5Writer file(*comm, path);
    file.write("/A", std::vector<int>{1});
    TEST_ASSERT(!std::filesystem::exists(path));
    TEST_ASSERT(std::filesystem::exists(path + ".part"));
    comm->barrier();
  }
  comm->barrier();
  TEST_ASSERT(!std::filesystem::exists(path));
  TEST_ASSERT(!std::filesystem::exists(path + ".part"));
}

TEUCHOS_UNIT_TEST(Hdf5Files, KeepsTheOldFileUntilTheNewOneIsComplete) {
  const CommPtr comm = world();
  const std::string path = nameOf("old");
  for (const int value : {1, 2}) {
    Hdf5Writer file(*comm, path);
    file.write("/A", comm->getRank() == 0 ? std::vector<int>{value} : std::vector<int>{});
    if (value == 2) TEST_EQUALITY(Hdf5Reader(*comm, path).readInts("/A")[0], 1);
    file.close();
    TEST_EQUALITY(Hdf5Reader(*comm, path).readInts("/A")[0], value);
  }
  removeOnRoot(path);
}

TEUCHOS_UNIT_TEST(Hdf5Files, ReportsMissingAndExistingDatasets) {
  const CommPtr comm = world();
  const std::string path = nameOf("missing");
  {
    Hdf5Writer file(*comm, path);
    file.write("/Mesh/Points", std::vector<double>{0.5});
    file.write("/Mesh/Ids", std::vector<GlobalId>{std::numeric_limits<GlobalId>::max()});
    file.write("/Mesh/Name", std::string("x"));
    file.close();
  }
  const Hdf5Reader file(*comm, path);
  TEST_EQUALITY(inputErrorOf([&] { file.readReals("/Mesh/Point"); }),
                path + ": has no '/Mesh/Point'. Did you mean 'Points'? Known here: Ids, Name, Points");
  TEST_ASSERT(contains(inputErrorOf([&] { file.readReals("/No/Such/Path"); }), "has no '/No/Such/Path'"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.readInts("/Mesh/Points"); }), "cannot read '/Mesh/Points': it does not hold integers"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.readInts("/Mesh/Ids"); }), "too large for an int"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.readReals("/Mesh/Name"); }), "it does not hold numbers"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.readText("/Mesh/Points"); }), "it is not a single text"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.readReals("/Mesh"); }), "cannot read '/Mesh'"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.members("/Mesh/Name"); }), "cannot read '/Mesh/Name'"));
  TEST_ASSERT(contains(inputErrorOf([&] { file.readTextAttribute("/Mesh", "Unit"); }), "'/Mesh' has no attribute 'Unit'"));
  removeOnRoot(path);
}

// Each rank writes its rows in pieces of different size, alternately to two datasets.
TEUCHOS_UNIT_TEST(Hdf5Files, TakesRowsPieceByPiece) {
  const CommPtr comm = world();
  const std::string path = nameOf("pieces");
  const int me = comm->getRank(), pieces = 3 + me;
  {
    Hdf5Writer file(*comm, path);
    Hdf5Rows<double> reals = file.rows<double>("/Reals", GlobalId(pieces) * (pieces - 1) / 2, 2);
    Hdf5Rows<GlobalId> integers = file.rows<GlobalId>("/Integers", pieces);
    for (int piece = 0; piece < pieces; ++piece) {
      integers.append({GlobalId(100) * me + piece});
      reals.append(std::vector<double>(2 * std::size_t(piece), me + 0.01 * piece));  // the first piece is empty
    }
    file.write("/Whole", std::vector<int>{me});
    { const Hdf5Rows<double> gone = std::move(reals); }
    { const Hdf5Rows<GlobalId> gone = std::move(integers); }
    file.close();
  }
  const Hdf5Reader file(*comm, path);
  std::vector<double> reals;
  std::vector<GlobalId> integers;
  for (int rank = 0; rank < comm->getSize(); ++rank)
    for (int piece = 0; piece < 3 + rank; ++piece) {
      integers.push_back(GlobalId(100) * rank + piece);
      for (int k = 0; k < 2 * piece; ++k) reals.push_back(rank + 0.01 * piece);
    }
  TEST_COMPARE_ARRAYS(file.readReals("/Reals"), reals);
  TEST_COMPARE_ARRAYS(file.readGlobalIds("/Integers"), integers);
  TEST_EQUALITY(file.readInts("/Whole").size(), std::size_t(comm->getSize()));
  removeOnRoot(path);
}

// The disk is full before anything is written: rank 0 reserves the space of a dataset when it creates it, and all ranks get the error.
TEUCHOS_UNIT_TEST(Hdf5Files, ReservesTheRoomOfADatasetWhenItIsMade) {
  const CommPtr comm = world();
  const std::string path = nameOf("reserved");
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{200000, before.rlim_max};
  const auto signalBefore = std::signal(SIGXFSZ, SIG_IGN);
  {
    Hdf5Writer file(*comm, path);
    if (comm->getRank() == 0) setrlimit(RLIMIT_FSIZE, &small);
    TEST_THROW(file.rows<double>("/A", 100000), EnvironmentError);
    comm->barrier();
    setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, signalBefore);
  comm->barrier();
  TEST_ASSERT(!std::ifstream(path + ".part").good());
}

TEUCHOS_UNIT_TEST(Hdf5Files, WantsAllRowsThatWerePromisedAndNoMore) {
  const CommPtr comm = world();
  const std::string path = nameOf("promised");
  {
    Hdf5Writer file(*comm, path);
    const bool last = comm->getRank() == comm->getSize() - 1;
    {
      Hdf5Rows<int> rows = file.rows<int>("/A", 2, 3);
      TEST_THROW(rows.append({1, 2, 3, 4}), InternalError);
      TEST_THROW(rows.append({1, 2, 3, 4, 5, 6, 7, 8, 9}), InternalError);
      rows.append({1, 2, 3});
      if (!last) rows.append({4, 5, 6});
    }
    TEST_THROW(file.close(), InternalError);  // on all ranks, and no rank waits
  }
  TEST_ASSERT(!std::ifstream(path).good());
}

TEUCHOS_UNIT_TEST(Hdf5Files, WorksOnACommunicatorWithoutMpi) {
  const Teuchos::SerialComm<int> alone;
  const std::string path = "rank" + std::to_string(world()->getRank()) + nameOf("alone");
  {
    Hdf5Writer file(alone, path);
    file.write("/A", std::vector<int>{world()->getRank()});
    file.close();
  }
  TEST_EQUALITY(Hdf5Reader(alone, path).readInts("/A")[0], world()->getRank());
  std::remove(path.c_str());
}

}  // namespace
