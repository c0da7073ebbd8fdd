#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Gather.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_DefaultSerialComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <new>

namespace {

using namespace suture;

CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }

std::string messageOf(const Comm& comm, const std::function<void()>& local) {
  try {
    collectively(comm, "working", local);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing thrown";
}

TEUCHOS_UNIT_TEST(Collective, AnExceptionOfOneRankIsThrownOnAll) {
  const CommPtr comm = world();
  const int last = comm->getSize() - 1;
  TEST_THROW(collectively(*comm, "working",
                          [&] {
                            if (comm->getRank() == last) throw NumericalError("breakdown");
                          }),
             NumericalError);
  TEST_THROW(collectively(*comm, "working",
                          [&] {
                            if (comm->getRank() == last) throw EnvironmentError("disk");
                          }),
             EnvironmentError);
  TEST_THROW(collectively(*comm, "working",
                          [&] {
                            if (comm->getRank() == last) throw InternalError("bug");
                          }),
             InternalError);
  TEST_THROW(collectively(*comm, "working",
                          [&] {
                            if (comm->getRank() == last) throw CommandLineError("flag");
                          }),
             CommandLineError);
  TEST_NOTHROW(collectively(*comm, "working", [] {}));
}

TEUCHOS_UNIT_TEST(Collective, TheLowestRankThatFailedDecides) {
  const CommPtr comm = world();
  const int first = std::min(1, comm->getSize() - 1);
  const std::string message = messageOf(*comm, [&] {
    if (comm->getRank() >= first) throw NumericalError("rank " + std::to_string(comm->getRank()));
  });
  TEST_EQUALITY(message, "rank " + std::to_string(first));
}

TEUCHOS_UNIT_TEST(Collective, ProblemsOfAllRanksAreMergedOnceEach) {
  const CommPtr comm = world();
  const std::string message = messageOf(*comm, [&] {
    throw InputError(std::vector<Problem>{{"all", "same"}, {"rank", std::to_string(comm->getRank())}});
  });
  std::string expected = "all: same";
  for (int rank = 0; rank < comm->getSize(); ++rank) expected += "\nrank: " + std::to_string(rank);
  TEST_EQUALITY(message, expected);
}

TEUCHOS_UNIT_TEST(Collective, ForeignExceptionsAreNamedAfterTheWork) {
  const CommPtr comm = world();
  TEST_EQUALITY(messageOf(*comm, [] { throw std::runtime_error("odd"); }), "working: odd");
  TEST_EQUALITY(messageOf(*comm, [] { throw 5; }), "working: an exception of unknown type");
  TEST_THROW(collectively(*comm, "working", [] { throw std::bad_alloc(); }), EnvironmentError);
  TEST_THROW(collectively(*comm, "working", [] { throw std::runtime_error("odd"); }), InternalError);
}

TEUCHOS_UNIT_TEST(Collective, RootAloneRunsAndItsFailureReachesAll) {
  const CommPtr comm = world();
  int runs = 0;
  collectivelyOnRoot(*comm, "working", [&] { ++runs; });
  TEST_EQUALITY(runs, comm->getRank() == 0 ? 1 : 0);
  TEST_THROW(collectivelyOnRoot(*comm, "working", [] { throw InputError("a", "b"); }), InputError);
}

TEUCHOS_UNIT_TEST(Collective, BroadcastGivesRootsTextToAll) {
  const CommPtr comm = world();
  const std::string text("from \0 root", 11);
  TEST_EQUALITY(broadcast(*comm, comm->getRank() == 0 ? text : "mine"), text);
  TEST_EQUALITY(broadcast(*comm, comm->getRank() == 0 ? "" : "mine"), "");
  std::vector<double> values(comm->getRank() == 0 ? 3 : 0, 1.5);
  broadcast(*comm, values);
  TEST_ASSERT((values == std::vector<double>{1.5, 1.5, 1.5}));
}

/// Strings of different length and content, some empty.
std::string of(int rank) { return std::string(rank % 2 == 0 ? 3 * rank : 0, static_cast<char>('a' + rank)); }

TEUCHOS_UNIT_TEST(Collective, GatherKeepsTheOrderOfRanks) {
  const CommPtr comm = world();
  std::vector<std::string> expected;
  for (int rank = 0; rank < comm->getSize(); ++rank) expected.push_back(of(rank));
  TEST_ASSERT(allGather(*comm, of(comm->getRank())) == expected);
  const std::vector<std::string> gathered = gatherOnRoot(*comm, of(comm->getRank()));
  TEST_ASSERT(gathered == (comm->getRank() == 0 ? expected : std::vector<std::string>()));
}

TEUCHOS_UNIT_TEST(Collective, GatherOnTakesFromSomeAndLeavesTheOthersAlone) {
  const CommPtr comm = world();
  const int ranks = comm->getSize(), mine = comm->getRank();
  for (int to = 0; to < ranks; ++to) {
    std::vector<int> senders;
    for (int rank = 0; rank < ranks; ++rank)
      if (rank != to && (rank + to) % 2 == 1) senders.push_back(rank);
    const std::vector<std::string> all = gatherOn(*comm, to, senders, std::string(std::size_t(mine) * 100000, char('a' + mine)));
    TEST_EQUALITY(all.size(), mine == to ? senders.size() : 0u);
    for (std::size_t i = 0; i < all.size(); ++i)
      TEST_EQUALITY(all[i], std::string(std::size_t(senders[i]) * 100000, char('a' + senders[i])));
  }
}

TEUCHOS_UNIT_TEST(Collective, JoinPutsTheValuesOfAllRanksIntoOneVector) {
  const CommPtr comm = world();
  const std::vector<int> all = joinOnRoot(*comm, std::vector<int>(std::size_t(comm->getRank()), comm->getRank()));
  std::vector<int> expected;  // none of rank 0, one of rank 1, ...
  for (int rank = 0; comm->getRank() == 0 && rank < comm->getSize(); ++rank) expected.insert(expected.end(), std::size_t(rank), rank);
  TEST_ASSERT(all == expected);
}

TEUCHOS_UNIT_TEST(Collective, ScatterGivesEveryRankItsOwn) {
  const CommPtr comm = world();
  std::vector<std::string> all;
  for (int rank = 0; comm->getRank() == 0 && rank < comm->getSize(); ++rank) all.push_back(of(rank));
  TEST_EQUALITY(scatterFromRoot(*comm, all), of(comm->getRank()));
}

TEUCHOS_UNIT_TEST(Collective, ScatterOfAWrongNumberIsAnErrorOnAllRanks) {
  const CommPtr comm = world();
  TEST_THROW(scatterFromRoot(*comm, std::vector<std::string>(comm->getSize() + 1)), InternalError);
}

TEUCHOS_UNIT_TEST(Collective, ScatterMakesOneAfterTheOther) {
  const CommPtr comm = world();
  std::vector<int> made;
  const std::string mine = scatterFromRoot(*comm, "making", [&](int rank) {
    made.push_back(rank);
    return of(rank);
  });
  TEST_EQUALITY(mine, of(comm->getRank()));
  std::vector<int> expected;  // on rank 0 only, itself last
  for (int rank = 1; comm->getRank() == 0 && rank <= comm->getSize(); ++rank) expected.push_back(rank % comm->getSize());
  TEST_ASSERT(made == expected);
}

TEUCHOS_UNIT_TEST(Collective, ScatterThatFailsHalfWayFailsEverywhere) {
  const CommPtr comm = world();
  for (int bad = 0; bad < comm->getSize(); ++bad)
    TEST_THROW(scatterFromRoot(*comm, "making",
                               [&](int rank) {
                                 if (rank == bad) throw NumericalError("no");
                                 return of(rank);
                               }),
               NumericalError);
}

TEUCHOS_UNIT_TEST(Collective, MessagesLongerThanOneRoundArriveWhole) {
  const CommPtr comm = world();
  const std::size_t length = (std::size_t(1) << 26) + 5;  // one round is 2^26 bytes per rank
  const int last = comm->getSize() - 1;
  std::string mine(comm->getRank() == last ? length : 2, static_cast<char>('a' + comm->getRank()));
  mine.back() = '!';
  const std::vector<std::string> gathered = gatherOnRoot(*comm, mine);
  if (comm->getRank() == 0) {
    TEST_EQUALITY(gathered[last].size(), length);
    TEST_EQUALITY(gathered[last].back(), '!');
    TEST_EQUALITY(gathered[last][length - 6], static_cast<char>('a' + last));
  }
  TEST_ASSERT(scatterFromRoot(*comm, gathered) == mine);
}

TEUCHOS_UNIT_TEST(Collective, SendFillsTheVectorOfAnotherRank) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), last = comm->getSize() - 1;
  const std::size_t length = (std::size_t(1) << 23) + 3;  // doubles, more bytes than one round
  const auto value = [](std::size_t i) { return 0.5 * static_cast<double>(i); };
  if (last == 0) return;
  for (const std::size_t size : {std::size_t(0), std::size_t(1), length}) {
    std::vector<double> values(rank == 0 || rank == last ? size : 0, rank == 0 ? 0.0 : -1.0);
    if (rank == 0) {
      for (std::size_t i = 0; i < size; ++i) values[i] = value(i);
      send(*comm, values, last);
    } else if (rank == last) {
      receive(*comm, values, 0);
      bool same = true;
      for (std::size_t i = 0; i < size; ++i) same = same && values[i] == value(i);
      TEST_ASSERT(same);
    }
  }
}

TEUCHOS_UNIT_TEST(Collective, ExchangeSwapsStringsWithNeighboursOnly) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), ranks = comm->getSize();
  // ring with itself; the text from a to b names both ranks and has the length a + 5 b, sometimes zero
  const auto text = [](int from, int to) {
    return std::string(from == 1 ? 0 : from + 5 * to, 'x') + (from == 1 ? "" : std::to_string(100 * from + to));
  };
  std::map<int, std::string> to;
  for (const int other : {rank, (rank + 1) % ranks, (rank + ranks - 1) % ranks}) to[other] = text(rank, other);
  const std::map<int, std::string> from = swapWithNeighbours(*comm, to);
  TEST_EQUALITY(from.size(), to.size());
  for (const auto& [other, bytes] : from) {
    TEST_EQUALITY(to.count(other), 1u);
    TEST_EQUALITY(bytes, text(other, rank));
  }
  // ranks without neighbours need not take part
  if (rank < 2 && ranks > 1) {
    const auto pair = swapWithNeighbours(*comm, {{1 - rank, std::to_string(rank)}});
    TEST_EQUALITY(pair.size(), 1u);
    TEST_EQUALITY(pair.at(1 - rank), std::to_string(1 - rank));
  }
  TEST_ASSERT(swapWithNeighbours(*comm, {}).empty());
}

TEUCHOS_UNIT_TEST(Collective, ExchangeCarriesLongMessagesBothWays) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), ranks = comm->getSize();
  std::map<int, std::string> to;  // longer than the eager limit: a naive order of sends and receives would deadlock
  for (int other = 0; other < ranks; ++other) to[other] = std::string((std::size_t(1) << 20) + rank, static_cast<char>('a' + rank));
  for (const auto& [other, bytes] : swapWithNeighbours(*comm, to))
    TEST_ASSERT(bytes == std::string((std::size_t(1) << 20) + other, static_cast<char>('a' + other)));
}

TEUCHOS_UNIT_TEST(Collective, UnionOverRanksIsSortedAndHasNothingTwice) {
  const CommPtr comm = world();
  const int rank = comm->getRank(), ranks = comm->getSize();
  std::vector<int> expected{-7};
  for (int r = 0; r <= ranks; ++r) expected.push_back(10 * r);
  // neighbours share a number, all share -7; unordered, with duplicates
  TEST_ASSERT(unionOverRanks(*comm, {10 * (rank + 1), -7, 10 * rank, 10 * rank}) == expected);
  TEST_ASSERT(unionOverRanks(*comm, {}).empty());
  TEST_ASSERT(unionOverRanks(*comm, rank == ranks - 1 ? std::vector<int>{3} : std::vector<int>{}) == std::vector<int>{3});
}

TEUCHOS_UNIT_TEST(Collective, WorksOnACommunicatorWithoutMpi) {
  const Teuchos::SerialComm<int> alone;
  TEST_ASSERT((unionOverRanks(alone, {2, 1, 2}) == std::vector<int>{1, 2}));
  TEST_ASSERT((swapWithNeighbours(alone, {{0, "x"}}) == std::map<int, std::string>{{0, "x"}}));
  TEST_ASSERT((allGather(alone, "x") == std::vector<std::string>{"x"}));
  TEST_EQUALITY(broadcast(alone, "x"), "x");
  TEST_THROW(collectively(alone, "working", [] { throw InputError("a", "b"); }), InputError);
}

}  // namespace
