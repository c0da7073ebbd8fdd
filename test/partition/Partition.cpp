#include <Teuchos_UnitTestHarness.hpp>
#include <numeric>
#include <set>
#include <suture/base/Errors.hpp>

#include "Scenes.hpp"

using namespace suture;
using namespace partitiontesting;

namespace {

// Three bodies on top of each other with two contact lines between them; blocks of the lower two are named subdomains.
std::vector<Box> stack(int blocks = 1) {
  return {box("low", 0, 4, 0, 1, 16, 4, blocks), box("mid", 0, 4, 1, 2, 16, 4, blocks, blocks), box("top", 0, 4, 2, 3, 16, 4, blocks)};
}

Constraints contacts(const Mesh& mesh) {
  Constraints all;
  addContact(mesh, "low_top", "mid_bottom", all);
  addContact(mesh, "mid_top", "top_bottom", all);
  return all;
}

// Messages must be the same on every rank.
std::vector<Problem> problemsOf(const Mesh& mesh, const PartitionParameters& own) {
  try {
    makePartition(*comm(), mesh, Constraints(), own.list());
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

bool says(const std::vector<Problem>& problems, const std::string& path, const std::string& words) {
  return std::any_of(problems.begin(), problems.end(),
                     [&](const Problem& p) { return p.path == path && p.message.find(words) != std::string::npos; });
}

}  // namespace

TEUCHOS_UNIT_TEST(Partition, CutsEveryBodyInProportionToItsElements) {
  const Mesh grid = mesh({box("small", 0, 1, 0, 1, 10, 10), box("large", 0, 3, 2, 3, 30, 10)});
  const Partition all = makePartition(*comm(), grid, Constraints(), metis(12).list());
  TEST_EQUALITY(all.subdomains(), 12);
  TEST_EQUALITY(std::count(all.bodyOf.begin(), all.bodyOf.end(), 0), 3);
  TEST_EQUALITY(std::count(all.bodyOf.begin(), all.bodyOf.end(), 1), 9);
  TEST_EQUALITY(all.names.front(), "small 1");
  TEST_EQUALITY(all.names.back(), "large 9");
  TEST_EQUALITY(std::accumulate(all.elementsOf.begin(), all.elementsOf.end(), 0), 800);
  if (!onRoot()) return;
  for (int e = 0; e < grid.elements(); ++e) TEST_EQUALITY(all.bodyOf[all.subdomainOfElement[e]], grid.bodyOfElement[e]);
  for (int s = 0; s < 12; ++s) TEST_EQUALITY(connectedParts(grid, all.subdomainOfElement, s), 1);
}

TEUCHOS_UNIT_TEST(Partition, ExpectsCostsByNodesAndInterfaceNodes) {
  const Mesh grid = mesh(stack());
  const Constraints constraints = contacts(grid);
  const Partition all = makePartition(*comm(), grid, constraints, metis(14).list(), false);
  TEST_EQUALITY(all.costOf.size(), 14u);
  std::vector<long long> load(comm()->getSize(), 0);
  for (int s = 0; s < 14; ++s) load[all.rankOf[s]] += all.costOf[s];
  const long long total = std::accumulate(load.begin(), load.end(), 0LL);
  TEST_COMPARE(*std::max_element(load.begin(), load.end()), <, 1.2 * static_cast<double>(total) / comm()->getSize());
  if (!onRoot()) return;
  std::vector<std::set<int>> holders(grid.nodes());
  for (int e = 0; e < grid.elements(); ++e)
    for (int node : grid.nodesOf(e)) holders[node].insert(all.subdomainOfElement[e]);
  std::set<int> inContact;
  for (const ContactPair& pair : constraints.pairs)
    for (const PairEnd& end : pair.ends) inContact.insert(end.node);
  for (int s = 0; s < 14; ++s) {
    long long nodes = 0, onInterface = 0;
    for (int node = 0; node < grid.nodes(); ++node) {
      nodes += holders[node].count(s);
      onInterface += holders[node].count(s) && (holders[node].size() > 1 || inContact.count(node));
    }
    TEST_EQUALITY(all.costOf[s], nodes + onInterface * onInterface / 16);
  }
}

TEUCHOS_UNIT_TEST(Partition, GivesATinyBodyItsSubdomain) {
  const Mesh grid = mesh({box("small", 0, 1, 0, 1, 1, 1), box("large", 0, 3, 2, 3, 40, 40)});
  const Partition all = makePartition(*comm(), grid, Constraints(), metis(5).list());
  TEST_EQUALITY(std::count(all.bodyOf.begin(), all.bodyOf.end(), 0), 1);
  TEST_EQUALITY(all.elementsOf[std::find(all.bodyOf.begin(), all.bodyOf.end(), 0) - all.bodyOf.begin()], 2);
  TEST_EQUALITY(std::count(all.bodyOf.begin(), all.bodyOf.end(), 1), 4);
  TEST_EQUALITY(all.bodiesAreConnected, onRoot());  // no other rank has the bodies
}

TEUCHOS_UNIT_TEST(Partition, CutsDisconnectedPartsOfABodyOnTheirOwn) {
  Mesh grid = mesh({box("a", 0, 1, 0, 1, 10, 10), box("b", 0, 1, 2, 3, 10, 10)});
  if (onRoot()) {
    std::vector<int>& body = grid.elementGroups["both"];
    for (int e = 0; e < grid.elements(); ++e) body.push_back(e);
    assignBodies(grid, {"both"});
  }
  const Partition all = makePartition(*comm(), grid, Constraints(), metis(2).list());
  TEST_EQUALITY(all.elementsOf[0], 200);
  TEST_EQUALITY(all.names[1], "both 2");
  TEST_EQUALITY(all.bodiesAreConnected, false);
  TEST_ASSERT(says(problemsOf(grid, metis(1)), "Partition/METIS/Subdomains", "'both' of 2 disconnected parts"));
}

TEUCHOS_UNIT_TEST(Partition, IsTheSameForTheSameSeed) {
  const Mesh grid = mesh(stack());
  const Partition first = makePartition(*comm(), grid, contacts(grid), metis(9, 7).list());
  const Partition again = makePartition(*comm(), grid, contacts(grid), metis(9, 7).list());
  const Partition other = makePartition(*comm(), grid, contacts(grid), metis(9, 8).list());
  TEST_ASSERT(first.subdomainOfElement == again.subdomainOfElement);
  TEST_ASSERT(first.rankOf == again.rankOf);
  if (onRoot()) TEST_ASSERT(first.subdomainOfElement != other.subdomainOfElement);
}

TEUCHOS_UNIT_TEST(Partition, IsKnownToAllRanks) {
  const Mesh grid = mesh(stack());
  const Partition all = makePartition(*comm(), grid, contacts(grid), metis(9).list());
  TEST_EQUALITY(all.subdomains(), 9);
  TEST_EQUALITY(all.groupOf.size(), 9u);
  TEST_EQUALITY(all.rankOf.size(), 9u);
  TEST_EQUALITY(all.subdomainOfElement.size(), onRoot() ? 384u : 0u);
  for (int rank : all.rankOf) TEST_ASSERT(rank >= 0 && rank < comm()->getSize());
}

TEUCHOS_UNIT_TEST(Partition, MakesOneGroupOfPiecesThatShareASubdomain) {
  // One subdomain per body: the middle one touches both pieces, so that all three form one group.
  const Mesh grid = mesh(stack());
  const Partition all = makePartition(*comm(), grid, contacts(grid), metis(3).list());
  TEST_EQUALITY(all.groups.size(), 1u);
  TEST_ASSERT(all.groups[0] == (std::vector<int>{0, 1, 2}));
  TEST_ASSERT(all.piecesOf[0] == (std::vector<int>{0, 1}));
  TEST_ASSERT(all.groupOf == (std::vector<int>{0, 0, 0}));
}

TEUCHOS_UNIT_TEST(Partition, KeepsPiecesApartThatShareNoSubdomain) {
  // In 2 x 2 blocks the middle body has a lower and an upper layer. Low: 2 blocks, mid: 4, top: 2, in alphabetical order.
  const Mesh grid = mesh(stack(2));
  const Partition all = makePartition(*comm(), grid, contacts(grid), named("subdomain_*").list());
  TEST_EQUALITY(all.subdomains(), 8);
  TEST_EQUALITY(all.groups.size(), 2u);
  std::vector<std::set<std::string>> names(2);
  for (int group = 0; group < 2; ++group)
    for (int s : all.groups[group]) names[group].insert(all.names[s]);
  TEST_ASSERT(names[0] == (std::set<std::string>{"subdomain_low_0_0", "subdomain_low_1_0", "subdomain_mid_0_0", "subdomain_mid_1_0"}));
  TEST_ASSERT(names[1] == (std::set<std::string>{"subdomain_mid_0_1", "subdomain_mid_1_1", "subdomain_top_0_0", "subdomain_top_1_0"}));
  TEST_ASSERT(all.piecesOf == (std::vector<std::vector<int>>{{0}, {1}}));
}

TEUCHOS_UNIT_TEST(Partition, LeavesSubdomainsAwayFromContactOutOfGroups) {
  const Mesh grid = mesh({box("low", 0, 4, 0, 3, 8, 12, 1, 3), box("top", 0, 4, 3, 4, 8, 4)});
  Constraints constraints;
  addContact(grid, "low_top", "top_bottom", constraints);
  const Partition all = makePartition(*comm(), grid, constraints, named("subdomain_*").list());
  TEST_EQUALITY(all.subdomains(), 4);
  for (int s = 0; s < all.subdomains(); ++s) {
    const bool touches = all.names[s] == "subdomain_low_0_2" || all.names[s] == "subdomain_top_0_0";
    TEST_EQUALITY(all.groupOf[s], touches ? 0 : -1);
  }
}

TEUCHOS_UNIT_TEST(Partition, PlacesGroupsWhole) {
  const Mesh grid = mesh(stack(2));
  const Partition whole = makePartition(*comm(), grid, contacts(grid), named("subdomain_*").list());
  for (const std::vector<int>& group : whole.groups)
    for (int s : group) TEST_EQUALITY(whole.rankOf[s], whole.rankOf[group.front()]);
  const int ranks = comm()->getSize();
  TEST_EQUALITY(std::set<int>(whole.rankOf.begin(), whole.rankOf.end()).size(), static_cast<std::size_t>(std::min(ranks, 2)));
  const Partition spread = makePartition(*comm(), grid, contacts(grid), named("subdomain_*").list(), false);
  TEST_EQUALITY(std::set<int>(spread.rankOf.begin(), spread.rankOf.end()).size(), static_cast<std::size_t>(ranks));
  TEST_ASSERT(spread.groups == whole.groups);
}

namespace {

// Subdomains with a common node, and with a common side if `bySides`.
std::vector<std::set<int>> neighboursOf(const Mesh& mesh, const std::vector<int>& subdomainOfElement, int subdomains, bool bySides) {
  std::vector<std::set<int>> neighbours(subdomains), elementsOf(mesh.nodes());
  for (int e = 0; e < mesh.elements(); ++e)
    for (const int node : mesh.nodesOf(e)) elementsOf[node].insert(e);
  for (int e = 0; e < mesh.elements(); ++e) {
    std::map<int, int> common;  // element -> nodes in common with e
    for (const int node : mesh.nodesOf(e))
      for (const int other : elementsOf[node]) ++common[other];
    for (const auto& [other, nodes] : common)
      if (subdomainOfElement[other] != subdomainOfElement[e] && nodes >= (bySides ? mesh.dimension : 1))
        neighbours[subdomainOfElement[e]].insert(subdomainOfElement[other]);
  }
  return neighbours;
}

// Connected parts of the subdomains of a rank.
int partsOf(int rank, const std::vector<int>& rankOf, const std::vector<std::set<int>>& neighbours) {
  std::vector<char> seen(rankOf.size(), 0);
  int parts = 0;
  for (std::size_t first = 0; first < rankOf.size(); ++first) {
    if (rankOf[first] != rank || seen[first]) continue;
    ++parts;
    std::vector<int> open{static_cast<int>(first)};
    seen[first] = 1;
    while (!open.empty()) {
      const int s = open.back();
      open.pop_back();
      for (const int other : neighbours[s])
        if (rankOf[other] == rank && !seen[other]) {
          seen[other] = 1;
          open.push_back(other);
        }
    }
  }
  return parts;
}

}  // namespace

// Of the issue "outgrow one machine": subdomains in alphabetical order gave each rank one-wide strips, and METIS' subdomains were
// scattered.
TEUCHOS_UNIT_TEST(Partition, PlacesConnectedRunsWithFewNeighbours) {
  struct Case {
    std::string name;
    Mesh grid;
    PartitionParameters own;
    double parts;  // connected parts per rank, on average at most
  };
  const auto ring = [](double x, double y) { return (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) > 0.09; };
  Box cube = box("a", 0, 1, 0, 1, 8, 8, 8, 8);
  cube.nz = cube.blocksZ = 8;
  cube.cell = Cell::Hexahedron8;
  Box plate = cube;
  plate.x1 = plate.y1 = 4.0;
  plate.nx = plate.ny = plate.blocksX = plate.blocksY = 12;
  plate.nz = 4;
  plate.blocksZ = 2;
  const std::vector<Case> cases{
      {"blocks", mesh({box("a", 0, 1, 0, 1, 32, 32, 16, 16)}), named("subdomain_*"), 1.0},
      {"long blocks", mesh({box("a", 0, 4, 0, 1, 48, 12, 24, 6)}), named("subdomain_*"), 1.0},
      {"METIS", mesh({box("a", 0, 1, 0, 1, 64, 64)}), metis(160), 1.2},
      {"METIS, long", mesh({box("a", 0, 3, 0, 1, 96, 32)}), metis(160), 1.2},
      {"METIS, a hole", kept(mesh({box("a", 0, 1, 0, 1, 64, 64)}), ring), metis(160), 1.35},
      {"cubes", mesh({cube}), named("subdomain_*"), 1.0},
      {"plate", mesh({plate}), named("subdomain_*"), 1.0},
      {"cubes by METIS", mesh({cube}), metis(64), 1.2},
  };
  for (const Case& c : cases) {
    Partition all = makePartition(*comm(), c.grid, Constraints(), c.own.list(), false);
    TEST_ASSERT(std::is_sorted(all.rankOf.begin(), all.rankOf.end()));
    if (!onRoot()) continue;
    const auto bySides = neighboursOf(c.grid, all.subdomainOfElement, all.subdomains(), true);
    const auto byNodes = neighboursOf(c.grid, all.subdomainOfElement, all.subdomains(), false);
    for (const int ranks : {2, 3, 4, 6, 8, 12, 16}) {
      if (all.subdomains() < 10 * ranks) continue;  // a subdomain is more than a tenth of a rank's share
      placeOnRanks(all, false, ranks);
      TEST_ASSERT(std::is_sorted(all.rankOf.begin(), all.rankOf.end()));
      std::vector<long long> load(ranks, 0);
      std::vector<std::set<int>> others(ranks);
      long long total = 0;
      int parts = 0;
      for (int s = 0; s < all.subdomains(); ++s) {
        load[all.rankOf[s]] += all.costOf[s];
        total += all.costOf[s];
        for (const int other : byNodes[s])
          if (all.rankOf[other] != all.rankOf[s]) others[all.rankOf[s]].insert(all.rankOf[other]);
      }
      std::size_t most = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        parts += partsOf(rank, all.rankOf, bySides);
        most = std::max(most, others[rank].size());
      }
      out << c.name << " on " << ranks << ": " << parts << " parts, at most " << most << " neighbours, largest load "
          << static_cast<double>(*std::max_element(load.begin(), load.end())) * ranks / static_cast<double>(total) << " of the mean\n";
      TEST_COMPARE(static_cast<double>(*std::max_element(load.begin(), load.end())), <, 1.1 * static_cast<double>(total) / ranks);
      TEST_COMPARE(parts, <=, c.parts * ranks);
      TEST_COMPARE(most, <=, c.grid.dimension == 3 ? 26u : 8u);
    }
  }
}

// The curve does not depend on the ranks: neither do numbers and names.
TEUCHOS_UNIT_TEST(Partition, NumbersSubdomainsTheSameOnAnyNumberOfRanks) {
  const Mesh grid = mesh(stack(2));
  for (const PartitionParameters& own : {named("subdomain_*"), metis(11)}) {
    const Partition all = makePartition(*comm(), grid, contacts(grid), own.list(), false);
    const auto alone = comm()->split(onRoot() ? 0 : -1, 0);
    if (!onRoot()) continue;
    const Partition expected = makePartition(*alone, grid, contacts(grid), own.list(), false);
    TEST_ASSERT(all.names == expected.names);
    TEST_ASSERT(all.bodyOf == expected.bodyOf);
    TEST_ASSERT(all.costOf == expected.costOf);
    TEST_ASSERT(all.subdomainOfElement == expected.subdomainOfElement);
    for (int e = 0; e < grid.elements(); ++e) TEST_EQUALITY(all.bodyOf[all.subdomainOfElement[e]], grid.bodyOfElement[e]);
  }
}

TEUCHOS_UNIT_TEST(Partition, ChoosesANumberByItself) {
  const Mesh grid = mesh({box("body", 0, 1, 0, 1, 40, 40)});  // 3200 elements
  const Partition all = makePartition(*comm(), grid, Constraints(), parameters({"Type=METIS"}).list());
  TEST_EQUALITY(all.subdomains(), 4);
  const Mesh few = mesh({box("body", 0, 1, 0, 1, 10, 10)});  // 200 elements
  TEST_EQUALITY(makePartition(*comm(), few, Constraints(), parameters({}).list()).subdomains(), comm()->getSize());
}

TEUCHOS_UNIT_TEST(Partition, RefusesImpossibleNumbers) {
  const Mesh grid = mesh({box("a", 0, 1, 0, 1, 2, 2), box("b", 0, 1, 2, 3, 2, 2)});
  TEST_ASSERT(says(problemsOf(grid, metis(17)), "Partition/METIS/Subdomains", "17 subdomains are more than the 16 elements"));
  TEST_ASSERT(says(problemsOf(grid, metis(1)), "Partition/METIS/Subdomains", "too few for 2 bodies"));
  TEST_ASSERT(says(problemsOf(grid, parameters({"METIS/Subdomains=2.5"})), "Partition/METIS/Subdomains", "not a whole number"));
  TEST_EQUALITY(makePartition(*comm(), grid, Constraints(), metis(16).list()).subdomains(), 16);
}

TEUCHOS_UNIT_TEST(Partition, RefusesWrongNamedGroups) {
  const std::string path = "Partition/Named Groups/Pattern";
  Mesh grid = mesh({box("a", 0, 1, 0, 1, 4, 4, 2, 2), box("b", 0, 1, 2, 3, 4, 4)});
  TEST_ASSERT(says(problemsOf(grid, named("subdomian_*")), path, "no surface group"));
  TEST_ASSERT(says(problemsOf(grid, named("subdomian_*")), path, "subdomain_a_0_1"));
  TEST_ASSERT(says(problemsOf(grid, named("subdomain_a_*")), path, "32 elements (the first at "));
  TEST_ASSERT(says(problemsOf(grid, named("*")), path, "in both 'a' and 'subdomain_a_0_0'"));

  if (onRoot()) {
    // Blocks at opposite corners of a touch in one point only; w is in both bodies.
    const auto& groups = grid.elementGroups;
    std::vector<int> diagonal = groups.at("subdomain_a_0_0"), rest = groups.at("subdomain_a_1_0"), both = groups.at("b");
    diagonal.insert(diagonal.end(), groups.at("subdomain_a_1_1").begin(), groups.at("subdomain_a_1_1").end());
    both.insert(both.end(), groups.at("subdomain_a_0_1").begin(), groups.at("subdomain_a_0_1").end());
    grid.elementGroups["part_x"] = diagonal;
    grid.elementGroups["part_y"] = rest;
    grid.elementGroups["part_z"] = groups.at("subdomain_a_0_1");
    grid.elementGroups["part_b"] = groups.at("b");
    grid.elementGroups["mixed_w"] = both;
    grid.elementGroups["mixed_x"] = diagonal;
    grid.elementGroups["empty_part"] = {};
  }
  TEST_ASSERT(says(problemsOf(grid, named("part_*")), path, "'part_x' consists of 2 parts"));
  const std::vector<Problem> several = problemsOf(grid, named("mixed_*"));
  TEST_EQUALITY(several.size(), 2u);
  TEST_ASSERT(says(several, path, "'mixed_w' lies in 2 bodies (a, b)"));
  TEST_ASSERT(says(several, path, "8 elements (the first at "));
  TEST_ASSERT(says(problemsOf(grid, named("empty_*")), path, "has no elements"));
}

TEUCHOS_UNIT_TEST(Partition, RefusesABodyThatHangsTogetherInSingleNodes) {
  // Two blocks of a body that meet in the point (0.5, 0.5), cut by METIS or by name: the body would rotate about it.
  const Mesh grid = kept(mesh({box("a", 0, 1, 0, 1, 8, 8, 2, 2)}), [](double x, double y) { return (x < 0.5) == (y < 0.5); });
  for (const PartitionParameters& own : {metis(2), metis(6), named("subdomain_*")}) {
    const std::vector<Problem> problems = problemsOf(grid, own);
    TEST_EQUALITY(problems.size(), 1u);
    TEST_ASSERT(says(problems, "Bodies/all", "2 parts of this body are connected only by a single node ((0.5, 0.5))"));
  }
  // As one subdomain it is refused by that name, too.
  const std::vector<Problem> whole = problemsOf(grid, named("a"));
  TEST_ASSERT(says(whole, "Partition/Named Groups/Pattern", "'a' consists of 2 parts without a common side"));
  TEST_ASSERT(says(whole, "Bodies/all", "a single node"));
}

TEUCHOS_UNIT_TEST(Partition, TakesABodyThatTouchesItselfInANode) {
  // The middle and the upper right one of 3 x 3 blocks are missing: (2/3, 2/3) joins two blocks that are connected all around.
  const auto third = [](double x) { return static_cast<int>(3 * x); };
  const Mesh grid = kept(mesh({box("a", 0, 1, 0, 1, 9, 9)}), [&](double x, double y) { return third(x) != third(y) || third(x) == 0; });
  for (int subdomains : {1, 4}) {
    const Partition all = makePartition(*comm(), grid, Constraints(), metis(subdomains).list());
    TEST_EQUALITY(all.subdomains(), subdomains);
    if (!onRoot()) continue;
    for (int s = 0; s < subdomains; ++s) TEST_EQUALITY(connectedParts(grid, all.subdomainOfElement, s), 1);
  }
}

// Beyond 360,000 elements a body is cut in blocks, on all ranks.
TEUCHOS_UNIT_TEST(Partition, CutsALargeBodyTheSameOnAnyNumberOfRanks) {
  const Mesh grid = mesh({box("large", 0, 4, 0, 3, 520, 360), box("small", 0, 4, 4, 5, 40, 20)});
  const Partition all = makePartition(*comm(), grid, Constraints(), metis(30).list());
  const auto alone = comm()->split(onRoot() ? 0 : -1, 0);
  if (!onRoot()) return;
  const Partition expected = makePartition(*alone, grid, Constraints(), metis(30).list());
  TEST_ASSERT(all.subdomainOfElement == expected.subdomainOfElement);
  TEST_ASSERT(all.names == expected.names);
  std::vector<int> sizes;  // of the large body's subdomains
  for (int s = 0; s < all.subdomains(); ++s)
    if (all.bodyOf[s] == 0) sizes.push_back(all.elementsOf[s]);
  TEST_EQUALITY(sizes.size(), 29u);
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  TEST_COMPARE(*most, <, 1.15 * *least);
  for (const int s : {0, 7, 14, 15, 28}) TEST_EQUALITY(connectedParts(grid, all.subdomainOfElement, s), 1);
}

TEUCHOS_UNIT_TEST(Partition, RepairsDisconnectedPartsOfMetisWithANote) {
  // A comb of 16 thin teeth: METIS' recursive bisection (up to eight parts) joins teeth that are not connected, only similar.
  const Mesh comb =
      kept(mesh({box("a", 0, 1, 0, 1, 32, 32)}), [](double x, double y) { return y < 1.0 / 16 || static_cast<int>(32 * x) % 2 == 0; });
  int noted = 0;
  for (int subdomains : {2, 3, 4, 6, 8})
    for (int seed : {1, 2, 3}) {
      const Partition all = makePartition(*comm(), comb, Constraints(), metis(subdomains, seed).list());
      TEST_EQUALITY(all.subdomains(), subdomains);
      TEST_COMPARE(*std::min_element(all.elementsOf.begin(), all.elementsOf.end()), >, 0);
      noted += static_cast<int>(all.notes.size());  // on every rank
      for (const std::string& note : all.notes) {
        TEST_INEQUALITY(note.find("body 'all'"), std::string::npos);
        TEST_INEQUALITY(note.find("connected through sides"), std::string::npos);
      }
      if (!onRoot()) continue;
      for (int s = 0; s < subdomains; ++s) TEST_EQUALITY(connectedParts(comb, all.subdomainOfElement, s), 1);
    }
  TEST_COMPARE(noted, >, 0);
  const Mesh square = mesh({box("a", 0, 1, 0, 1, 16, 16)});
  TEST_EQUALITY(makePartition(*comm(), square, Constraints(), metis(4).list()).notes.size(), 0u);
}
