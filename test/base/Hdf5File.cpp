#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/hdf5/Hdf5File.hpp>

#include <sys/resource.h>
#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>

namespace {

using namespace suture;

CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }

/// One name a number of ranks, since ctest may run them at the same time.
std::string nameOf(const std::string& what) { return "hdf5file_" + what + "_" + std::to_string(world()->getSize()) + ".h5"; }

void removeOnRoot(const std::string& path) {
  world()->barrier();
  if (world()->getRank() == 0) std::remove(path.c_str());
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Message of the InputError that `work` throws; every rank must throw the same.
std::string inputErrorOf(const std::function<void()>& work) {
  std::string mine;
  try {
    work();
  } catch (const InputError& error) {
    mine = error.what();
  }
  for (const std::string& other : allGather(*world(), mine)) {
    if (other != mine) return "ranks differ: " + mine + " | " + other;
  }
  return mine;
}

TEUCHOS_UNIT_TEST(Hdf5File, RowsOfAllRanksFollowEachOther) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), ranks = comm->getSize();
  const std::string path = nameOf("rows");
  // Rank r has r rows (rank 0 none) of two columns.
  std::vector<double> mine(2 * rank);
  std::iota(mine.begin(), mine.end(), 100.0 * rank + 1.0 / 3.0);
  const GlobalId big = (GlobalId(1) << 40) + rank;
  {
    Hdf5File file = Hdf5File::create(*comm, path);
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
  const Hdf5File file = Hdf5File::open(*comm, path);
  TEST_ASSERT(file.readReals("/Group/Deep/Reals") == reals);
  TEST_ASSERT(file.readInts("/Group/Ints") == ints);
  TEST_EQUALITY(file.readGlobalIds("/Group/Ids").back(), (GlobalId(1) << 40) + ranks - 1);
  TEST_EQUALITY(file.readInts("/Group/Bytes").back(), 250 + ranks - 1);
  TEST_ASSERT(file.readReals("/Group/Empty").empty());
  TEST_EQUALITY(file.readReals("/Group/Ints")[0], 0.0);  // whole numbers are numbers
  removeOnRoot(path);
}

// Longer than what is written at once, by some ranks only, and no multiple of it.
TEUCHOS_UNIT_TEST(Hdf5File, LongRowsComeBackWhole) {
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
    Hdf5File file = Hdf5File::create(*comm, path);
    file.write("/Reals", valuesOf(rank), 3);
    file.write("/Bytes", std::vector<unsigned char>(rank == ranks - 1 ? 2500001 : 0, 7));
    file.close();
  }
  std::vector<double> all;
  for (int r = 0; r < ranks; ++r) {
    const std::vector<double> values = valuesOf(r);
    all.insert(all.end(), values.begin(), values.end());
  }
  const Hdf5File file = Hdf5File::open(*comm, path);
  TEST_ASSERT(file.readReals("/Reals") == all);
  TEST_ASSERT(file.readInts("/Bytes") == std::vector<int>(2500001, 7));
  removeOnRoot(path);
}

TEUCHOS_UNIT_TEST(Hdf5File, TextsAndAttributesComeBack) {
  const CommPtr comm = world();
  const std::string path = nameOf("texts");
  const std::string text = "<a>\n \xC3\xA9 </a>";
  {
    Hdf5File file = Hdf5File::create(*comm, path);
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
  const Hdf5File file = Hdf5File::open(*comm, path);
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

TEUCHOS_UNIT_TEST(Hdf5File, IsNotThereBeforeItIsClosed) {
  const CommPtr comm = world();
  const std::string path = nameOf("unclosed");
  {
    Hdf5File file = Hdf5File::create(*comm, path);
    file.write("/A", std::vector<int>{1});
    TEST_ASSERT(!std::filesystem::exists(path));
    TEST_ASSERT(std::filesystem::exists(path + ".part"));
    comm->barrier();
  }
  comm->barrier();
  TEST_ASSERT(!std::filesystem::exists(path));
  TEST_ASSERT(!std::filesystem::exists(path + ".part"));
}

TEUCHOS_UNIT_TEST(Hdf5File, KeepsTheOldFileUntilTheNewOneIsWhole) {
  const CommPtr comm = world();
  const std::string path = nameOf("old");
  for (const int value : {1, 2}) {
    Hdf5File file = Hdf5File::create(*comm, path);
    file.write("/A", comm->getRank() == 0 ? std::vector<int>{value} : std::vector<int>{});
    if (value == 2) TEST_EQUALITY(Hdf5File::open(*comm, path).readInts("/A")[0], 1);
    file.close();
    TEST_EQUALITY(Hdf5File::open(*comm, path).readInts("/A")[0], value);
  }
  removeOnRoot(path);
}

TEUCHOS_UNIT_TEST(Hdf5File, RefusesAPlaceThatCannotBeWritten) {
  TEST_THROW(Hdf5File::create(*world(), "no/such/folder/file.h5"), EnvironmentError);
  TEST_THROW(Hdf5File::create(*world(), "."), EnvironmentError);
  TEST_THROW(Hdf5File::create(*world(), "/dev/null/file.h5"), EnvironmentError);
}

TEUCHOS_UNIT_TEST(Hdf5File, RefusesWhatIsNoWholeHdf5File) {
  const CommPtr comm = world();
  TEST_EQUALITY(inputErrorOf([&] { Hdf5File::open(*comm, "missing.h5"); }), "missing.h5: cannot be read: No such file or directory");
  TEST_EQUALITY(inputErrorOf([&] { Hdf5File::open(*comm, "."); }), ".: is a folder; expected an HDF5 file");

  const std::string foreign = nameOf("foreign"), cut = nameOf("cut");
  Hdf5File file = Hdf5File::create(*comm, cut);
  file.write("/A", std::vector<double>(1000, 1.0));
  file.close();
  if (comm->getRank() == 0) {
    std::ofstream(foreign) << "this is a text";
    std::filesystem::resize_file(cut, 4000);
  }
  comm->barrier();
  TEST_EQUALITY(inputErrorOf([&] { Hdf5File::open(*comm, foreign); }), foreign + ": is not an HDF5 file");
  TEST_ASSERT(contains(inputErrorOf([&] { Hdf5File::open(*comm, cut); }), cut + ": is damaged or cut off"));
  removeOnRoot(foreign);
  removeOnRoot(cut);
}

TEUCHOS_UNIT_TEST(Hdf5File, SaysWhatIsMissingAndWhatIsThere) {
  const CommPtr comm = world();
  const std::string path = nameOf("missing");
  {
    Hdf5File file = Hdf5File::create(*comm, path);
    file.write("/Mesh/Points", std::vector<double>{0.5});
    file.write("/Mesh/Ids", std::vector<GlobalId>{std::numeric_limits<GlobalId>::max()});
    file.write("/Mesh/Name", std::string("x"));
    file.close();
  }
  const Hdf5File file = Hdf5File::open(*comm, path);
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

// The heap of texts of variable length, damaged as "HDF5 File Format Specification", III.E, allows to: an object that is free and has no
// size kept HDF5 1.10 walking for ever (found by attack.py, mutant 402 of seed 22).
TEUCHOS_UNIT_TEST(Hdf5File, RefusesTextsOfADamagedHeap) {
  const CommPtr comm = world();
  const std::string path = nameOf("heap");
  const std::vector<std::pair<int, std::string>> damages = {{8, std::string(8, '\0')},                // size of the heap
                                                            {8, std::string("\0\0\0\0\1\0\0\0", 8)},  // the same, beyond the file
                                                            {16, std::string(16, '\0')},              // index and size of its first object
                                                            {24, std::string(8, '\377')},             // size alone: negative
                                                            {24, std::string("\0\1\0\0\0\1\0\0", 8)}};
  for (const auto& [at, bytes] : damages) {
    {
      Hdf5File file = Hdf5File::create(*comm, path);
      file.write("/Text", std::string("seven of nine"));
      file.close();
    }
    TEST_EQUALITY(Hdf5File::open(*comm, path).readText("/Text"), "seven of nine");
    comm->barrier();
    if (comm->getRank() == 0) {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      const std::string all((std::istreambuf_iterator<char>(file)), {});
      const std::size_t heap = all.find("GCOL");
      TEST_ASSERT(heap != std::string::npos);
      file.seekp(static_cast<std::streamoff>(heap) + at);
      file << bytes;
    }
    comm->barrier();
    TEST_ASSERT(contains(inputErrorOf([&] { Hdf5File::open(*comm, path).readText("/Text"); }), "the heap of texts at byte "));
    removeOnRoot(path);
  }
}

// Each rank gives its rows in pieces of its own, and two datasets in turn.
TEUCHOS_UNIT_TEST(Hdf5File, TakesRowsPieceByPiece) {
  const CommPtr comm = world();
  const std::string path = nameOf("pieces");
  const int me = comm->getRank(), pieces = 3 + me;
  {
    Hdf5File file = Hdf5File::create(*comm, path);
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
  const Hdf5File file = Hdf5File::open(*comm, path);
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

// A full disk, played by a limit for the size of files; it is lifted before the file goes, which HDF5 makes as long as it was meant to be.
// Pieces are small enough for HDF5 to keep some of them back.
TEUCHOS_UNIT_TEST(Hdf5File, TellsThatTheDiskIsFullWhilePiecesAreWritten) {
  const CommPtr comm = world();
  const std::string path = nameOf("full");
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{200000, before.rlim_max};
  const auto signalBefore = std::signal(SIGXFSZ, SIG_IGN);
  {
    Hdf5File file = Hdf5File::create(*comm, path);
    Hdf5Rows<double> a = file.rows<double>("/A", 100000), b = file.rows<double>("/B", 100000);
    setrlimit(RLIMIT_FSIZE, &small);
    const auto writePieces = [&] {
      for (int piece = 0; piece < 1000; ++piece) {
        a.append(std::vector<double>(100, piece));
        b.append(std::vector<double>(100, piece));
      }
    };
    TEST_THROW(collectively(*comm, "writing pieces", writePieces), EnvironmentError);
    comm->barrier();
    setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, signalBefore);
  comm->barrier();  // rank 0 has removed it
  TEST_ASSERT(!std::ifstream(path).good());
  TEST_ASSERT(!std::ifstream(path + ".part").good());
  {
    Hdf5File file = Hdf5File::create(*comm, path);
    file.write("/A", std::vector<int>{1});
    file.close();
  }
  TEST_EQUALITY(Hdf5File::open(*comm, path).readInts("/A")[0], 1);
  removeOnRoot(path);
}

// The sum does not depend on who wrote which rows, and any changed bit shows.
TEUCHOS_UNIT_TEST(Hdf5File, BlamesDamagedNumbersOnTheFile) {
  const CommPtr comm = world();
  const std::string path = nameOf("sum");
  const std::vector<double> values{1.5, -2.25, 1e300, 3.0};
  {
    Hdf5File file = Hdf5File::create(*comm, path);
    file.addChecksums();
    file.write("/Reals", values);
    file.write("/Ints", std::vector<int>{7, -comm->getRank()});
    file.close();
  }
  {
    const Hdf5File file = Hdf5File::open(*comm, path);
    TEST_EQUALITY(file.readReals("/Reals").size(), values.size() * std::size_t(comm->getSize()));
    TEST_EQUALITY(file.readInts("/Ints")[0], 7);
    TEST_EQUALITY(file.readGlobalIds("/Ints")[0], 7);  // integers of another width, with the same sum
  }
  if (comm->getRank() == 0) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(values.data()), 8));
    TEST_ASSERT(at != std::string::npos);
    file.clear();
    file.seekp(static_cast<std::streamoff>(at));
    file.put('\x01');
  }
  comm->barrier();
  const Hdf5File file = Hdf5File::open(*comm, path);
  TEST_ASSERT(contains(inputErrorOf([&] { file.readReals("/Reals"); }), path + ": cannot read '/Reals': it is damaged"));
  TEST_EQUALITY(file.readInts("/Ints")[0], 7);
  removeOnRoot(path);
}

// The disk is full before anything is written: the whole room of a dataset is reserved when it is made, on rank 0, and all ranks hear of
// it.
TEUCHOS_UNIT_TEST(Hdf5File, ReservesTheRoomOfADatasetWhenItIsMade) {
  const CommPtr comm = world();
  const std::string path = nameOf("reserved");
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{200000, before.rlim_max};
  const auto signalBefore = std::signal(SIGXFSZ, SIG_IGN);
  {
    Hdf5File file = Hdf5File::create(*comm, path);
    if (comm->getRank() == 0) setrlimit(RLIMIT_FSIZE, &small);
    TEST_THROW(file.rows<double>("/A", 100000), EnvironmentError);
    comm->barrier();
    setrlimit(RLIMIT_FSIZE, &before);
  }
  std::signal(SIGXFSZ, signalBefore);
  comm->barrier();
  TEST_ASSERT(!std::ifstream(path + ".part").good());
}

TEUCHOS_UNIT_TEST(Hdf5File, WantsAllRowsThatWerePromisedAndNoMore) {
  const CommPtr comm = world();
  const std::string path = nameOf("promised");
  {
    Hdf5File file = Hdf5File::create(*comm, path);
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

TEUCHOS_UNIT_TEST(Hdf5File, RefusesMisuseOnAllRanks) {
  const CommPtr comm = world();
  Hdf5File file = Hdf5File::create(*comm, nameOf("misuse"));
  file.write("/A", std::vector<int>{1});
  TEST_THROW(file.write("/A", std::vector<int>{1}), InternalError);
  TEST_THROW(file.write("/A/B", std::vector<int>{1}), InternalError);
  TEST_THROW(file.write("B", std::vector<int>{1}), InternalError);
  TEST_THROW(file.attribute("/C", "Unit", 1.0), InternalError);
  TEST_THROW(file.readInts("/A"), InternalError);
  // One rank whose rows are not whole fails all of them, and none waits.
  TEST_THROW(file.write("/D", std::vector<int>(comm->getRank() == comm->getSize() - 1 ? 3 : 4), 2), InternalError);
}

TEUCHOS_UNIT_TEST(Hdf5File, WorksOnACommunicatorWithoutMpi) {
  const Teuchos::SerialComm<int> alone;
  const std::string path = "rank" + std::to_string(world()->getRank()) + nameOf("alone");
  {
    Hdf5File file = Hdf5File::create(alone, path);
    file.write("/A", std::vector<int>{world()->getRank()});
    file.close();
  }
  TEST_EQUALITY(Hdf5File::open(alone, path).readInts("/A")[0], world()->getRank());
  std::remove(path.c_str());
}

}  // namespace
